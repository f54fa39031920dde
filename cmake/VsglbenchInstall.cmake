# `cmake --install build/release --prefix DIR` makes a folder that runs wherever it is copied, on a machine with a
# C library as new as the one it was built with and a Vulkan driver: the programme, the methods, everything read at
# run time, the shared libraries beside it, and what find_package(vsglbench) needs to build a method. With
# `--component tests` too, the tests that need a device and what they read: gpu-check runs them.
set(VSGLBENCH_DATA share/vsglbench)
# What every machine with a C++ runtime brings. A driver there may need a newer libstdc++ than the one built with.
set(VSGLBENCH_NOT_BUNDLED "ld-linux.*|lib(c|m|dl|rt|pthread|resolv|stdc\\+\\+|gcc_s)\\.so.*")

# A shared library that plugins link, with its headers.
function(vsglbench_install_library target room)
  set_target_properties(${target} PROPERTIES INSTALL_RPATH "$ORIGIN")
  install(TARGETS ${target} EXPORT vsglbench RUNTIME_DEPENDENCY_SET vsglbench_libraries LIBRARY DESTINATION lib)
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/harness/${room} DESTINATION include/vsglbench
          FILES_MATCHING PATTERN "*.h" PATTERN "*test*" EXCLUDE PATTERN "oracle.h" EXCLUDE)
endfunction()

function(vsglbench_install_test program)
  set_target_properties(${program} PROPERTIES INSTALL_RPATH "$ORIGIN/../lib")
  install(TARGETS ${program} RUNTIME DESTINATION tests COMPONENT tests EXCLUDE_FROM_ALL OPTIONAL)
endfunction()

function(vsglbench_install_programmes)
  set_target_properties(vsglbench vsglbench-speed PROPERTIES INSTALL_RPATH "$ORIGIN/../lib")
  install(TARGETS vsglbench EXPORT vsglbench RUNTIME_DEPENDENCY_SET vsglbench_libraries DESTINATION bin)
  install(TARGETS vsglbench-speed RUNTIME_DEPENDENCY_SET vsglbench_libraries DESTINATION bin)
  install(RUNTIME_DEPENDENCY_SET vsglbench_libraries DESTINATION lib
          PRE_EXCLUDE_REGEXES "^(${VSGLBENCH_NOT_BUNDLED})" POST_EXCLUDE_REGEXES ".*/(${VSGLBENCH_NOT_BUNDLED})"
          DIRECTORIES ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
  install(DIRECTORY harness methods DESTINATION ${VSGLBENCH_DATA}
          FILES_MATCHING PATTERN "*.glsl" PATTERN "*.comp" PATTERN "*.vert" PATTERN "*.frag" PATTERN "types.h"
          PATTERN "*.schema.json" PATTERN "render_cycles.py" PATTERN "exported/README.md" PATTERN "claims.json" PATTERN "exhibits.json" PATTERN "*_test.comp" EXCLUDE PATTERN "*_naive.comp" EXCLUDE PATTERN "naive" EXCLUDE)
  install(DIRECTORY harness DESTINATION ${VSGLBENCH_DATA} COMPONENT tests EXCLUDE_FROM_ALL
          FILES_MATCHING PATTERN "*_test.comp" PATTERN "*_naive.comp" PATTERN "naive/*" PATTERN "*.csv")
  install(PROGRAMS ci/gpu-check DESTINATION .)
  install(DIRECTORY methods/_template methods/_template_workgroup DESTINATION ${VSGLBENCH_DATA}/methods)
  install(DIRECTORY scenes configs DESTINATION ${VSGLBENCH_DATA})
  install(FILES README.md LICENSE DESTINATION ${VSGLBENCH_DATA})
  install(FILES methods/README.md DESTINATION ${VSGLBENCH_DATA}/methods)
  install(EXPORT vsglbench NAMESPACE vsglbench:: DESTINATION lib/cmake/vsglbench FILE vsglbench-targets.cmake)
  install(FILES cmake/vsglbench-config.cmake cmake/VsglbenchMethod.cmake cmake/EmbedKernels.cmake DESTINATION lib/cmake/vsglbench)
  if(BUILD_TESTING AND NOT VSGLBENCH_SANITIZE)
    add_test(NAME install.folder COMMAND ${CMAKE_SOURCE_DIR}/ci/check-install ${CMAKE_BINARY_DIR})
    set_tests_properties(install.folder PROPERTIES LABELS "host" TIMEOUT 300)
    add_test(NAME install.size COMMAND ${CMAKE_SOURCE_DIR}/ci/check-install ${CMAKE_BINARY_DIR} --size)
    add_test(NAME install.bare COMMAND ${CMAKE_SOURCE_DIR}/ci/check-bare ${CMAKE_BINARY_DIR})
    set_tests_properties(install.size install.bare PROPERTIES LABELS "slow" TIMEOUT 1800)
    add_test(NAME gpu-check COMMAND ${CMAKE_SOURCE_DIR}/ci/gpu-check-test)
    set_tests_properties(gpu-check PROPERTIES LABELS "host" TIMEOUT 300)
  endif()
  # The same for the build folder, so that a method can be built against it without installing.
  set(package ${CMAKE_BINARY_DIR}/lib/cmake/vsglbench)
  export(EXPORT vsglbench NAMESPACE vsglbench:: FILE ${package}/vsglbench-targets.cmake)
  configure_file(cmake/vsglbench-config.cmake ${package}/vsglbench-config.cmake COPYONLY)
  configure_file(cmake/VsglbenchMethod.cmake ${package}/VsglbenchMethod.cmake COPYONLY)
  configure_file(cmake/EmbedKernels.cmake ${package}/EmbedKernels.cmake COPYONLY)
endfunction()
