# The two ways to build that use no preset: a game that adds the mover's sources as a subdirectory, where CMake finds none of the
# packages that the mover does not use, built and run; and `cmake -B b` of everything, configured, with the first library built.
foreach(name SOURCE SCRATCH COMPILER)
    if(NOT DEFINED ${name})
        message(FATAL_ERROR "check.cmake needs -D${name}=")
    endif()
endforeach()

function(run)
    execute_process(COMMAND ${ARGV} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(NOT code EQUAL 0)
        message(FATAL_ERROR "${ARGV} failed:\n${output}")
    endif()
    message("${output}")
endfunction()

file(REMOVE_RECURSE "${SCRATCH}")
set(absent "")
foreach(package assimp nlohmann_json glfw3 CLI11 GTest rapidcheck benchmark pybind11 Python3 MPI)
    list(APPEND absent -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
# What is tested is how it is put together, so nobody waits for the optimiser.
run(${CMAKE_COMMAND} -S "${SOURCE}/tests/consumer/subproject" -B "${SCRATCH}/game" "-DSLIPFACE_SOURCE=${SOURCE}"
    "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_FLAGS=-O0 ${FLAGS}" ${absent})
run(${CMAKE_COMMAND} --build "${SCRATCH}/game" --target walk --parallel 2)
run("${SCRATCH}/game/walk")
if(EXISTS "${SCRATCH}/game/slipface/engine/level" OR EXISTS "${SCRATCH}/game/slipface/editor")
    message(FATAL_ERROR "the mover as a subdirectory brought level or the editor with it")
endif()

run(${CMAKE_COMMAND} -S "${SOURCE}" -B "${SCRATCH}/plain" "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_FLAGS=-O0 ${FLAGS}")
run(${CMAKE_COMMAND} --build "${SCRATCH}/plain" --target slipface_base --parallel 2)
