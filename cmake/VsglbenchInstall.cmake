# `cmake --install build/release --prefix DIR` makes a folder that runs wherever it is copied, on a machine with a
# C library as new as the one it was built with and a Vulkan driver: the binary, everything it reads at run time,
# and the shared libraries beside it.
set_target_properties(vsglbench vsglbench-speed PROPERTIES INSTALL_RPATH "$ORIGIN/../lib")
install(TARGETS vsglbench vsglbench-speed RUNTIME_DEPENDENCY_SET vsglbench_libraries DESTINATION ${CMAKE_INSTALL_BINDIR})
install(RUNTIME_DEPENDENCY_SET vsglbench_libraries DESTINATION lib
        PRE_EXCLUDE_REGEXES "^ld-linux" "^lib(c|m|dl|rt|pthread|resolv)\\.so"
        POST_EXCLUDE_REGEXES ".*/ld-linux.*" ".*/lib(c|m|dl|rt|pthread|resolv)\\.so.*")
set(data share/vsglbench)
install(DIRECTORY harness methods DESTINATION ${data}
        FILES_MATCHING PATTERN "*.glsl" PATTERN "*.comp" PATTERN "*.vert" PATTERN "*.frag" PATTERN "types.h"
        PATTERN "*.schema.json")
install(DIRECTORY scenes configs DESTINATION ${data})
install(FILES README.md LICENSE DESTINATION ${data})
