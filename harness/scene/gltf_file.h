// The container level of glTF: a parsed model whose every reference is still to be checked.
#pragma once

#include <tiny_gltf.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/error.h"

namespace vsglbench {

struct GltfFile {
  std::filesystem::path path;
  tinygltf::Model model;  // buffers loaded; images hold their encoded bytes, or nothing when in a buffer view
  std::vector<std::string> warnings;

  // Error(scene) "PATH: MESSAGE".
  template <class... Args>
  Error error(fmt::format_string<Args...> format, Args&&... args) const {
    return fail(ErrorKind::scene, "{}: {}", path.string(), fmt::format(format, std::forward<Args>(args)...));
  }
  // Adds a warning unless it is already listed.
  void warn(const std::string& message);
  // Of many warnings of a kind only the first is listed, with how many there are besides.
  void warn_once(const std::string& kind, const std::string& message);
  void end_warnings();  // lists those of warn_once()

 private:
  struct Repeated {
    std::string first;
    size_t count = 0;
  };
  std::map<std::string, Repeated> repeated_;
};

// Reads .gltf or .glb (told apart by the magic bytes) with its external buffers and images, looked up beside
// the file only. Throws Error(scene) for a missing or malformed file and for required extensions that are not
// read.
GltfFile read_gltf(const std::filesystem::path& path);

// Bytes of a buffer view, range-checked against its buffer. `what` names the user of the view in the error.
struct ByteRange {
  const uint8_t* data = nullptr;
  size_t size = 0;
};
ByteRange view_bytes(const GltfFile& file, int buffer_view, const std::string& what);

// `list[index]`, or Error(scene) naming both.
template <class T>
const T& element(const GltfFile& file, const std::vector<T>& list, int index, const std::string& what) {
  if (index < 0 || static_cast<size_t>(index) >= list.size()) {
    throw file.error("{}: index {} is past the {} there are", what, index, list.size());
  }
  return list[static_cast<size_t>(index)];
}

// Components of an accessor as doubles, `components` an element (its type must have that many), normalised
// integers mapped to [0,1] or [-1,1]; sparse values applied. Throws Error(scene) where it leaves its buffer
// view or, unless any will do, holds a NaN or infinity.
enum class Numbers { finite, any };
std::vector<double> read_accessor(const GltfFile& file, int accessor, int components, const std::string& what,
                                  Numbers numbers = Numbers::finite);

// A scalar accessor of unsigned integers.
std::vector<uint32_t> read_indices(const GltfFile& file, int accessor, const std::string& what);

}  // namespace vsglbench
