# vsglbench_room(NAME [PUBLIC_LIBRARY] [SOURCES ...] [LINK ...] [PRIVATE_LINK ...] [TESTS x_test.cpp ...]
#                [GPU_TESTS ...] [SLOW_TESTS ...])
# One room of the house: a static library vsglbench_NAME with include root harness/, and one test
# program per kind of test. GPU_TESTS carry the CTest label `gpu` (lavapipe counts), SLOW_TESTS
# `gpu-slow`, which both `-L gpu` and `-L slow` match; `gpu-tree` are those that need the source tree. PUBLIC_LIBRARY: a shared one, installed with its headers, that plugins link too.
function(vsglbench_options target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wno-missing-field-initializers)
  if(VSGLBENCH_WERROR)  # restrict: GCC 12's false alarms in std::string
    target_compile_options(${target} PRIVATE -Werror -Wno-error=restrict)
  endif()
  if(VSGLBENCH_SANITIZE)
    # vptr: glslang has no RTTI. Uninitialised: GCC's false alarms in the standard library's own code.
    set(sanitizers -fsanitize=address,undefined,float-cast-overflow -fno-sanitize=vptr -fno-sanitize-recover=all)
    if(VSGLBENCH_FUZZ)
      list(APPEND sanitizers -fsanitize=fuzzer-no-link)
    endif()
    target_compile_options(${target} PUBLIC ${sanitizers} -fno-omit-frame-pointer
                           $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
    target_link_options(${target} PUBLIC ${sanitizers})
  endif()
endfunction()

function(vsglbench_tests target kind labels)
  if(NOT BUILD_TESTING OR NOT ARGN)
    return()
  endif()
  set(program ${target}${kind}_test)
  add_executable(${program} ${ARGN})
  vsglbench_options(${program})
  if(CMAKE_BUILD_TYPE STREQUAL "Release")
    target_compile_options(${program} PRIVATE -O1)  # what is tested is optimised; the tests need not be
  endif()
  target_link_libraries(${program} PRIVATE ${target} GTest::gtest GTest::gtest_main ${VSGLBENCH_TEST_LINK})
  # Paths of this clone only where a source names them: a compiler cache serves the others to every clone.
  foreach(source ${ARGN})
    file(STRINGS ${source} uses REGEX "VSGLBENCH_(SOURCE|BINARY)_DIR" LIMIT_COUNT 1)
    if(uses)
      set_property(SOURCE ${source} APPEND PROPERTY COMPILE_DEFINITIONS VSGLBENCH_SOURCE_DIR="${CMAKE_SOURCE_DIR}"
                   VSGLBENCH_BINARY_DIR="${CMAKE_BINARY_DIR}")
    endif()
  endforeach()
  set(environment)
  if(VSGLBENCH_SANITIZE AND labels MATCHES gpu)  # lavapipe and LLVM leak, in libraries that are unloaded by then
    set(environment ENVIRONMENT "ASAN_OPTIONS=detect_leaks=0")
  endif()
  gtest_discover_tests(${program} DISCOVERY_TIMEOUT 60
                       PROPERTIES LABELS "${labels}" TIMEOUT 900 ${environment} ${VSGLBENCH_TEST_PROPERTIES})
  if(labels STREQUAL "gpu")
    vsglbench_install_test(${program})
  endif()
endfunction()

function(vsglbench_room name)
  cmake_parse_arguments(ROOM "PUBLIC_LIBRARY" "" "SOURCES;LINK;PRIVATE_LINK;TESTS;GPU_TESTS;SLOW_TESTS;TEST_LINK"
                        ${ARGN})
  set(target vsglbench_${name})
  set(include_root $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}/harness> $<INSTALL_INTERFACE:include/vsglbench>)
  if(ROOM_SOURCES)
    set(kind STATIC)
    if(ROOM_PUBLIC_LIBRARY)
      set(kind SHARED)
    endif()
    add_library(${target} ${kind} ${ROOM_SOURCES})
    vsglbench_options(${target})
    target_include_directories(${target} PUBLIC ${include_root})
    target_link_libraries(${target} PUBLIC ${ROOM_LINK} PRIVATE ${ROOM_PRIVATE_LINK})
  else()
    add_library(${target} INTERFACE)
    target_include_directories(${target} INTERFACE ${include_root})
    target_link_libraries(${target} INTERFACE ${ROOM_LINK})
  endif()
  if(ROOM_PUBLIC_LIBRARY)
    vsglbench_install_library(${target} ${name})
  endif()
  set(VSGLBENCH_TEST_LINK ${ROOM_TEST_LINK})
  vsglbench_tests(${target} "" "host" ${ROOM_TESTS})
  vsglbench_tests(${target} _gpu "gpu" ${ROOM_GPU_TESTS})
  vsglbench_tests(${target} _slow "gpu-slow" ${ROOM_SLOW_TESTS})
endfunction()
