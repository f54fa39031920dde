# vsglbench_methods(FOLDER ...): the methods, in the order in which they are listed and run. Each folder
# holds <folder>.cpp, which defines `const vsglbench::MethodInfo& method_<folder>()`, and its kernels, which
# are compiled at run time.
function(vsglbench_methods)
  set(declarations "")
  set(entries "")
  set(sources "")
  foreach(folder ${ARGN})
    string(APPEND declarations "const MethodInfo& method_${folder}();\n")
    string(APPEND entries "      &method_${folder}(),\n")
    list(APPEND sources ${folder}/${folder}.cpp)
  endforeach()
  set(registry ${CMAKE_CURRENT_BINARY_DIR}/registry.cpp)
  file(CONFIGURE OUTPUT ${registry} @ONLY CONTENT
"#include \"base/nearest.h\"
#include \"method/method.h\"
namespace vsglbench {
@declarations@
const std::vector<const MethodInfo*>& all_methods() {
  static const std::vector<const MethodInfo*> methods = {
@entries@  };
  return methods;
}
const MethodInfo& find_method(const std::string& name) {
  std::vector<std::string> known;
  for (const MethodInfo* method : all_methods()) {
    if (method->name == name) return *method;
    known.push_back(method->name);
  }
  throw Error(ErrorKind::config, \"no method '\" + name + \"'\" + suggestion(name, known));
}
}
")
  add_library(vsglbench_methods STATIC ${registry} ${sources})
  vsglbench_options(vsglbench_methods)
  target_link_libraries(vsglbench_methods PUBLIC vsglbench_method)
endfunction()
