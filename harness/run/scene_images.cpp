#include "run/scene_images.h"

#include <algorithm>
#include <cctype>

#include "base/hash.h"
#include "base/log.h"
#include "image/contact.h"
#include "image/error_map.h"
#include "image/exr.h"
#include "image/png.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

constexpr size_t kLongestName = 120;

std::string short_hash(const std::string& text) { return Hasher().text(text).hex().substr(0, 8); }

std::string folder_of(const std::string& scene) { return "images/" + file_name(scene); }

// "N=256,rsm=256,vis=exact": the last part of a case's id.
std::string parameters_of(const CaseResult& c) { return c.id.substr(c.scene.size() + c.method.size() + 2); }

// An EXR with its preview; the EXR's path.
std::string write_pair(const fs::path& out, const std::string& stem, const Image& image, float exposure) {
  write_exr(out / (stem + ".exr"), image);
  write_png(out / (stem + ".png"), image, exposure);
  return stem + ".exr";
}

std::string write_reference(const fs::path& out, const std::string& scene, const ReferenceResult& reference,
                            float exposure) {
  const std::string stem = fmt::format("{}/reference-{}", folder_of(scene), reference.hash.substr(0, 8));
  std::error_code ec;
  if (fs::exists(out / (stem + ".exr"), ec) && fs::exists(out / (stem + ".png"), ec)) return stem + ".exr";
  return write_pair(out, stem, reference.mean, exposure);
}

void write_case(const fs::path& out, const CaseRun& run, float exposure, CaseResult* result) {
  const std::string stem =
      folder_of(result->scene) + "/" + file_name(result->method) + "/" + file_name(parameters_of(*result));
  const Image error = error_map(*run.image(), run.reference()->mean, run.mask());
  write_exr(out / (stem + ".error.exr"), error);
  write_png(out / (stem + ".error.png"), color_error_map(error, ContactSheet().error_range, run.mask()));
  result->images = {{"indirect", write_pair(out, stem + ".indirect", *run.image(), exposure)},
                    {"error", stem + ".error.exr"},
                    {"reference", write_reference(out, result->scene, *run.reference(), exposure)}};
}

std::string detail_of(const CaseResult& c) {
  if (c.status != Status::ok) return c.error ? c.error->message : "failed";
  const auto percent = [](const MetricResult& m, double scale, const char* format) {
    return m.value ? fmt::format(fmt::runtime(format), scale * *m.value) : std::string("undefined");
  };
  return fmt::format("SMAPE {}  bias {}", percent(c.accuracy->smape, 1, "{:.2f} %"),
                     percent(c.accuracy->bias, 100, "{:+.2f} %"));
}

// The first case with an image gives the sheet its reference; a case with another one carries its own.
ContactSheet sheet_of(const std::vector<CaseRun>& cases, const std::vector<CaseResult>& results,
                      const SceneReport& scene) {
  const auto drawn =
      std::find_if(cases.begin(), cases.end(), [](const CaseRun& c) { return c.image().has_value(); });
  const ReferenceResult& shown = *drawn->reference();
  ContactSheet sheet;
  sheet.title = scene.name + ": one-bounce indirect light";
  sheet.reference = shown.mean;
  sheet.reference_detail = fmt::format("{} samples, floor {:.2f} %", shown.samples, shown.noise_floor_smape);
  sheet.mask = shown.mask;
  sheet.exposure = static_cast<float>(scene.exposure);
  for (size_t i = 0; i < cases.size(); ++i) {
    const CaseResult& r = results[i];
    ContactEntry entry{r.method + " " + parameters_of(r), detail_of(r), cases[i].image(), std::nullopt};
    if (entry.image && cases[i].reference() != &shown) entry.reference = cases[i].reference()->mean;
    sheet.entries.push_back(std::move(entry));
  }
  return sheet;
}

void write_direct(const fs::path& out, std::vector<CaseRun>& cases, const SceneReport& scene) {
  const auto alive =
      std::find_if(cases.begin(), cases.end(), [](CaseRun& c) { return c.frame() != nullptr; });
  if (alive == cases.end()) return;
  write_pair(out, folder_of(scene.name) + "/direct", alive->frame()->render_direct(),
             static_cast<float>(scene.exposure));
}

}  // namespace

std::string file_name(const std::string& name) {
  std::string out = name;
  bool changed = out.empty() || out.front() == '.';
  for (char& c : out) {
    if (c == ':') {
      c = '@';
    } else if (!std::isalnum(static_cast<unsigned char>(c)) &&
               std::string_view("._=,+-").find(c) == std::string::npos) {
      c = '_';
      changed = true;
    }
  }
  if (!out.empty() && out.front() == '.') out.front() = '_';
  if (!changed && out.size() <= kLongestName) return out;
  return out.substr(0, kLongestName) + "-" + short_hash(name);
}

void write_images(const fs::path& out, std::vector<CaseRun>& cases, std::vector<CaseResult>& results,
                  SceneReport* scene) {
  const auto drawn =
      std::find_if(cases.begin(), cases.end(), [](const CaseRun& c) { return c.image().has_value(); });
  if (drawn == cases.end()) return;
  scene->exposure = auto_exposure(drawn->reference()->mean, drawn->reference()->mask);
  for (size_t i = 0; i < cases.size(); ++i) {
    if (!cases[i].image()) continue;
    const auto failed = [&](const std::string& kind, const std::string& message) {
      if (results[i].status == Status::ok) results[i].error = CaseError{kind, message};
      if (results[i].status == Status::ok) results[i].status = Status::failed;
    };
    guarded(
        "output", [&] { write_case(out, cases[i], static_cast<float>(scene->exposure), &results[i]); },
        failed);
  }
  const auto warn = [&](const std::string&, const std::string& message) {
    log_warning("{}: {}", scene->name, message);
  };
  guarded(
      "output", [&] { write_direct(out, cases, *scene); }, warn);
  const auto write_sheet = [&] {
    const std::string path = folder_of(scene->name) + "/contact.png";
    write_png(out / path, contact_sheet(sheet_of(cases, results, *scene)));
    scene->contact = path;
  };
  guarded("output", write_sheet, warn);
}

}  // namespace vsglbench
