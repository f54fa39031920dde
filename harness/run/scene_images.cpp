#include "run/scene_images.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <numeric>
#include <sstream>

#include "base/hash.h"
#include "base/log.h"
#include "image/contact.h"
#include "image/error_map.h"
#include "image/exr.h"
#include "image/png.h"
#include "reference/direct_light.h"
#include "report/image_labels.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

constexpr size_t kLongestName = 120;

std::string short_hash(const std::string& text) { return Hasher().text(text).hex().substr(0, 8); }

// "N=256,rsm=256,vis=exact": the last part of a case's id. C: Case or CaseResult.
template <class C>
std::string parameters_of(const C& c) {
  return c.id.substr(c.scene.size() + c.method.size() + 2);
}

// An EXR, coverage in its channel A, with its preview; the EXR's path.
std::string write_pair(const fs::path& out, const std::string& stem, const Image& image, const Mask& mask,
                       float exposure, Labels labels) {
  write_exr(out / (stem + ".exr"), image, mask, labels);
  labels.erase("A");
  labels["exposure"] = fmt::format("{}", exposure);
  write_png(out / (stem + ".png"), tone_map(image, exposure), labels);
  return stem + ".exr";
}

Labels scene_labels(const SceneReport& scene, const std::string& content) {
  return radiance_image_labels(content, scene.name, scene.hash);
}

Labels labels_of(const SceneReport& scene, const ReferenceResult& reference) {
  Labels labels = scene_labels(scene, "indirect radiance, ray-traced reference");
  labels.insert({{"reference", reference.hash}, {"samples", fmt::format("{}", reference.samples)}});
  return labels;
}

std::string write_reference(const fs::path& out, const SceneReport& scene, const ReferenceResult& reference,
                            float exposure) {
  const std::string stem =
      fmt::format("{}/reference-{}", scene_folder(scene.name), reference.hash.substr(0, 8));
  std::error_code ec;
  if (fs::exists(out / (stem + ".exr"), ec) && fs::exists(out / (stem + ".png"), ec)) return stem + ".exr";
  return write_pair(out, stem, reference.mean, reference.mask, exposure, labels_of(scene, reference));
}

// Image and error map; their paths, and the reference's.
std::map<std::string, std::string> write_case(const fs::path& out, const SceneReport& scene,
                                              const CaseRun& run, float exposure,
                                              const std::string& reference) {
  const Case& c = run.description();
  const std::string stem = image_stem(c);
  Labels labels = scene_labels(scene, "indirect radiance of a case");
  labels.insert({{"case", c.id}, {"seed", "0"}, {"reference", run.reference()->hash}});
  std::map<std::string, std::string> images = {
      {"indirect", write_pair(out, stem + ".indirect", *run.image(), run.mask(), exposure, labels)},
      {"error", stem + ".error.exr"},
      {"reference", reference}};
  const Image error = error_map(*run.image(), run.reference()->mean, run.mask());
  labels["content"] = "signed error of a case against its reference";
  labels["units"] = "1: (x - r) / ((|x| + |r|) / 2) of luminance";
  write_exr(out / (stem + ".error.exr"), error, run.mask(), labels);
  Labels drawn = labels;
  drawn.erase("A");
  write_png(out / (stem + ".error.png"), color_error_map(error, ContactSheet().error_range, run.mask()),
            drawn);
  if (!run.cancellation()) return images;
  labels["content"] = "share of the lights that a pixel shades with exact BRDFs [VSGL14 Fig. 6]";
  labels["units"] = "1";
  images["cancellation"] =
      write_pair(out, stem + ".cancellation", *run.cancellation(), run.mask(), 1, labels);
  return images;
}

// "N=256", "rsm=256", "vis=exact".
std::vector<std::string> settings_of(const CaseResult& c) {
  std::vector<std::string> settings;
  std::istringstream parts(parameters_of(c));
  for (std::string part; std::getline(parts, part, ',');) settings.push_back(part);
  return settings;
}

// "   method 2023 ms": of all passes that a method answers for, else of the frame.
std::string time_of(const CaseResult& c) {
  if (!c.frame) return "";
  const double ms = (c.frame->method ? *c.frame->method : c.frame->span).median;
  return fmt::format("   {} {} ms", c.frame->method ? "method" : "frame",
                     ms < 1000 ? fmt::format("{:.3g}", ms) : fmt::format("{:.0f}", ms));
}

bool has_image(const CaseResult& c) { return c.images.contains("indirect"); }

// The pages of an earlier run, which may have had more.
void remove_sheet(const fs::path& folder) {
  std::error_code ec;
  fs::remove(folder / "contact.png", ec);
  for (size_t page = 0; fs::remove(folder / (page_name("contact", page, 2) + ".png"), ec);) ++page;
}

// A case with another reference than the one shown carries its own.
ContactSheet sheet_of(const fs::path& out, const std::vector<CaseResult>& cases, const SceneReport& scene,
                      const ReferenceResult& shown, const ReferenceInfo& info) {
  const Captions captions = captions_of(cases);
  ContactSheet sheet;
  sheet.title = fmt::format("{}: one-bounce indirect light   {}", scene.name, captions.shared);
  sheet.reference = shown.mean;
  sheet.reference_detail = fmt::format("{} samples\nfloor: SMAPE {:.2f} %   RMSE {:.2g}", shown.samples,
                                       info.noise_floor_smape, info.noise_floor_rmse.value_or(0));
  sheet.mask = shown.mask;
  sheet.exposure = static_cast<float>(scene.exposure);
  for (const size_t i : sheet_order(cases)) {
    const CaseResult& c = cases[i];
    ContactEntry entry{captions.cases[i], figures_of(c), std::nullopt, std::nullopt};
    if (has_image(c)) entry.image = read_exr(out / c.images.at("indirect"));
    if (has_image(c) && c.accuracy && c.accuracy->reference.hash != shown.hash)
      entry.reference = read_exr(out / c.images.at("reference"));
    sheet.entries.push_back(std::move(entry));
  }
  return sheet;
}

}  // namespace

