#include "image/temporal_profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "image/canvas.h"
#include "image/theme.h"

namespace vsglbench {
namespace {

constexpr uint32_t kMargin = 20, kGap = 30, kTitleHeight = 34, kCaptionHeight = 24;
constexpr uint32_t kNumbers = 52, kUnder = 44;  // left of a panel and below it, for its axes
constexpr uint32_t kLeastWidth = 400, kLeastHeight = 240, kMostDown = 16, kSideBySide = 2000;
constexpr double kTitle = 20, kText = 14, kTick = 5, kTickColumns = 60, kTickRows = 22;

// 1, 2 or 5 times a power of ten, so that ticks are `least` pixels apart or more where one number takes `up`.
uint32_t tick_step(uint32_t up, double least) {
  for (uint32_t power = 1;; power *= 10) {
    for (const uint32_t digit : {1u, 2u, 5u})
      if (double(digit) * power * up >= least || power >= 100'000'000) return digit * power;
  }
}

struct Panel {
  glm::uvec2 at;  // upper left pixel of the picture
  uint32_t across, down;
};

void draw_axes(Canvas* canvas, const Panel& panel, uint32_t columns, uint32_t frames, uint32_t row,
               const Font& font) {
  const double bottom = panel.at.y + double(frames) * panel.down;
  const Ink ink{theme().faint};
  const uint32_t step_x = tick_step(panel.across, kTickColumns), step_y = tick_step(panel.down, kTickRows);
  for (uint32_t x = 0; x < columns; x += step_x) {
    const double middle = std::floor(panel.at.x + (x + 0.5) * panel.across);
    canvas->fill_rectangle({middle, bottom}, {middle + 1, bottom + kTick}, ink);
    const std::string number = fmt::format("{}", x);
    canvas->text({middle - font.width(number) / 2, bottom + kTick + 1}, number, font, ink);
  }
  for (uint32_t t = 0; t < frames; t += step_y) {
    const double middle = std::floor(panel.at.y + (t + 0.5) * panel.down);
    canvas->fill_rectangle({panel.at.x - kTick, middle}, {double(panel.at.x), middle + 1}, ink);
    const std::string number = fmt::format("{}", t);
    canvas->text({panel.at.x - kTick - 4 - font.width(number), middle - kText / 2 - 2}, number, font, ink);
  }
  const std::string name = fmt::format("pixel x of row {}", row);
  canvas->text({panel.at.x + (double(columns) * panel.across - font.width(name)) / 2, bottom + kTick + 18},
               name, font, ink);
}

}  // namespace

TemporalProfile::TemporalProfile(TemporalProfileOptions options) : options_(std::move(options)) {}

void TemporalProfile::add(const Image& x, const Image& r) {
  const bool like_first = frames_ == 0 || (r.width == width_ && r.height == height_);
  if (x.width != r.width || x.height != r.height || !like_first || options_.row >= r.height) {
    throw fail(ErrorKind::case_failed, "a temporal profile of row {} of {}x{} pixels against {}x{}",
               options_.row, x.width, x.height, r.width, r.height);
  }
  width_ = r.width, height_ = r.height;
  for (const auto& [image, rows] : {std::pair{&x, &test_}, std::pair{&r, &reference_}}) {
    const glm::vec3* from = &image->at(0, options_.row);
    rows->insert(rows->end(), from, from + width_);
  }
  ++frames_;
}

Image TemporalProfile::stacked(const std::vector<glm::vec3>& rows) const {
  Image out;
  out.width = width_;
  out.height = frames_;
  out.pixels = rows;
  return out;
}

Bitmap TemporalProfile::draw() const {
  if (frames_ == 0) throw fail(ErrorKind::case_failed, "a temporal profile without frames");
  const uint32_t across = (kLeastWidth + width_ - 1) / width_;
  const uint32_t down = std::min(kMostDown, (kLeastHeight + frames_ - 1) / frames_);
  const uint64_t width = uint64_t(width_) * across, height = uint64_t(frames_) * down;
  const bool beside = 2 * width <= kSideBySide;
  // A panel with its axes and caption.
  const uint64_t cell_width = kNumbers + width, cell_height = kCaptionHeight + height + kUnder;
  const uint64_t all_width = 2 * kMargin + (beside ? 2 * cell_width + kGap : cell_width);
  const uint64_t all_height = 2 * kMargin + kTitleHeight + (beside ? cell_height : 2 * cell_height + kGap);
  if (std::max(all_width, all_height) > 32767)
    throw fail(ErrorKind::output, "a temporal profile of {}x{} pixels can't be drawn", all_width, all_height);
  Canvas canvas(static_cast<uint32_t>(all_width), static_cast<uint32_t>(all_height), theme().paper);
  static const Font title(kTitle), text(kText);
  canvas.text({kMargin, kMargin - 6}, title.fit(options_.title, double(all_width) - 2 * kMargin), title,
              {theme().ink});
  glm::uvec2 cell(kMargin, kMargin + kTitleHeight);
  for (const auto& [caption, image] : {std::pair{"test", test()}, std::pair{"reference", reference()}}) {
    const Panel panel{{cell.x + kNumbers, cell.y + kCaptionHeight}, across, down};
    canvas.text({panel.at.x, cell.y}, caption, text, {theme().ink});
    canvas.text({panel.at.x - kTick - 4 - text.width("frame"), cell.y}, "frame", text, {theme().faint});
    canvas.picture(panel.at.x, panel.at.y, enlarge(tone_map(image, options_.exposure), across, down));
    draw_axes(&canvas, panel, width_, frames_, options_.row, text);
    if (beside)
      cell.x += static_cast<uint32_t>(cell_width) + kGap;
    else
      cell.y += static_cast<uint32_t>(cell_height) + kGap;
  }
  return canvas.bitmap();
}

}  // namespace vsglbench
