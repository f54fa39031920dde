#include <cstring>
#include <sstream>
#include <stdexcept>

#include "fuzz/input.h"
#include "fuzz/targets.h"
#include "gpu/spirv_cache.h"
#include "operation/sg_rows.h"

namespace vsglbench::fuzz {

bool read_spirv_cache(Bytes bytes) {
  // As words, they come back as they were written.
  std::vector<uint32_t> words(bytes.size() / 4), read;
  if (!words.empty()) std::memcpy(words.data(), bytes.data(), words.size() * 4);
  const auto kept = folder() / "words.spv";
  write_cached_spirv(kept, words);
  if (!words.empty() && (!read_cached_spirv(kept, &read) || read != words))
    throw std::logic_error("read_cached_spirv lost what write_cached_spirv wrote");
  const auto path = write_input("input.spv", bytes);
  return read_cached_spirv(path, &read);
}

bool read_sg_rows(Bytes bytes) {
  if (bytes.size() < 2) return false;
  SgQuestion question{static_cast<SgFunction>(bytes[0] % sg_functions().size())};
  question.model = static_cast<exact::DiffuseModel>(bytes[1] % exact::diffuse_model_names().size());
  std::istringstream text(std::string(bytes.begin() + 2, bytes.end()));
  std::vector<float> rows;
  if (!accepts([&] { rows = parse_sg_rows(question, "input.csv", text); })) return false;
  const size_t columns = question.info().columns.size();
  if (rows.size() % columns != 0) throw std::logic_error("parse_sg_rows made half a row");
  for (size_t at = 0; at < rows.size(); at += columns) {
    const std::string what = out_of_domain(question, std::span(rows).subspan(at, columns));
    if (!what.empty()) throw std::logic_error("parse_sg_rows accepted a row outside its domain: " + what);
  }
  return true;
}

}  // namespace vsglbench::fuzz
