#include "method/kept_kernels.h"

#include "base/file.h"
#include "base/hash.h"

namespace fs = std::filesystem;

namespace vsglbench {

fs::path unpack_kernels(const char* const* files) {
  if (!files) return {};
  Hasher hasher;
  for (auto file = files; *file; ++file) hasher.text(*file);
  const fs::path folder = fs::absolute(cache_directory()) / "kernels" / hasher.hex();
  std::error_code ec;
  for (auto file = files; *file; file += 2) {
    const fs::path path = folder / file[0];
    if (!fs::is_regular_file(path, ec) || read_text(path) != file[1]) write_text(path, file[1]);
  }
  return folder / "kernels";
}

fs::path kept_includes(const fs::path& folder) {
  std::error_code ec;
  const fs::path included = folder.parent_path() / "included";
  const bool kept = folder.filename() == "kernels" || folder.filename() == "included";
  return kept && fs::is_directory(included, ec) ? included : fs::path();
}

}  // namespace vsglbench
