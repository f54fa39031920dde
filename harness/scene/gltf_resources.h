// The bytes that a glTF file's JSON refers to: buffers and encoded images (glTF 2.0, 3.6.1 and 3.8.3).
#pragma once

#include <span>

#include "base/json.h"
#include "scene/gltf_file.h"

namespace vsglbench {

// Fills the model's buffers from files beside the file, data URIs, and `chunk`, the binary one of a .glb.
// What is longer than its byteLength is cut to it: that is padding. Error(scene) for what is missing, shorter
// or elsewhere.
void read_buffers(GltfFile* file, const Json& root, std::span<const uint8_t> chunk);

// Fills the model's images: the encoded bytes of files and data URIs, whatever their MIME type says. One that
// is missing has none; it is an error of the material that uses it.
void read_images(GltfFile* file, const Json& root);

}  // namespace vsglbench
