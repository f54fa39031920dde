#include "run/view_sheet.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/file.h"
#include "image/canvas.h"
#include "image/metrics.h"
#include "image/theme.h"
#include "lights/picture_frame.h"
#include "method/registry.h"
#include "reference/direct_light.h"
#include "run/case_run.h"
#include "run/memory.h"
#include "run/runner.h"
#include "run/scene_effects.h"
#include "run/visibility_tracer.h"
#include "scene/preview.h"
#include "scene/scene_file.h"

namespace vsglbench {
namespace {

constexpr uint32_t kTile = 480;  // pixels that a tile is wide at least

struct Tile {
  std::string caption;
  Bitmap picture;
};

// By whole factors to about the width of a tile.
Bitmap enlarged(const Bitmap& picture, uint32_t width) {
  const uint32_t factor = std::max(1u, width / picture.width);
  return factor > 1 ? enlarge(picture, factor, factor) : picture;
}

Image as_image(const std::vector<glm::vec4>& map, uint32_t width, uint32_t height,
               const std::function<glm::vec3(size_t)>& color) {
  Image image(width, height);
  for (size_t i = 0; i < map.size(); ++i) image.pixels[i] = color(i);
  return image;
}

// What the RSM's texels reflect diffusely, as the light sees them.
Bitmap rsm_picture(const Frame& frame) {
  const uint32_t edge = frame.light().width;
  const auto position = download_map(frame.rsm().maps[0]), normal = download_map(frame.rsm().maps[1]);
  const bool diffuse = bool(frame.rsm().maps[3]);
  const auto reflectance =
      diffuse ? download_map(frame.rsm().maps[3]) : std::vector<glm::vec4>(position.size());
  return tone_map(as_image(position, edge, edge,
                           [&](size_t i) {
                             if (!(position[i].w > 0)) return glm::vec3(0.02f, 0.02f, 0.06f);
                             const glm::vec3 way = glm::vec3(position[i]) - frame.light().position;
                             const glm::vec3 from = frame.light().perspective != 0u
                                                        ? glm::normalize(way)
                                                        : glm::vec3(frame.light().forward);
                             const float cosine = std::abs(glm::dot(glm::vec3(normal[i]), from));
                             const glm::vec3 color = diffuse ? glm::vec3(reflectance[i]) : glm::vec3(0.5f);
                             return (0.1f + 0.9f * cosine) * color;
                           }),
                  1);
}

Bitmap normal_picture(const Frame& frame) {
  const auto position = download_map(frame.gbuffer().maps[0]), normal = download_map(frame.gbuffer().maps[1]);
  Bitmap out(frame.camera().width, frame.camera().height);
  for (size_t i = 0; i < normal.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const float value = position[i].w > 0 ? 0.5f + 0.5f * normal[i][k] : 0;
      out.bytes[3 * i + static_cast<size_t>(k)] =
          static_cast<uint8_t>(std::lround(255 * std::clamp(value, 0.0f, 1.0f)));
    }
  }
  return out;
}

// Square roots over that of the 99.5th percentile.
Bitmap pdf_picture(const std::vector<float>& pdf, uint32_t edge) {
  std::vector<float> lit;
  std::ranges::copy_if(pdf, std::back_inserter(lit), [](float v) { return v > 0; });
  float top = 1;
  if (!lit.empty()) {
    const auto at = lit.begin() + static_cast<std::ptrdiff_t>(0.995 * static_cast<double>(lit.size() - 1));
    std::ranges::nth_element(lit, at);
    top = *at;
  }
  Bitmap out(edge, edge);
  for (size_t i = 0; i < pdf.size(); ++i) {
    const auto grey =
        static_cast<uint8_t>(std::lround(255 * std::sqrt(std::clamp(pdf[i] / top, 0.0f, 1.0f))));
    std::fill_n(out.bytes.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, grey);
  }
  return out;
}

// Three in a row, each under its caption.
Bitmap arranged(const std::vector<Tile>& tiles) {
  constexpr size_t kColumns = 3;
  uint32_t width = 0, rows = 0, heights[2] = {0, 0};
  for (size_t i = 0; i < tiles.size(); ++i) {
    width = std::max(width, tiles[i].picture.width);
    rows = static_cast<uint32_t>(i / kColumns) + 1;
    heights[i / kColumns] = std::max(heights[i / kColumns], tiles[i].picture.height);
  }
  const uint32_t line = kPictureLine, gap = kPictureMargin;
  Canvas out(kColumns * width + (kColumns - 1) * gap,
             heights[0] + heights[1] + rows * line + (rows - 1) * gap, theme().paper);
  const Font font(kPictureText);
  for (size_t i = 0; i < tiles.size(); ++i) {
    const auto x = static_cast<uint32_t>(i % kColumns) * (width + gap);
    const uint32_t y = i < kColumns ? 0 : heights[0] + line + gap;
    out.text({x, y}, font.fit(tiles[i].caption, width), font, {theme().ink});
    out.picture(x, y + line, tiles[i].picture);
  }
  return out.bitmap();
}

double mean_luminance(const Image& image) {
  double sum = 0;
  for (const glm::vec3& p : image.pixels) sum += luminance(p);
  return image.pixels.empty() ? 0 : sum / static_cast<double>(image.pixels.size());
}

}  // namespace

