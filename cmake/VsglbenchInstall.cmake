# `cmake --install build/release --prefix DIR` makes a folder that runs wherever it is copied, on a machine with a
# C library as new as the one it was built with and a Vulkan driver: the programme, the methods, everything read at
# run time, the shared libraries beside it, and what find_package(vsglbench) needs to build a method.
set(VSGLBENCH_DATA share/vsglbench)

# A shared library that plugins link, with its headers.
function(vsglbench_install_library target room)
  set_target_properties(${target} PROPERTIES INSTALL_RPATH "$ORIGIN")
  install(TARGETS ${target} EXPORT vsglbench RUNTIME_DEPENDENCY_SET vsglbench_libraries LIBRARY DESTINATION lib)
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/harness/${room} DESTINATION include/vsglbench
          FILES_MATCHING PATTERN "*.h" PATTERN "*test*" EXCLUDE PATTERN "oracle.h" EXCLUDE)
endfunction()

function(vsglbench_install_programmes)
  set_target_properties(vsglbench vsglbench-speed PROPERTIES INSTALL_RPATH "$ORIGIN/../lib")
  install(TARGETS vsglbench EXPORT vsglbench RUNTIME_DEPENDENCY_SET vsglbench_libraries DESTINATION bin)
  install(TARGETS vsglbench-speed RUNTIME_DEPENDENCY_SET vsglbench_libraries DESTINATION bin)
  install(RUNTIME_DEPENDENCY_SET vsglbench_libraries DESTINATION lib
          PRE_EXCLUDE_REGEXES "^ld-linux" "^lib(c|m|dl|rt|pthread|resolv)\\.so"
          POST_EXCLUDE_REGEXES ".*/ld-linux.*" ".*/lib(c|m|dl|rt|pthread|resolv)\\.so.*"
          DIRECTORIES ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
  install(DIRECTORY harness methods DESTINATION ${VSGLBENCH_DATA}
          FILES_MATCHING PATTERN "*.glsl" PATTERN "*.comp" PATTERN "*.vert" PATTERN "*.frag" PATTERN "types.h"
          PATTERN "*.schema.json" PATTERN "render_cycles.py" PATTERN "exported/README.md" PATTERN "claims.json" PATTERN "exhibits.json" PATTERN "*_test.comp" EXCLUDE PATTERN "*_naive.comp" EXCLUDE PATTERN "naive" EXCLUDE)
  install(DIRECTORY methods/_template methods/_template_workgroup DESTINATION ${VSGLBENCH_DATA}/methods)
  install(DIRECTORY scenes configs DESTINATION ${VSGLBENCH_DATA})
  install(FILES README.md LICENSE DESTINATION ${VSGLBENCH_DATA})
  install(FILES methods/README.md DESTINATION ${VSGLBENCH_DATA}/methods)
  install(EXPORT vsglbench NAMESPACE vsglbench:: DESTINATION lib/cmake/vsglbench FILE vsglbench-targets.cmake)
  install(FILES cmake/vsglbench-config.cmake cmake/VsglbenchMethod.cmake cmake/EmbedKernels.cmake DESTINATION lib/cmake/vsglbench)
  # The same for the build folder, so that a method can be built against it without installing.
  set(package ${CMAKE_BINARY_DIR}/lib/cmake/vsglbench)
  export(EXPORT vsglbench NAMESPACE vsglbench:: FILE ${package}/vsglbench-targets.cmake)
  configure_file(cmake/vsglbench-config.cmake ${package}/vsglbench-config.cmake COPYONLY)
  configure_file(cmake/VsglbenchMethod.cmake ${package}/VsglbenchMethod.cmake COPYONLY)
  configure_file(cmake/EmbedKernels.cmake ${package}/EmbedKernels.cmake COPYONLY)
endfunction()
