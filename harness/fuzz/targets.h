// What reads a file that anybody may have written, as functions of the file's bytes: for libFuzzer (ci/fuzz)
// and for the tests.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vsglbench::fuzz {

using Bytes = std::span<const uint8_t>;

// Each returns whether the bytes were read or else refused, whatever they are. An exception is a fault:
// std::logic_error where what was read breaks the reader's promise.
bool read_gltf(Bytes bytes);             // .gltf or .glb
bool read_scene(Bytes bytes);            // scene.json, with triangle.gltf beside it
bool read_config(Bytes bytes);           // a config; or the preset "p", a byte 0, and a config
bool read_exr(Bytes bytes);              // an EXR with any layers
bool read_reference_cache(Bytes bytes);  // the file that pack_reference() makes of two
bool read_spirv_cache(Bytes bytes);      // a cached kernel
bool read_sg_rows(Bytes bytes);          // a byte for the function, one for the diffuse model, and CSV

struct Target {
  std::string_view name;
  bool (*read)(Bytes bytes);
};
const std::vector<Target>& targets();

// A cached reference as one file: the length of the .json in two bytes, lowest first; the .json; the .exr.
std::string pack_reference(std::string_view json, std::string_view exr);
constexpr const char* kReferenceHash = "0123456789abcdef0123456789abcdef";
constexpr uint32_t kReferenceWidth = 8, kReferenceHeight = 4;

}  // namespace vsglbench::fuzz
