#include "gpu/spirv_cache.h"

#include <atomic>
#include <cstring>
#include <string>

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/log.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

constexpr size_t kHashDigits = 32;

}  // namespace

bool read_cached_spirv(const fs::path& path, std::vector<uint32_t>* spirv) {
  std::error_code ec;
  if (!fs::is_regular_file(path, ec)) return false;
  const std::string text = read_text(path);
  if (text.size() <= kHashDigits || (text.size() - kHashDigits) % 4 != 0) return false;
  spirv->resize((text.size() - kHashDigits) / 4);
  std::memcpy(spirv->data(), text.data() + kHashDigits, text.size() - kHashDigits);
  return Hasher().array(*spirv).hex() == text.substr(0, kHashDigits);
}

void write_cached_spirv(const fs::path& path, const std::vector<uint32_t>& spirv) {
  try {
    const std::string words(reinterpret_cast<const char*>(spirv.data()), spirv.size() * 4);
    write_text(path, Hasher().array(spirv).hex() + words);
  } catch (const Error& e) {
    // A cache that can't be written costs time, not the run; once is enough to say so.
    static std::atomic_flag told;
    if (!told.test_and_set()) log_warning("shader cache: {}", e.what());
  }
}

}  // namespace vsglbench
