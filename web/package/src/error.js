/** What the numbers of the C interface are called (codec/c_abi.h). */
const names = new Map([
  [-1, 'TRUNCATED'], [-2, 'MALFORMED'], [-3, 'UNSUPPORTED_VERSION'], [-4, 'LIMIT_EXCEEDED'], [-6, 'COUNT_MISMATCH'],
  [-7, 'TOO_LARGE'], [-8, 'CHECKSUM'], [-9, 'MISSING_SECTION'], [-10, 'TRAILING_BYTES'], [-11, 'OUT_OF_MEMORY'],
  [-12, 'ATTRIBUTES'], [-100, 'INVALID_ARGUMENT'], [-101, 'BUFFER_TOO_SMALL'], [-102, 'NOT_AVAILABLE'], [-103, 'NOT_BUILT'],
]);

/** Why a payload, or the JSON that describes it, was refused. */
export class TutteError extends Error {
  /**
   * @param {string} code  a name that programs can compare
   * @param {string} message  a sentence
   */
  constructor(code, message) {
    super(message);
    this.name = 'TutteError';
    this.code = code;
  }

  /**
   * @param {number} status  a negative status of the C interface
   * @param {string} sentence  what it says about it
   */
  static ofStatus(status, sentence) {
    return new TutteError(names.get(status) ?? 'UNKNOWN', `TUTTE_mesh_compression: ${sentence}`);
  }

  /** An error that came through a worker as a plain object. @param {{code: string, message: string}} plain */
  static from(plain) {
    return new TutteError(plain.code, plain.message);
  }
}
