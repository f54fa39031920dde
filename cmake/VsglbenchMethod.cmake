# vsglbench_method(NAME [SOURCES ...] [NOT_INSTALLED])
# The method NAME as a plugin: a shared library made of <folder>.cpp (NAME with '_' for '-') and SOURCES, in the
# plugin folder; beside it a folder NAME, a link to this one, from which its kernels are compiled at run time; a copy of
# the library under another name has those that it was built with. Its
# test, `conformance.NAME`, is `vsglbench check-method`. Works in the tree and after find_package(vsglbench).
include(GNUInstallDirs)

# The kernels of folder KERNELS and all that they may include, compiled into `target`.
function(vsglbench_embed_kernels target kernels)
  set(harness ${CMAKE_SOURCE_DIR}/harness)
  if(NOT TARGET vsglbench_method)
    get_target_property(includes vsglbench::vsglbench_method INTERFACE_INCLUDE_DIRECTORIES)
    foreach(candidate ${includes} ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../../../share/vsglbench/harness)
      if(EXISTS ${candidate}/shaders/types.h AND EXISTS ${candidate}/shaders/warp.glsl)
        set(harness ${candidate})
      endif()
    endforeach()
  endif()
  set(script ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/EmbedKernels.cmake)
  set(out ${CMAKE_CURRENT_BINARY_DIR}/${target}_kernels.cpp)
  file(GLOB read CONFIGURE_DEPENDS ${kernels}/*.comp ${kernels}/*.glsl ${harness}/shaders/*.glsl
       ${harness}/shaders/types.h ${harness}/method/shaders/*)
  add_custom_command(OUTPUT ${out} DEPENDS ${read} ${script}
                     COMMAND ${CMAKE_COMMAND} -DOUT=${out} -DKERNELS=${kernels} -DHARNESS=${harness} -P ${script}
                     VERBATIM)
  target_sources(${target} PRIVATE ${out})
endfunction()

function(vsglbench_method name)
  cmake_parse_arguments(METHOD "NOT_INSTALLED" "" "SOURCES" ${ARGN})
  string(REPLACE "-" "_" folder ${name})
  set(target vsglbench_method_${folder})
  if(TARGET vsglbench_method)
    set(plugins ${CMAKE_BINARY_DIR}/lib/vsglbench/plugins)  # where the built programme looks
  else()
    set(plugins ${CMAKE_BINARY_DIR}/plugins)
  endif()
  add_library(${target} MODULE ${folder}.cpp ${METHOD_SOURCES})
  target_compile_features(${target} PRIVATE cxx_std_20)
  set_target_properties(${target} PROPERTIES PREFIX "" SUFFIX ".so" OUTPUT_NAME ${name}
                        LIBRARY_OUTPUT_DIRECTORY ${plugins} INSTALL_RPATH "$ORIGIN/../..")
  if(TARGET vsglbench_method)
    vsglbench_options(${target})
    target_link_libraries(${target} PRIVATE vsglbench_method)
    set(programme $<TARGET_FILE:vsglbench>)
    set_property(GLOBAL APPEND PROPERTY VSGLBENCH_METHODS ${target})
  else()
    target_link_libraries(${target} PRIVATE vsglbench::vsglbench_method)
    # The programme that opens the plugin holds its libraries already. A path of its own would be unsafe where a library
    # of the same name stands in a folder of the system, too.
    set_target_properties(${target} PROPERTIES BUILD_WITH_INSTALL_RPATH ON)
    set(programme $<TARGET_FILE:vsglbench::vsglbench>)
  endif()
  vsglbench_embed_kernels(${target} ${CMAKE_CURRENT_SOURCE_DIR})
  file(MAKE_DIRECTORY ${plugins})
  file(RELATIVE_PATH kernels ${plugins} ${CMAKE_CURRENT_SOURCE_DIR})  # in a copied tree, the copy's
  file(CREATE_LINK ${kernels} ${plugins}/${name} SYMBOLIC)
  add_test(NAME conformance.${name} COMMAND ${programme} check-method $<TARGET_FILE:${target}>)
  set_tests_properties(conformance.${name} PROPERTIES LABELS gpu TIMEOUT 900)
  if(VSGLBENCH_SANITIZE)  # as in VsglbenchRoom.cmake
    set_tests_properties(conformance.${name} PROPERTIES ENVIRONMENT "ASAN_OPTIONS=detect_leaks=0")
  endif()
  if(NOT METHOD_NOT_INSTALLED)
    install(TARGETS ${target} LIBRARY DESTINATION lib/vsglbench/plugins)
    install(DIRECTORY ./ DESTINATION lib/vsglbench/plugins/${name}
            FILES_MATCHING PATTERN "*.comp" PATTERN "*.glsl" PATTERN "build*" EXCLUDE)
  endif()
endfunction()
