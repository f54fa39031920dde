# cmake -DOUT=x.cpp -DKERNELS=DIR -DHARNESS=DIR -P EmbedKernels.cmake
# Writes a C++ file that holds a method's kernels and all that they may include, as pairs of name and text: with them a
# plugin that was copied by itself keeps what it was built with (harness/method/registry.cpp).
set(text "// Made by EmbedKernels.cmake.\nextern \"C\" {\nextern const char* const vsglbench_kernels[];\nconst char* const vsglbench_kernels[] = {\n")
function(embed as)
  foreach(file ${ARGN})
    get_filename_component(name ${file} NAME)
    file(READ ${file} content)
    string(APPEND text "\"${as}/${name}\", R\"vsglbench(${content})vsglbench\",\n")
  endforeach()
  set(text "${text}" PARENT_SCOPE)
endfunction()
file(GLOB own ${KERNELS}/*.comp ${KERNELS}/*.glsl)
file(GLOB shared ${HARNESS}/shaders/*.glsl ${HARNESS}/shaders/types.h ${HARNESS}/method/shaders/*)
embed(kernels ${own})
embed(included ${shared})
string(APPEND text "nullptr};\n}\n")
file(WRITE ${OUT} "${text}")
