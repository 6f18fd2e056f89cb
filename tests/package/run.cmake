# Installs the build below itself and builds a program against the installed package, as a user would.
set(prefix ${build}/package/prefix)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(result)
    message(FATAL_ERROR "${ARGN}\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${build}/package)
run(${CMAKE_COMMAND} --install ${build} --prefix ${prefix})
run(${CMAKE_COMMAND} -S ${source} -B ${build}/package/consumer -D CMAKE_PREFIX_PATH=${prefix} -D WITH_GLTF=${gltf}
    -D README=${source}/../../README.md)
run(${CMAKE_COMMAND} --build ${build}/package/consumer)
run(${build}/package/consumer/consumer)
