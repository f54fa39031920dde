// What every image that this programme writes says of itself (image/labelled.h).
#pragma once

#include <string>

#include "image/labelled.h"

namespace vsglbench {

// `content`: what it shows, in words. The scene and its content hash, where it shows one; software and
// commit.
Labels image_labels(const std::string& content, const std::string& scene = "", const std::string& hash = "");

// The same of an image of radiance: its units, too, and what A means.
Labels radiance_image_labels(const std::string& content, const std::string& scene, const std::string& hash);

}  // namespace vsglbench
