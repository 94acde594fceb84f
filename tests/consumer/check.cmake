# Installs the engine into a scratch folder, builds the README's game against it with find_package, and runs it.
foreach(name SOURCE BUILD SCRATCH LEVEL)
    if(NOT DEFINED ${name})
        message(FATAL_ERROR "check.cmake needs -D${name}=")
    endif()
endforeach()

file(READ "${SOURCE}/README.md" readme)
file(READ "${SOURCE}/tests/consumer/game.cpp" game)
string(FIND "${readme}" "${game}" found)
if(found EQUAL -1)
    message(FATAL_ERROR "README.md does not show tests/consumer/game.cpp word for word")
endif()

function(run)
    execute_process(COMMAND ${ARGV} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(NOT code EQUAL 0)
        message(FATAL_ERROR "${ARGV} failed:\n${output}")
    endif()
    message("${output}")
endfunction()

file(REMOVE_RECURSE "${SCRATCH}")
run(${CMAKE_COMMAND} --install "${BUILD}" --prefix "${SCRATCH}/prefix")
run(${CMAKE_COMMAND} -S "${SOURCE}/tests/consumer" -B "${SCRATCH}/build" -G Ninja
    "-DCMAKE_PREFIX_PATH=${SCRATCH}/prefix" "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_FLAGS=${FLAGS}")
run(${CMAKE_COMMAND} --build "${SCRATCH}/build")
run("${SCRATCH}/build/game" "${LEVEL}")
