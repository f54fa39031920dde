#include "run/motion_images.h"

#include <cstdlib>
#include <optional>
#include <vector>

#include "image/apng.h"
#include "image/exr.h"
#include "image/flicker_picture.h"
#include "image/temporal_profile.h"
#include "report/image_labels.h"
#include "run/scene_images.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

constexpr uint32_t kCropSide = 96;
constexpr const char* kRate = "frames_per_second";  // attribute of a frame's EXR

fs::path file_of(const fs::path& folder, uint32_t frame) { return folder / motion_frame_file(frame); }

// The 12 of "0012.exr" and "0012.png"; nothing for what has no such name.
std::optional<uint64_t> number_of(const fs::path& file) {
  const std::string stem = file.stem().string(), extension = file.extension().string();
  const bool digits =
      stem.size() >= 4 && stem.size() < 19 && stem.find_first_not_of("0123456789") == std::string::npos;
  if (!digits || (extension != ".exr" && extension != ".png")) return std::nullopt;
  return std::stoull(stem);
}

}  // namespace

std::string motion_frame_file(uint32_t frame) { return fmt::format("{:04}.exr", frame); }

void remove_frames_from(const fs::path& folder, uint64_t first) {
  std::error_code ec;
  std::vector<fs::path> stale;
  for (const auto& entry : fs::directory_iterator(folder, ec)) {
    const auto number = number_of(entry.path());
    if (number && *number >= first && entry.symlink_status(ec).type() == fs::file_type::regular)
      stale.push_back(entry.path());
  }
  for (const fs::path& file : stale) {
    if (!fs::remove(file, ec) && ec)
      throw fail(ErrorKind::output, "{}: can't be removed: {}", file.string(), ec.message());
  }
}

MotionFrame read_motion_frame(const fs::path& folder, uint32_t frame) {
  std::error_code ec;
  const fs::path path = file_of(folder, frame);
  if (fs::exists(path, ec) && !fs::is_regular_file(path, ec))
    throw fail(ErrorKind::output, "{}: is no plain file", path.string());
  ExrLayers layers = read_exr_layers(path);
  MotionFrame out;
  if (!layers.colors.contains("") || !layers.scalars.contains("A") || !layers.attributes.contains(kRate))
    throw fail(ErrorKind::output, "{}: is no frame of a run", path.string());
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

void MotionImages::write(const fs::path& folder, uint32_t frame, const Image& image, const Mask& mask,
                         Labels labels) const {
  labels.merge(radiance_image_labels("a frame of an animation", scene_.name, scene_.hash));
  labels.insert({{"frame", fmt::format("{}", frame)}, {kRate, fmt::format("{}", scene_.animation.rate)}});
  write_exr(file_of(out_ / folder, frame), image, mask, labels);
}

void MotionImages::write(const Case& c, uint32_t frame, const CaseRun::Look& look) const {
  write(frames_folder(c), frame, look.image, look.mask, {{"case", c.id}, {"seed", "0"}});
}

void MotionImages::write(const Case& c, uint32_t frame, const ReferenceResult& reference) const {
  write(reference_frames_folder(c), frame, reference.mean, reference.mask, {{"reference", reference.hash}});
}

std::map<std::string, std::string> MotionImages::draw(const Case& c, const DerivativeFlickerMeter& meter,
                                                      float exposure) const {
  const auto found = meter.finish();
  if (!found) throw fail(ErrorKind::case_failed, "the references are black: there is no flicker to draw");
  const auto frames = static_cast<uint32_t>(meter.frames());
  for (const std::string& folder : {frames_folder(c), reference_frames_folder(c)})
    remove_frames_from(out_ / folder, frames);
  const Crop crop = worst_crop(meter.sums(), c.frame.width, kCropSide);
  const std::string title = c.id, stem = image_stem(c);
  FlickerPicture picture({.title = title,
                          .crop = crop,
                          .frames = frames,
                          .exposure = exposure,
                          .mean_reference = found->mean_reference});
  TemporalProfile profile({.title = title, .row = crop.y + crop.height / 2, .exposure = exposure});
  const auto labels = [&](const char* content) {
    Labels out = image_labels(content, scene_.name, scene_.hash);
    out.insert({{"case", title}, {"seed", "0"}});
    return out;
  };
  const auto draw_frame = [&](uint32_t frame) {
    const MotionFrame x = read_motion_frame(out_ / frames_folder(c), frame);
    const Image r = read_motion_frame(out_ / reference_frames_folder(c), frame).image;
    profile.add(x.image, r);
    return picture.draw(x.image, r, x.mask);
  };
  write_apng(out_ / (stem + ".flicker.png"), frames, scene_.animation.rate, draw_frame,
             labels("the crop that flickers most, beside the reference"));
  write_png(out_ / (stem + ".profile.png"), profile.draw(), labels("a row of pixels over time"));
  return {{"flicker", stem + ".flicker.png"},
          {"profile", stem + ".profile.png"},
          {"frames", frames_folder(c)},
          {"reference_frames", reference_frames_folder(c)}};
}

}  // namespace vsglbench
