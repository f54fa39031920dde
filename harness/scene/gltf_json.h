// From a glTF file's JSON to what the parser behind it takes: it refuses some of what is valid.
#pragma once

#include "base/json.h"
#include "scene/gltf_file.h"

namespace vsglbench {

// Error(scene) unless the file says it is of glTF 2.
void check_version(const GltfFile& file, const Json& root);

// Parses all of the model but its buffers and images, which read_buffers() and read_images() fill. Strings
// are cut to excerpts: from here on nothing of the file steers a terminal.
void parse_model(GltfFile* file, Json root);

}  // namespace vsglbench
