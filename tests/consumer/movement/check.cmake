# Installs movement and the modules below it, builds walk.cpp against them where CMake finds neither assimp nor JSON and where
# a header of any library but Eigen is an error, and runs it.
foreach(name SOURCE BUILD SCRATCH)
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
foreach(module base collision movement)
    run(${CMAKE_COMMAND} --install "${BUILD}" --prefix "${SCRATCH}/prefix" --component ${module})
endforeach()
file(GLOB_RECURSE headers RELATIVE "${SCRATCH}/prefix/include/slipface" "${SCRATCH}/prefix/include/*")
foreach(header IN LISTS headers)
    if(NOT header MATCHES "^(base|collision|movement)/")
        message(FATAL_ERROR "${header} was installed with movement")
    endif()
endforeach()

set(hidden "${SCRATCH}/hidden")
foreach(header fmt/core.h fmt/format.h nlohmann/json.hpp assimp/scene.h oneapi/tbb/parallel_for.h libdeflate.h webp/decode.h)
    file(WRITE "${hidden}/${header}" "#error \"a header of movement includes ${header}\"\n")
endforeach()
set(absent "")
foreach(package assimp nlohmann_json ${ABSENT})
    list(APPEND absent -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
set(arguments -S "${SOURCE}/tests/consumer/movement" -G Ninja "-DCMAKE_PREFIX_PATH=${SCRATCH}/prefix"
    "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_FLAGS=${FLAGS} -I${hidden}" ${absent})
set(runner "")
if(TOOLCHAIN)  # with -DTOOLCHAIN= it is built for another system, and run by -DRUNNER=
    list(APPEND arguments "-DCMAKE_TOOLCHAIN_FILE=${TOOLCHAIN}")
    set(runner ${RUNNER})
endif()
run(${CMAKE_COMMAND} -B "${SCRATCH}/build" ${arguments})
run(${CMAKE_COMMAND} --build "${SCRATCH}/build")
file(GLOB program "${SCRATCH}/build/walk" "${SCRATCH}/build/walk.exe")
run(${runner} "${program}")

# A module that is not there is named.
file(WRITE "${SCRATCH}/absent/CMakeLists.txt"
    "cmake_minimum_required(VERSION 3.25)\nproject(Absent CXX)\nfind_package(Slipface REQUIRED COMPONENTS teleport)\n")
execute_process(COMMAND ${CMAKE_COMMAND} -S "${SCRATCH}/absent" -B "${SCRATCH}/absent/build" -G Ninja
    "-DCMAKE_PREFIX_PATH=${SCRATCH}/prefix" RESULT_VARIABLE code ERROR_VARIABLE output OUTPUT_QUIET)
if(code EQUAL 0 OR NOT output MATCHES "teleport")
    message(FATAL_ERROR "find_package(Slipface COMPONENTS teleport) said: ${output}")
endif()
