#include "lights/moment_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "image/canvas.h"
#include "image/metrics.h"
#include "image/theme.h"
#include "lights/picture_frame.h"
#include "method/filtered_sampling.h"

namespace vsglbench {
namespace {

constexpr uint32_t kMostWidth = 1100, kMostPixels = 16;  // of the sheet, and of a texel
constexpr uint32_t kGap = 2;                             // between levels
constexpr uint32_t kLeastPanel = 480;                    // wide, for its title

// --- from the device ---

// The vec4 buffers of a whole pyramid, as shaders/moments_buffers.glsl numbers them.
struct Stored {
  std::vector<glm::vec4> places;  // mean, E|y-mean|²
  std::vector<glm::vec4> diffuse, diffuse_directions, specular, specular_directions;
  MomentTexel texel(size_t i) const {
    MomentTexel t;
    const auto lobe = [&](const auto& powers, const auto& directions, glm::vec3* power,
                          glm::vec3* direction) {
      if (powers.empty()) return;
      *power = glm::vec3(powers[i]);
      if (luminance(*power) > 0) *direction = glm::vec3(directions[i]);
    };
    lobe(diffuse, diffuse_directions, &t.diffuse, &t.diffuse_direction);
    lobe(specular, specular_directions, &t.specular, &t.specular_direction);
    if (!(luminance(t.diffuse + t.specular) > 0)) return t;
    t.position = glm::vec3(places[i]);
    const glm::dvec3 mean(t.position);
    t.square = glm::dot(mean, mean) + double(places[i].w);
    return t;
  }
};

std::optional<Stored> download(const MethodContext& context, uint64_t texels) {
  const MomentBuffers built = built_moments(context, Half::rsm);
  if (built.buffers.empty()) return std::nullopt;
  size_t next = 0;
  const auto take = [&] { return built.buffers.at(next++)->download<glm::vec4>(texels); };
  Stored s;
  s.places = take();
  if (context.lobes() & DIFFUSE_LOBE) {
    s.diffuse = take();
    s.diffuse_directions = take();
  }
  if (context.lobes() & SPECULAR_LOBE) {
    s.specular = take();
    s.specular_directions = take();
  }
  return s;
}

// --- panels ---

using Color = glm::u8vec3;

struct Panel {
  std::string title;
  std::function<Color(const MomentTexel&)> color;
};

Color bytes(const glm::vec3& unit) { return Color(glm::round(255.0f * glm::clamp(unit, 0.0f, 1.0f))); }

Panel power_panel(const MipmappedRsm& rsm, const std::string& title, glm::vec3 MomentTexel::*power) {
  const MomentLevel& base = rsm.levels.front();
  Image image(base.width, base.height);
  Mask lit;
  for (size_t i = 0; i < base.texels.size(); ++i) {
    image.pixels[i] = base.texels[i].*power;
    lit.push_back(luminance(image.pixels[i]) > 0);
  }
  const float exposure = auto_exposure(image, lit);
  return {fmt::format("{}, times {:.3g}/W", title, exposure), [=](const MomentTexel& t) {
            const glm::vec3 v = exposure * (t.*power);
            return Color(encode_srgb(v.x), encode_srgb(v.y), encode_srgb(v.z));
          }};
}

Panel direction_panel(const std::string& title, glm::vec3 MomentTexel::*power,
                      glm::vec3 MomentTexel::*direction) {
  return {title, [=](const MomentTexel& t) {
            return luminance(t.*power) > 0 ? bytes(0.5f * (t.*direction + 1.0f)) : Color(0);
          }};
}

bool has_power(const MomentTexel& t) { return luminance(t.diffuse + t.specular) > 0; }

Panel position_panel(const SceneBox& box) {
  const glm::vec3 size = glm::max(box.high - box.low, glm::vec3(1e-30f));
  return {"(e) average position", [=](const MomentTexel& t) {
            return has_power(t) ? bytes((t.position - box.low) / size) : Color(0);
          }};
}

Panel square_panel(const SceneBox& box) {
  const glm::dvec3 corner(glm::max(glm::abs(box.low), glm::abs(box.high)));
  const double most = std::max(glm::dot(corner, corner), 1e-30);
  return {fmt::format("(f) average squared norm of the position; white: {:.3g} m²", most),
          [=](const MomentTexel& t) {
            return has_power(t) ? bytes(glm::vec3(static_cast<float>(t.square / most))) : Color(0);
          }};
}

std::vector<Panel> panels_of(const MipmappedRsm& rsm, const SceneBox& box) {
  using T = MomentTexel;
  std::vector<Panel> panels;
  const bool diffuse = rsm.lobes & DIFFUSE_LOBE, specular = rsm.lobes & SPECULAR_LOBE;
  if (diffuse) panels.push_back(power_panel(rsm, "(a) diffuse power", &T::diffuse));
  if (specular) panels.push_back(power_panel(rsm, "(b) specular power", &T::specular));
  if (diffuse)
    panels.push_back(
        direction_panel("(c) average emission direction, diffuse lobe", &T::diffuse, &T::diffuse_direction));
  if (specular)
    panels.push_back(direction_panel("(d) average emission direction, specular lobe", &T::specular,
                                     &T::specular_direction));
  panels.push_back(position_panel(box));
  panels.push_back(square_panel(box));
  return panels;
}

// --- layout ---

// Where the levels from `first` on stand in a panel, and how large that is, in pixels.
struct Layout {
  Layout(const MipmappedRsm& rsm, uint32_t first_level, uint32_t pixels_a_texel)
      : first(first_level), up(pixels_a_texel) {
    uint32_t right = 0, down = 0;
    for (size_t l = first; l < rsm.levels.size(); ++l) {
      const glm::uvec2 at = l == first ? glm::uvec2(0) : glm::uvec2(right, down);
      const glm::uvec2 end = at + up * glm::uvec2(rsm.levels[l].width, rsm.levels[l].height);
      if (l == first) {
        right = end.x + kGap;
      } else {
        down = end.y + kGap;
      }
      places.push_back(at);
      size = glm::max(size, end);
    }
  }
  // Of a sheet with so many panels beside each other.
  uint32_t sheet_width(uint32_t columns) const {
    return columns * panel_width() + (columns - 1) * kPictureMargin + 2 * kPictureMargin;
  }
  uint32_t panel_width() const { return std::max(size.x, kLeastPanel); }
  uint32_t first, up;
  std::vector<glm::uvec2> places;
  glm::uvec2 size{0};
};

// Two panels beside each other where they fit, texels as large as fit; the first level that fits at all.
std::pair<Layout, uint32_t> arrange(const MipmappedRsm& rsm) {
  for (uint32_t first = 0; first + 1 < rsm.levels.size(); ++first) {
    for (const uint32_t columns : {2u, 1u}) {
      if (Layout(rsm, first, 1).sheet_width(columns) > kMostWidth) continue;
      uint32_t up = 1;
      while (up < kMostPixels && Layout(rsm, first, up + 1).sheet_width(columns) <= kMostWidth) ++up;
      return {Layout(rsm, first, up), columns};
    }
  }
  return {Layout(rsm, static_cast<uint32_t>(rsm.levels.size()) - 1, kMostPixels), 2};
}

void draw_panel(Canvas& canvas, glm::uvec2 at, const Panel& panel, const MipmappedRsm& rsm,
                const Layout& layout) {
  for (size_t k = 0; k < layout.places.size(); ++k) {
    const MomentLevel& level = rsm.levels[layout.first + k];
    Bitmap texels(level.width, level.height);
    for (size_t i = 0; i < level.texels.size(); ++i) {
      const Color c = panel.color(level.texels[i]);
      std::copy_n(&c.x, 3, &texels.bytes[3 * i]);
    }
    const glm::uvec2 place = at + layout.places[k];
    canvas.picture(place.x, place.y, enlarge(texels, layout.up, layout.up));
  }
}

// What is nothing beside the largest component is a 0.
std::string vector_text(const glm::dvec3& v) {
  const glm::dvec3 size = glm::abs(v);
  const double least = 1e-6 * std::max({size.x, size.y, size.z});
  const auto component = [&](double c) { return std::abs(c) > least ? c : 0; };
  return fmt::format("({:.3g}, {:.3g}, {:.3g})", component(v.x), component(v.y), component(v.z));
}

std::vector<std::string> legend(const MipmappedRsm& rsm, const SceneBox& box, const Layout& layout) {
  std::vector<std::string> lines;
  const size_t top = rsm.levels.size() - 1;
  const std::string shown = layout.first == 0    ? fmt::format("levels 0 to {}", top)
                            : layout.first < top ? fmt::format("levels {} to {}", layout.first, top)
                                                 : fmt::format("level {}", top);
  lines.push_back(shown +
                  ": each texel is the mean of the RSM's texels that it covers, as filtered sampling "
                  "read it; black: no power");
  lines.push_back("power: W a texel of the RSM, times the number at its panel, sRGB");
  lines.push_back(
      "directions: red, green and blue are x, y and z from -1 to 1, grey is 0; weighted with the "
      "lobe's power, and the greyer the more the lobe spreads");
  lines.push_back(
      fmt::format("positions: red, green and blue are x, y and z from {} to {} m, the scene's box; "
                  "weighted with the power of all lobes; squared norms are about {} m",
                  vector_text(box.origin + glm::dvec3(box.low)),
                  vector_text(box.origin + glm::dvec3(box.high)), vector_text(box.origin)));
  if (rsm.lobes != (DIFFUSE_LOBE | SPECULAR_LOBE))
    lines.push_back(fmt::format("the lights of this scene have no {} lobe, which has no panel",
                                rsm.lobes & DIFFUSE_LOBE ? "specular" : "diffuse"));
  return lines;
}

}  // namespace

std::optional<MipmappedRsm> read_mipmapped_rsm(const MethodContext& context, uint32_t width,
                                               uint32_t height) {
  const auto stored = download(context, pyramid_texels(width, height));
  if (!stored) return std::nullopt;
  MipmappedRsm rsm{.lobes = context.lobes()};
  size_t next = 0;
  for (uint32_t l = 0; l <= pyramid_top(width, height); ++l) {
    const uint32_t round = (1u << l) - 1;
    MomentLevel level{(width + round) >> l, (height + round) >> l, {}};
    for (uint64_t i = 0; i < uint64_t(level.width) * level.height; ++i)
      level.texels.push_back(stored->texel(next++));
    rsm.levels.push_back(std::move(level));
  }
  return rsm;
}

Bitmap draw_moments(const MipmappedRsm& rsm, const SceneBox& box, const std::vector<std::string>& captions) {
  const std::vector<Panel> panels = panels_of(rsm, box);
  const auto [layout, columns] = arrange(rsm);
  const Font font(kPictureText);
  const glm::uvec2 cell(layout.panel_width() + kPictureMargin, kPictureLine + layout.size.y + kPictureMargin);
  const uint32_t rows = (static_cast<uint32_t>(panels.size()) + columns - 1) / columns;
  Canvas canvas(columns * cell.x - kPictureMargin, rows * cell.y - kPictureMargin, theme().paper);
  for (uint32_t k = 0; k < panels.size(); ++k) {
    const glm::uvec2 at = cell * glm::uvec2(k % columns, k / columns);
    canvas.text(at, font.fit(panels[k].title, layout.panel_width()), font, {theme().ink});
    draw_panel(canvas, at + glm::uvec2(0, kPictureLine), panels[k], rsm, layout);
  }
  return framed(canvas.bitmap(), captions, legend(rsm, box, layout));
}

}  // namespace vsglbench
