/** The extension that is tested. */
export const EXTENSION_NAME = 'TUTTE_mesh_compression';