Bitmap view_sheet(const ViewedCase& viewed, const ViewSheetOptions& options,
                  const std::function<void(const std::string&)>& now) {
  now("loading the scene");
  const Scene scene = load_scene(viewed.scene, {data_root() / "scenes", assets_directory(options.assets)});
  now("opening the device");
  Device device({.select = options.device});
  Case drawn;
  drawn.method = viewed.method;
  drawn.frame = viewed.frame;
  require_memory(device.info(), drawn);
  KernelLibrary kernels(device);
  Stage stage(device, kernels, scene);
  SceneEffects effects(scene);
  FrameParameters parameters = viewed.frame;
  parameters.effects = effects.of(parameters);
  const Tracer tracer(scene);
  WallTime wall;
  VisibilityTracer visibility(tracer, &wall);
  Frame* self = nullptr;
  now("compiling");
  Frame frame(stage, load_method(viewed.method, device.info()), viewed.method_parameters, parameters,
              [&](const std::vector<LightPoint>& lights) { return visibility.trace(*self, lights); });
  self = &frame;
  now("drawing");
  frame.render(0);
  const Image indirect = frame.results().indirect();
  const Mask mask = frame.results().surface_mask();
  const std::vector<float> pdf = frame.results().importance();
  const DirectLight direct = direct_light(tracer, parameters.width, parameters.height);
  const uint32_t height = enlarged(Bitmap(parameters.width, parameters.height), kTile).height;
  const auto wide = [](const Bitmap& b) { return enlarged(b, kTile); };
  const auto square = [&](const Bitmap& b) { return enlarged(b, height); };
  const double direct_mean = mean_luminance(direct.image), indirect_mean = mean_luminance(indirect);
  std::vector<Tile> tiles = {
      {fmt::format("direct: mean {:.3g} W/m²/sr, at an exposure of its own", direct_mean),
       wide(tone_map(direct.image, auto_exposure(direct.image, direct.mask)))},
      {fmt::format("indirect by {}, {} lights: mean {:.3g} W/m²/sr", viewed.method, frame.light_count(),
                   indirect_mean),
       wide(tone_map(indirect, auto_exposure(indirect, mask)))},
      {"normals", wide(normal_picture(frame))},
      {fmt::format("RSM, {}²: what the light sees", parameters.rsm), square(rsm_picture(frame))}};
  if (!pdf.empty())
    tiles.push_back({"PDF: where lights are drawn", square(pdf_picture(pdf, parameters.rsm))});
  const TriangleTree tree(scene);
  std::vector<std::string> notes =
      shot_notes(measure_shot(tree, {scene.camera, scene.light}, {.image = 24, .light = 24, .links = 4}));
  for (const std::string& warning : scene.warnings) notes.push_back(warning);
  return framed(arranged(tiles),
                {fmt::format("{}: {} triangles, {}×{} pixels", scene.name, scene.triangles.size(),
                             parameters.width, parameters.height)},
                notes);
}

std::vector<ViewedCase> viewed_cases(const std::vector<Case>& cases) {
  std::vector<ViewedCase> out;
  std::set<std::string> seen;
  for (const Case& c : cases)
    if (seen.insert(c.scene).second) out.push_back({c.scene, c.method, c.method_parameters, c.frame});
  return out;
}

}  // namespace vsglbench
