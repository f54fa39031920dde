#include "base/file.h"

#include <dlfcn.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>

#include "base/error.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

template <class Container>
Container read_all(const fs::path& path) {
  std::error_code ec;
  if (fs::is_directory(path, ec)) throw fail(ErrorKind::output, "{}: is a folder, not a file", path.string());
  std::ifstream in(path, std::ios::binary);
  if (!in) throw fail(ErrorKind::output, "{}: cannot be read: {}", path.string(), std::strerror(errno));
  if (!fs::is_regular_file(path, ec))  // a pipe has no size
    return Container(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  const auto size = fs::file_size(path, ec);
  Container out(ec ? 0 : size, '\0');
  in.read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(out.size()));
  if (in.bad()) throw fail(ErrorKind::output, "{}: read error", path.string());
  out.resize(static_cast<size_t>(in.gcount()));
  return out;
}

fs::path temporary_beside(const fs::path& path) {
  static std::atomic<unsigned> serial{0};
  char host[64] = {};  // two machines may write to one file system under one process number
  ::gethostname(host, sizeof host - 1);
  return path.parent_path() / fmt::format(".{}.{}.{}.{}.tmp{}", path.stem().string(), host, ::getpid(),
                                          serial++, path.extension().string());
}

// A device or a pipe.
bool is_special(const fs::path& path) {
  std::error_code ec;
  return fs::exists(path, ec) && !fs::is_regular_file(path, ec) && !fs::is_directory(path, ec);
}

}  // namespace

std::string read_text(const fs::path& path) { return read_all<std::string>(path); }
std::vector<uint8_t> read_bytes(const fs::path& path) { return read_all<std::vector<uint8_t>>(path); }

void write_atomically(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  std::error_code ec;
  if (path.has_parent_path()) fs::create_directories(path.parent_path(), ec);
  if (ec) {
    throw fail(ErrorKind::output, "{}: cannot create the folder: {}", path.parent_path().string(),
               ec.message());
  }
  if (fs::is_directory(path, ec))
    throw fail(ErrorKind::output, "{}: is a folder; name a file in it", path.string());
  // A device or a pipe is written to, by its own name: what /dev/stdout points to may have none. What a link
  // to a file points to is replaced, not the link.
  const bool special = is_special(path);
  const fs::path target = !special && fs::is_symlink(path, ec) ? fs::weakly_canonical(path) : path;
  const fs::path temporary = special ? target : temporary_beside(target);
  // What went wrong, without the temporary's name.
  const auto failed = [&](const std::string& why) {
    std::error_code ignored;
    if (!special) fs::remove(temporary, ignored);
    return fail(ErrorKind::output, "{}: cannot be written: {}", path.string(), why);
  };
  try {
    write(temporary);
    if (!special) fs::rename(temporary, target);
  } catch (const fs::filesystem_error& e) {
    throw failed(e.code().message());
  } catch (const std::exception& e) {
    throw failed(e.what());
  }
}

void write_text(const fs::path& path, std::string_view text) {
  write_atomically(path, [&](const fs::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    out.flush();
    if (!out) throw std::runtime_error(std::strerror(errno));
  });
}

void ensure_writable_directory(const fs::path& dir) {
  std::error_code ec;
  fs::create_directories(dir, ec);
  if (ec) throw fail(ErrorKind::output, "{}: cannot create the folder: {}", dir.string(), ec.message());
  const fs::path probe = dir / fmt::format(".probe.{}", ::getpid());
  write_text(probe, "probe");
  fs::remove(probe, ec);
}

fs::path cache_directory() {
  const auto env = [](const char* name) -> std::string {
    const char* v = std::getenv(name);
    return v ? v : "";
  };
  if (auto v = env("VSGLBENCH_CACHE"); !v.empty()) return v;
  if (auto v = env("XDG_CACHE_HOME"); !v.empty()) return fs::path(v) / "vsglbench";
  if (auto v = env("HOME"); !v.empty()) return fs::path(v) / ".cache" / "vsglbench";
  return fs::path(".cache") / "vsglbench";
}

fs::path library_directory() {
  Dl_info info{};
  ::dladdr(reinterpret_cast<const void*>(&library_directory), &info);
  std::error_code ec;
  const fs::path library = fs::canonical(info.dli_fname ? info.dli_fname : "/proc/self/exe", ec);
  return library.parent_path();
}

namespace {

// The source tree that the build folder with these libraries stands in relation to. A build folder copied by
// itself would read the kernels of the tree that it came from, whatever they have become since: that is
// refused.
fs::path source_tree(const fs::path& libraries) {
  std::error_code ec;
  std::istringstream written(read_text(libraries / "source-tree"));  // by CMake
  std::string source_line, built_line;
  std::getline(written, source_line);
  std::getline(written, built_line);
  const fs::path source = source_line, built = built_line;
  if (fs::equivalent(libraries, built, ec)) return source;
  const fs::path beside = (libraries / source.lexically_relative(built)).lexically_normal();
  if (fs::exists(beside / "harness" / "shaders", ec) && !fs::equivalent(beside, source, ec)) return beside;
  throw fail(ErrorKind::usage,
             "{} is a copy of the build folder of {} without its source tree: copy both, use cmake "
             "--install, or name a "
             "tree in VSGLBENCH_ROOT",
             libraries.string(), source.string());
}

}  // namespace

fs::path data_root() {
  if (const char* v = std::getenv("VSGLBENCH_ROOT"); v && *v) return v;
  std::error_code ec;
  const fs::path installed = library_directory().parent_path() / "share" / "vsglbench";
  if (fs::exists(installed / "harness" / "shaders", ec)) return installed;
  return source_tree(library_directory());
}

}  // namespace vsglbench
