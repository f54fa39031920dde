// Whether a device rasterises slowly for what it computes: many data-centre GPUs draw with few of their
// units.
#pragma once

#include <optional>

#include "report/report.h"

namespace vsglbench {

// How many times as long the G-buffer takes to draw as `generate.gbuffer.resolve`, a compute pass that writes
// 80 bytes for every pixel of it: about as many as drawing writes. The least over all cases, medians, of
// scenes with fewer triangles than a quarter of the pixels, where drawing is a matter of pixels. 1 to 3 on a
// GPU whose raster keeps pace with its memory; 27 to 72 on an H200. Nothing where no case has both passes.
std::optional<double> raster_ratio(const Report& report);

inline constexpr double kSlowRaster = 8;  // from this ratio on a GPU's raster is called slow

}  // namespace vsglbench
