// The system that libc asks for: there is none. libc's formatting brings its streams along, and the encoder measures
// its time, but a module should import nothing; so the linker puts these in place of the imports (--wrap).

#include <wasi/api.h>

extern "C" {
__wasi_errno_t __wrap___wasi_clock_time_get(__wasi_clockid_t, __wasi_timestamp_t, __wasi_timestamp_t* time) {
  *time = 0;
  return __WASI_ERRNO_SUCCESS;
}
__wasi_errno_t __wrap___wasi_fd_close(__wasi_fd_t) { return __WASI_ERRNO_NOSYS; }
__wasi_errno_t __wrap___wasi_fd_seek(__wasi_fd_t, __wasi_filedelta_t, __wasi_whence_t, __wasi_filesize_t*) {
  return __WASI_ERRNO_NOSYS;
}
__wasi_errno_t __wrap___wasi_fd_write(__wasi_fd_t, const __wasi_ciovec_t*, size_t, __wasi_size_t*) {
  return __WASI_ERRNO_NOSYS;
}
}
