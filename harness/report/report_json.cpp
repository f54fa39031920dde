// The fields of a report, in the order of the file.
#include "report/case_fields.h"

namespace vsglbench {

void fields(auto& a, Is<GitState> auto& v) {
  a("commit", v.commit);
  a("dirty", v.dirty);
}

void fields(auto& a, Is<DeviceReport> auto& v) {
  a("name", v.name);
  a("type", v.type);
  a("driver", v.driver);
  a("driver_version", v.driver_version);
  a("api", v.api);
  a("subgroup_size", v.subgroup_size);
  a("timestamp_period_ns", v.timestamp_period_ns);
  a("settings", v.settings);
}

void fields(auto& a, Is<HostInfo> auto& v) {
  a("cpu", v.cpu);
  a("cores", v.cores);
  a("memory_bytes", v.memory_bytes);
  a("os", v.os);
  a("load_at_start", v.load_at_start);
  a("load_at_end", v.load_at_end);
}

void fields(auto& a, Is<ClockReport> auto& v) {
  a("readings", v.readings);
  a("least_sm_mhz", v.least_sm_mhz);
  a("most_sm_mhz", v.most_sm_mhz);
  a("least_memory_mhz", v.least_memory_mhz);
  a("most_memory_mhz", v.most_memory_mhz);
  a("most_celsius", v.most_celsius);
  a("most_watts", v.most_watts);
  a("power_states", v.power_states);
  a("throttled_by", v.throttled_by);
}

void fields(auto& a, Is<EffectReport> auto& v) {
  a("name", v.name);
  a("needed", v.needed);
  a("reason", v.reason);
  a("passes", v.passes);
  a("ms", v.ms);
  a("ms_ci95", v.ms_ci95);
  a("bytes", v.bytes);
}

void fields(auto& a, Is<EffectPricing> auto& v) {
  a("case", v.case_id);
  a("rounds", v.rounds);
  a("span_ms", v.span_ms);
  a("span_ms_all", v.span_ms_all);
  a("ratio", v.ratio.value);
  a("ratio_ci95", v.ratio.ci95);
  a("bytes", v.bytes);
  a("bytes_all", v.bytes_all);
  a("seconds", v.seconds);
}

void fields(auto& a, Is<SceneReport> auto& v) {
  a("name", v.name);
  a("hash", v.hash);
  a("triangles", v.triangles);
  a("warnings", v.warnings);
  a("light_flux", v.light_flux);
  a("exposure", v.exposure);
  a.unless_empty("contact", v.contact);
  a.unless_empty("notes", v.notes);
  a("clocks", v.clocks);
  a.unless_empty("effects", v.effects);
  a("effects_priced", v.effects_priced);
  a("region", v.region);
}

void fields(auto& a, Is<TimeNoise> auto& v) {
  a("column", v.column);
  a("ratio", v.ratio.value);
  a("ci95", v.ratio.ci95);
  a("noise_floor", v.noise_floor);
}

void fields(auto& a, Is<AaPair> auto& v) {
  a("scene", v.scene);
  a("case", v.case_id);
  a("twin", v.twin_id);
  a("times", v.times);
}

void fields(auto& a, Is<WallTime> auto& v) {
  a("total_s", v.total_s);
  a("device_s", v.device_s);
  a("references_s", v.references_s);
  a("visibility_s", v.visibility_s);
  a("compilation_s", v.compilation_s);
  a("overhead_ratio", v.overhead_ratio);
}

void fields(auto& a, Is<Report> auto& v) {
  a.constant("schema", kReportSchema);
  a("created", v.created);
  a("argv", v.argv);
  a("git", v.git);
  a.unless_empty("kernels", v.kernels);
  a.object("environment", [&](auto& inner) {
    inner("device", v.device);
    inner("host", v.host);
  });
  a("config", v.config);
  a("complete", v.complete);
  a("wall", v.wall);
  a("scenes", v.scenes);
  a.unless_empty("aa", v.aa);
  a("cases", v.cases);
  a.unless_empty("analysis", v.analysis);
}

Json to_json(const Report& report) {
  JsonWriter writer;
  fields(writer, report);
  return std::move(writer.json);
}

namespace {

// The file holds the number of pixels once a case, not with every seed; reports of old lack the method's
// time.
void restore(CaseResult& c) {
  if (c.frame && !c.frame->method) c.frame->method = method_time(c.passes);
  if (!c.accuracy) return;
  for (SeedResult& s : c.seeds) s.errors.pixels = c.accuracy->pixels;
}

// Reports of old have one pair for all scenes, an object, and of its times the frame's alone.
Json with_pairs(Json json) {
  Json time = json["aa"], pair = {{"scene", ""}, {"case", time["case"]}, {"twin", time["twin"]}};
  for (const Json& c : json["cases"]) {
    if (c["id"] == pair["case"]) pair["scene"] = c["scene"];
  }
  time["column"] = "frame";
  pair["times"] = Json::array({time});
  json["aa"] = Json::array({pair});
  return json;
}

// Until the parts of a frame had names, "visibility" was that of the host's rays.
void name_rays(Report* report) {
  for (AaPair& pair : report->aa) {
    const auto is_part = [](const TimeNoise& time) {
      return time.column == "fixed" || time.column == "shade";
    };
    if (std::ranges::any_of(pair.times, is_part)) continue;
    for (TimeNoise& time : pair.times)
      if (time.column == "visibility") time.column = "rays";
  }
}

}  // namespace

Report report_from_json(const Json& json) {
  Report report;
  const bool of_old = json.contains("aa") && !json["aa"].is_array();
  const Json renewed = of_old ? with_pairs(json) : Json();
  JsonReader reader(of_old ? renewed : json);
  fields(reader, report);
  for (CaseResult& c : report.cases) restore(c);
  name_rays(&report);
  return report;
}

template <class T>
Json part_to_json(const T& part) {
  JsonWriter writer;
  fields(writer, part);
  return std::move(writer.json);
}

template <class T>
T part_from_json(const Json& json) {
  T part;
  JsonReader reader(json);
  fields(reader, part);
  if constexpr (std::same_as<T, CaseResult>) restore(part);
  return part;
}

#define VSGLBENCH_PART(T)               \
  template Json part_to_json(const T&); \
  template T part_from_json(const Json&);
VSGLBENCH_PART(AaPair)
VSGLBENCH_PART(CaseResult)
VSGLBENCH_PART(Coverage)
VSGLBENCH_PART(DeviceReport)
VSGLBENCH_PART(KernelStats)
VSGLBENCH_PART(SceneReport)
VSGLBENCH_PART(TimeNoise)
VSGLBENCH_PART(WallTime)
#undef VSGLBENCH_PART

}  // namespace vsglbench
