# Clang to WebAssembly with Debian's wasi-libc and libc++: packages clang-16, lld-16, wasi-libc, libc++-16-dev-wasm32,
# libc++abi-16-dev-wasm32, libclang-rt-16-dev-wasm32.
set(CMAKE_SYSTEM_NAME WASI)
set(CMAKE_SYSTEM_PROCESSOR wasm32)

foreach(tool clang clang++ llvm-ar llvm-ranlib)
  string(MAKE_C_IDENTIFIER wasi_${tool} variable)
  find_program(${variable} NAMES ${tool}-16 REQUIRED)
endforeach()
set(CMAKE_C_COMPILER ${wasi_clang})
set(CMAKE_CXX_COMPILER ${wasi_clang__})
set(CMAKE_AR ${wasi_llvm_ar})
set(CMAKE_RANLIB ${wasi_llvm_ranlib})
set(CMAKE_C_COMPILER_TARGET wasm32-wasi)
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
# Debian's clang does not find its libc++ for this target by itself.
set(CMAKE_C_FLAGS_INIT "-msimd128 -mbulk-memory -msign-ext")
set(CMAKE_CXX_FLAGS_INIT "-nostdinc++ -isystem /usr/include/wasm32-wasi/c++/v1 -fno-exceptions -fno-rtti -Wno-unused-command-line-argument -msimd128 -mbulk-memory -msign-ext")

# Programs need the linker flags of web/wasm, so compilers are tried on libraries; nothing is found outside the target.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
