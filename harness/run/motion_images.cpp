#include "run/motion_images.h"

#include <algorithm>
#include <cstdlib>
#include <iterator>

#include "image/apng.h"
#include "image/exr.h"
#include "image/flicker_picture.h"
#include "image/temporal_profile.h"
#include "run/scene_images.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

constexpr uint32_t kCropSide = 96;
constexpr const char* kRate = "frames_per_second";  // attribute of a frame's EXR

fs::path file_of(const fs::path& folder, uint32_t frame) { return folder / fmt::format("{:04}.exr", frame); }

void write_frame(const fs::path& path, const Image& image, const Mask& mask, double rate) {
  ExrLayers layers{image.width, image.height, {{"", image}}, {}, {{kRate, fmt::format("{}", rate)}}};
  std::ranges::transform(mask, std::back_inserter(layers.scalars["A"]), [](uint8_t m) { return m ? 1.f : 0.f; });
  write_exr(path, layers);
}

}  // namespace

MotionFrame read_motion_frame(const fs::path& folder, uint32_t frame) {
  ExrLayers layers = read_exr_layers(file_of(folder, frame));
  MotionFrame out;
  if (!layers.colors.contains("") || !layers.scalars.contains("A") || !layers.attributes.contains(kRate))
    throw fail(ErrorKind::output, "{}: is no frame of a run", file_of(folder, frame).string());
  out.image = std::move(layers.colors.at(""));
  for (const float a : layers.scalars.at("A")) out.mask.push_back(a > 0);
  out.rate = std::strtod(layers.attributes.at(kRate).c_str(), nullptr);
  return out;
}

std::string frames_folder(const Case& c) { return image_stem(c) + ".frames"; }

std::string reference_frames_folder(const Case& c) {
  return fmt::format("{}/reference-{}x{}{}.frames", scene_folder(c.scene), c.frame.width, c.frame.height,
                     c.frame.visibility == Visibility::none ? "-without-occlusion" : "");
}

void MotionImages::write(const Case& c, uint32_t frame, const CaseRun::Look& look) const {
  write_frame(file_of(out_ / frames_folder(c), frame), look.image, look.mask, rate_);
}

void MotionImages::write(const Case& c, uint32_t frame, const ReferenceResult& reference) const {
  write_frame(file_of(out_ / reference_frames_folder(c), frame), reference.mean, reference.mask, rate_);
}

std::map<std::string, std::string> MotionImages::draw(const Case& c, const DerivativeFlickerMeter& meter,
                                                      float exposure) const {
  const auto found = meter.finish();
  if (!found) throw fail(ErrorKind::case_failed, "the references are black: there is no flicker to draw");
  const auto frames = static_cast<uint32_t>(meter.frames());
  const Crop crop = worst_crop(meter.sums(), c.frame.width, kCropSide);
  const std::string title = c.id, stem = image_stem(c);
  FlickerPicture picture(
      {.title = title, .crop = crop, .frames = frames, .exposure = exposure, .mean_reference = found->mean_reference});
  TemporalProfile profile({.title = title, .row = crop.y + crop.height / 2, .exposure = exposure});
  write_apng(out_ / (stem + ".flicker.png"), frames, rate_, [&](uint32_t frame) {
    const MotionFrame x = read_motion_frame(out_ / frames_folder(c), frame);
    const Image r = read_motion_frame(out_ / reference_frames_folder(c), frame).image;
    profile.add(x.image, r);
    return picture.draw(x.image, r, x.mask);
  });
  write_png(out_ / (stem + ".profile.png"), profile.draw());
  return {{"flicker", stem + ".flicker.png"},
          {"profile", stem + ".profile.png"},
          {"frames", frames_folder(c)},
          {"reference_frames", reference_frames_folder(c)}};
}

}  // namespace vsglbench
