#include "report/table_notes.h"

#include <set>

#include "report/raster.h"

namespace vsglbench {
namespace {

std::string count_of(const Json& config, const char* key, const char* what) {
  return config.contains(key) ? fmt::format(", {} {}", config[key].dump(), what) : "";
}

// The value that all cases have which have one; cases of one report may be swept over it.
std::string importance_note(const Report& report) {
  std::set<std::string> values;
  for (const CaseResult& c : report.cases)
    if (c.parameters.contains("importance_lights")) values.insert(c.parameters["importance_lights"].dump());
  return values.size() == 1 ? fmt::format(", {} importance lights", *values.begin()) : "";
}

std::string setting_note(const Report& report, const std::string& shared) {
  const Json& config = report.config;
  std::string out = shared;
  const Json frame = config.value("frame", Json::object());
  if (frame.contains("width") && frame.contains("height"))
    out += fmt::format(", {}×{} pixels", frame["width"].dump(), frame["height"].dump());
  out += importance_note(report) + count_of(config, "seeds", "seeds");
  if (config.contains("reference"))
    out += count_of(config["reference"], "samples", "samples a pixel of the reference");
  return out.starts_with(", ") ? out.substr(2) : out;
}

// On whose PDFs generation alone was timed; in reports of old always on one for all.
std::string generation_note(const Report& report) {
  std::set<std::string> pdfs;  // values of the key
  for (const CaseResult& c : report.cases) {
    const auto pdf = c.parameters.find("pdf");
    if (pdf != c.parameters.end() && pdf->is_string()) pdfs.insert(pdf->get<std::string>());
  }
  const std::string maker = report.config.value("pdfs_made_by", "an unknown method");
  const std::string start = "only generation was measured: every case of a scene on the same halves";
  if (pdfs.size() > 1)
    return fmt::format("{}, and on the same PDFs where `pdf` is the same: {}", start, maker);
  if (pdfs.contains("own")) return start + ", each method on the PDFs that it makes itself";
  return fmt::format("{} and PDFs, made by {}", start, maker);
}

std::string device_note(const Report& report) {
  const DeviceReport& d = report.device;
  return fmt::format("device: {}, {}, {}; host: {}, {} cores", d.name, d.driver_version,
                     d.type == "cpu" ? "a CPU: do not compare its times with a GPU's" : d.type + " GPU",
                     report.host.cpu, report.host.cores);
}

std::string raster_note(double ratio) {
  return fmt::format(
      "raster is slow on this device: drawing the G-buffer takes {:.0f} times as long as a compute pass that "
      "writes as much; gbuffer and rsm are in frame ms and fixed ms alone, in no other sum",
      ratio);
}

std::string source_note(const Report& report, const std::string& link) {
  return fmt::format("[report]({}) of {}, commit {}{}", link, report.created.substr(0, 10),
                     report.git.commit.substr(0, 7), report.git.dirty ? " with changes" : "");
}

}  // namespace

std::string wall_text(const WallTime& w) {
  const double rest =
      std::max(0.0, w.total_s - w.device_s - w.references_s - w.visibility_s - w.compilation_s);
  // Without a frame there is nothing that the rest could be a share of.
  const std::string share =
      w.device_s > 0 ? fmt::format(", {:.0f} % of the device's time", 100 * rest / w.device_s) : "";
  return fmt::format(
      "{:.1f} s in all: frames on the device {:.1f}, references {:.1f}, exact visibility {:.1f}, compilation "
      "{:.1f}, the rest {:.1f}{}",
      w.total_s, w.device_s, w.references_s, w.visibility_s, w.compilation_s, rest, share);
}

std::vector<std::string> table_notes(const Report& report, const std::string& shared,
                                     const std::string& link) {
  std::vector<std::string> out;
  const std::string settings = setting_note(report, shared);
  if (!settings.empty()) out.push_back("every case: " + settings);
  out.push_back(device_note(report));
  const double raster = raster_ratio(report).value_or(0);
  if (report.device.type != "cpu" && raster >= kSlowRaster) out.push_back(raster_note(raster));
  const HostInfo& host = report.host;
  if (host.load_at_start && *host.load_at_start > 0.5 * host.cores) {
    out.push_back(fmt::format("the machine was busy when the run began: load {:.2f} on {} cores",
                              *host.load_at_start, host.cores));
  }
  if (report.config.value("measure", "") == "generation") out.push_back(generation_note(report));
  for (const SceneReport& scene : report.scenes) {
    for (const auto& note : scene.notes) out.push_back(scene.name + ": " + note);
    if (scene.clocks && !scene.clocks->throttled_by.empty())
      out.push_back(fmt::format("{}: the GPU's clocks were held down ({}), {} to {} MHz", scene.name,
                                fmt::join(scene.clocks->throttled_by, ", "), scene.clocks->least_sm_mhz,
                                scene.clocks->most_sm_mhz));
  }
  if (!report.complete) out.push_back("incomplete: the run was stopped before its last case");
  if (!link.empty()) out.push_back(source_note(report, link));
  return out;
}

}  // namespace vsglbench
