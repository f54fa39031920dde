# find_package(vsglbench): vsglbench_method() builds a method as a plugin; see methods/README.md.
include(CMakeFindDependencyMacro)
find_dependency(Threads)
find_dependency(fmt)
find_dependency(nlohmann_json)
find_dependency(glm)
find_dependency(Vulkan)
include(${CMAKE_CURRENT_LIST_DIR}/vsglbench-targets.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/VsglbenchMethod.cmake)
