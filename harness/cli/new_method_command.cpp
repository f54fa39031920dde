#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>

#include "base/error.h"
#include "base/file.h"
#include "base/pattern.h"
#include "cli/command.h"
#include "method/registry.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

struct NewMethod {
  std::string name, folder_name;  // "my-method", "my_method"
  fs::path folder;
};

std::string replace_all(std::string text, const std::string& what, const std::string& with) {
  for (size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size()) {
    text.replace(at, what.size(), with);
  }
  return text;
}

// A word of a shell's command line.
std::string quoted(const std::string& word) {
  static const Pattern plain("^[A-Za-z0-9_./:=@%+,-]+$");
  return plain.search(word) ? word : "'" + replace_all(word, "'", "'\\''") + "'";
}

// Neither CMake nor a printed command can hold such a path.
void refuse_odd_folder(const fs::path& dir) {
  const auto odd = [](unsigned char c) { return c < 32 || c == 127 || std::strchr("\"\\;$", c) != nullptr; };
  if (std::ranges::any_of(fs::absolute(dir).string(), odd)) {
    throw fail(ErrorKind::usage,
               "--dir: its path holds a quotation mark, backslash, semicolon, dollar or control character, "
               "which CMake can't take; choose another folder");
  }
}

NewMethod checked(const std::string& name, const fs::path& dir) {
  refuse_odd_folder(dir);
  if (!Pattern("^[a-z][a-z0-9]*(-[a-z0-9]+)*$").search(name)) {
    throw fail(ErrorKind::usage,
               "'{}' can't name a method; use lower-case letters, digits and single dashes, as in my-method",
               name);
  }
  for (const MethodInfo* method : all_methods()) {
    if (method->name == name) {
      throw fail(ErrorKind::usage, "a method '{}' exists already: {}", name, method->library.string());
    }
  }
  std::string folder = name;
  std::replace(folder.begin(), folder.end(), '-', '_');
  std::error_code ec;
  if (fs::exists(dir / folder, ec)) {
    throw fail(ErrorKind::usage, "{}: exists already; choose another name or --dir", (dir / folder).string());
  }
  return {name, folder, dir / folder};
}

// The template's folder over that of the first one, which has what all have.
std::vector<std::string> folders_of(const std::string& which) {
  if (which == "thread") return {"_template"};
  return {"_template", "_template_" + which};
}

void write_files(const NewMethod& method, const fs::path& from) {
  std::error_code ec;
  if (!fs::is_directory(from, ec)) {
    throw fail(ErrorKind::config, "{}: the template is missing; `vsglbench doctor` says more", from.string());
  }
  for (const auto& entry : fs::directory_iterator(from)) {
    const auto renamed = [&](const std::string& text) {
      return replace_all(replace_all(text, "my-method", method.name), "my_method", method.folder_name);
    };
    write_text(method.folder / renamed(entry.path().filename()), renamed(read_text(entry.path())));
  }
}

// Among the methods of a source tree: its one line. False anywhere else.
bool join_tree(const NewMethod& method) {
  const fs::path list = method.folder.parent_path() / "CMakeLists.txt";
  std::error_code ec;
  if (!fs::exists(list, ec)) return false;
  std::string text = read_text(list);
  const size_t last = text.rfind("add_subdirectory(");
  if (last == std::string::npos || text.find("VSGLBENCH_METHODS") == std::string::npos) return false;
  text.insert(text.find('\n', last) + 1, fmt::format("add_subdirectory({})\n", method.folder_name));
  write_text(list, text);
  return true;
}

void print_next_steps(const NewMethod& method, bool in_tree) {
  const std::string folder = method.folder.string(), build = (method.folder / "build").string();
  const std::string absolute = fs::absolute(method.folder).lexically_normal().string();
  fmt::print("wrote {}\n", folder);
  if (in_tree) {
    fmt::print(
        "added it to {}\nbuild it:   ci/build\ntest it:    ctest --preset release -R conformance.{}$\n",
        (method.folder.parent_path() / "CMakeLists.txt").string(), method.name);
    return;
  }
  fmt::print(
      "build it:   cmake -S {} -B {} -DCMAKE_BUILD_TYPE=Release {} && cmake --build {}\n"
      "test it:    ctest --test-dir {} --output-on-failure\n"
      "use it:     export {}; vsglbench list methods\n",
      quoted(folder), quoted(build),
      quoted("-DCMAKE_PREFIX_PATH=" + library_directory().parent_path().string()), quoted(build),
      quoted(build), quoted("VSGLBENCH_PLUGINS=" + absolute + "/build/plugins"));
}

}  // namespace

void add_new_method_command(CLI::App& app, CommandResult*) {
  auto name = std::make_shared<std::string>();
  auto dir = std::make_shared<fs::path>(".");
  auto which = std::make_shared<std::string>("thread");
  CLI::App* command = app.add_subcommand("new-method", "write the folder of a new method");
  command->footer(
      "Templates: thread     one invocation a light, from a texel that the PDF draws\n"
      "           workgroup  one workgroup a light, which sums the texels of a tile\n"
      "Example: vsglbench new-method my-method --dir ~/methods");
  command->add_option("name", *name, "as configs will name it: lower-case letters, digits, dashes")
      ->required();
  command->add_option("--dir", *dir, "where its folder goes (default: here); in a source tree: methods");
  command->add_option("--template", *which, "what is written")
      ->check(CLI::IsMember({"thread", "workgroup"}))
      ->capture_default_str();
  command->callback([=] {
    const NewMethod method = checked(*name, *dir);
    for (const auto& folder : folders_of(*which)) write_files(method, data_root() / "methods" / folder);
    print_next_steps(method, join_tree(method));
  });
}

}  // namespace vsglbench