std::string scene_folder(const std::string& scene) { return "images/" + file_name(scene); }

std::string image_stem(const Case& c) {
  return scene_folder(c.scene) + "/" + file_name(c.method) + "/" + file_name(parameters_of(c));
}

std::string preview_of(std::string exr) {
  if (exr.ends_with(".exr")) exr.replace(exr.size() - 4, 4, ".png");
  return exr;
}

// Medians of heavy-tailed seeds: the sheet has no room for ranges.
std::string figures_of(const CaseResult& c) {
  if (c.status != Status::ok) return c.error ? c.error->message : "failed";
  const auto number = [](const MetricResult& m, double scale, const char* format) {
    if (!m.value) return std::string("undefined");
    return fmt::format(fmt::runtime(format), scale * (m.heavy_tailed ? *m.median : *m.value));
  };
  const Accuracy& a = *c.accuracy;
  return fmt::format("SMAPE {}   lit {}   RMSE {}\nbias {}   FLIP {}{}", number(a.smape, 1, "{:.3g} %"),
                     number(a.smape_lit, 1, "{:.3g} %"), number(a.rmse, 1, "{:.3g}"),
                     number(a.bias, 100, "{:+.3g} %"), number(a.flip, 1, "{:.3f}"), time_of(c));
}

std::vector<size_t> sheet_order(const std::vector<CaseResult>& cases) {
  std::vector<size_t> order(cases.size());
  std::iota(order.begin(), order.end(), size_t{0});
  const auto key = [&](size_t i) {
    const auto lights = cases[i].parameters.find("N");
    const bool counted = lights != cases[i].parameters.end() && lights->is_number();
    return std::pair(cases[i].method, counted ? lights->get<double>() : 0.0);
  };
  std::ranges::stable_sort(order, {}, key);
  return order;
}

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

Captions captions_of(const std::vector<CaseResult>& cases) {
  std::map<std::string, size_t> uses;
  for (const CaseResult& c : cases) {
    for (const auto& setting : settings_of(c)) ++uses[setting];
  }
  Captions captions;
  for (const CaseResult& c : cases) {
    std::string own = c.method;
    for (const auto& setting : settings_of(c)) {
      const bool shared = uses[setting] == cases.size();
      if (!shared) own += " " + setting;
      if (shared && captions.cases.empty()) captions.shared += (captions.shared.empty() ? "" : " ") + setting;
    }
    captions.cases.push_back(own);
  }
  return captions;
}

SceneImages::SceneImages(fs::path out, bool exposed, SceneReport* scene)
    : out_(std::move(out)), scene_(scene), exposed_(exposed) {}

void SceneImages::start(CaseRun& run) {
  if (!run.image() || run.failed()) return;
  if (!exposed_) scene_->exposure = auto_exposure(run.reference()->mean, run.reference()->mask);
  exposed_ = true;
  const auto exposure = static_cast<float>(scene_->exposure);
  const auto failed = [&](ErrorKind kind, const std::string& message) { run.fail_in_the_end(kind, message); };
  guarded(
      [&] {
        const std::string reference = write_reference(out_, *scene_, *run.reference(), exposure);
        open_[&run] = std::async(std::launch::async, [this, &run, exposure, reference] {
          return write_case(out_, *scene_, run, exposure, reference);
        });
      },
      failed);
  if (!direct_ && tracer_ && run.frame()) write_direct(*run.frame());
}

void SceneImages::finish(CaseRun& run) {
  const auto writing = open_.extract(&run);
  if (writing.empty()) return;
  const auto failed = [&](ErrorKind kind, const std::string& message) { run.fail_in_the_end(kind, message); };
  guarded([&] { run.add_images(writing.mapped().get()); }, failed);
}

void SceneImages::write_direct(const Frame& frame) {
  direct_ = true;
  const auto warn = [&](ErrorKind, const std::string& message) {
    log_warning("{}: {}", scene_->name, message);
  };
  guarded(
      [&] {
        const DirectLight direct = direct_light(*tracer_, frame.camera().width, frame.camera().height);
        write_pair(out_, scene_folder(scene_->name) + "/direct", direct.image, direct.mask,
                   auto_exposure(direct.image, direct.mask), scene_labels(*scene_, "direct radiance"));
      },
      warn);
}

void SceneImages::write_sheet(const std::vector<CaseResult>& cases, const ReferenceResult& shown,
                              const ReferenceInfo& info) {
  const auto warn = [&](ErrorKind, const std::string& message) {
    log_warning("{}: {}", scene_->name, message);
  };
  const auto write_it = [&] {
    const std::string folder = scene_folder(scene_->name);
    const auto pages = contact_pages(sheet_of(out_, cases, *scene_, shown, info));
    remove_sheet(out_ / folder);
    for (size_t i = 0; i < pages.size(); ++i) {
      const std::string path = fmt::format("{}/{}.png", folder, page_name("contact", i, pages.size()));
      write_png(out_ / path, pages[i],
                image_labels("reference, images and error maps of every case", scene_->name, scene_->hash));
      if (i == 0) scene_->contact = path;
      log_info("contact sheet: {}", (out_ / path).string());
    }
  };
  guarded(write_it, warn);
}

}  // namespace vsglbench
