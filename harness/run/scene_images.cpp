// EXR images, PNG previews and the contact sheet of one scene.
#include <algorithm>

#include "image/contact.h"
#include "image/error_map.h"
#include "image/exr.h"
#include "run/scene_run.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

// "images/cornell/mfis/N=256,rsm=256,vis=exact": the case's id as a path below out; a view's colon would not
// do on every file system.
std::string file_stem(std::string id) {
  std::replace(id.begin(), id.end(), ':', '_');
  return "images/" + id;
}

std::string write_pair(const fs::path& out, const std::string& stem, const Image& image, float exposure) {
  write_exr(out / (stem + ".exr"), image);
  write_png(out / (stem + ".png"), image, exposure);
  return stem + ".exr";
}

std::string caption_of(const CaseResult& result) {
  const size_t slash = result.id.find('/');
  std::string text = result.id.substr(slash + 1);
  std::replace(text.begin(), text.end(), '/', ' ');
  return text;
}

std::string detail_of(const CaseResult& result) {
  if (result.status != Status::ok) return result.error ? result.error->message : "failed";
  const Accuracy& a = *result.accuracy;
  return fmt::format("SMAPE {:.2f} %  bias {:+.2f} %", a.smape.value.value_or(0), 100 * a.bias.value.value_or(0));
}

// References are written once for each that is in use.
std::string write_reference(const fs::path& out, const std::string& scene, const ReferenceResult& reference,
                            float exposure) {
  std::string name = scene;
  std::replace(name.begin(), name.end(), ':', '_');
  const std::string stem = fmt::format("images/{}/reference-{}", name, reference.hash.substr(0, 8));
  if (!fs::exists(out / (stem + ".exr"))) write_pair(out, stem, reference.mean, exposure);
  return stem + ".exr";
}

}  // namespace

std::string write_images(const fs::path& out, const std::string& scene, std::vector<CaseRun>& cases,
                         std::vector<CaseResult>& results, float exposure, const Image& direct) {
  ContactSheet sheet;
  const ReferenceResult* shown = nullptr;
  for (size_t i = 0; i < cases.size(); ++i) {
    ContactEntry entry{caption_of(results[i]), detail_of(results[i]), cases[i].image(), {}};
    if (cases[i].image()) {
      const ReferenceResult& reference = *cases[i].reference();
      const std::string stem = file_stem(results[i].id);
      const Image error = error_map(*cases[i].image(), reference.mean, cases[i].mask());
      write_exr(out / (stem + ".error.exr"), error);
      write_png(out / (stem + ".error.png"), color_error_map(error, sheet.error_range, cases[i].mask()));
      results[i].images = {{"indirect", write_pair(out, stem + ".indirect", *cases[i].image(), exposure)},
                           {"error", stem + ".error.exr"},
                           {"reference", write_reference(out, scene, reference, exposure)}};
      if (!shown) shown = &reference;
      if (reference.mean.width != shown->mean.width || reference.mean.height != shown->mean.height) continue;
      if (&reference != shown) entry.reference = reference.mean;
    }
    sheet.entries.push_back(std::move(entry));
  }
  sheet.title = fmt::format("{}: one-bounce indirect light", scene);
  sheet.reference = shown->mean;
  sheet.reference_detail = fmt::format("{} samples, floor {:.2f} %", shown->samples, shown->noise_floor_smape);
  sheet.mask = shown->mask;
  sheet.exposure = exposure;
  std::string folder = scene;
  std::replace(folder.begin(), folder.end(), ':', '_');
  if (!direct.pixels.empty()) write_pair(out, fmt::format("images/{}/direct", folder), direct, exposure);
  const std::string path = fmt::format("images/{}/contact.png", folder);
  write_png(out / path, contact_sheet(sheet));
  return path;
}

}  // namespace vsglbench
