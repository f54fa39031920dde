#include "sweep/shard_folder.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>

#include "base/error.h"
#include "base/hash.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

constexpr const char* kSchema = "vsglbench.shard/1";

void sync_one(const fs::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool synced = file >= 0 && ::fsync(file) == 0;
  const int error = errno;
  if (file >= 0) ::close(file);
  if (!synced && error != EINVAL && error != EROFS)
    throw fail(ErrorKind::output, "{}: can't be synced: {}", path.string(), std::strerror(error));
}

// "00017" and "00017.attempt-2" as 17; nothing for any other name.
std::optional<size_t> shard_of(const std::string& name) {
  size_t shard = 0;
  const auto parsed = std::from_chars(name.data(), name.data() + name.size(), shard);
  if (parsed.ec != std::errc()) return std::nullopt;
  const std::string rest(parsed.ptr, name.data() + name.size());
  return rest.empty() || rest.starts_with(".attempt-") ? std::optional(shard) : std::nullopt;
}

FinishedShard look_at(const fs::path& folder, const std::string& plan, size_t shard) {
  FinishedShard out{.folder = folder};
  std::ifstream file(folder / "host.json", std::ios::binary);
  const Json json = Json::parse(file, nullptr, false);
  std::error_code ec;
  const uintmax_t bytes = fs::file_size(folder / "report.json", ec);
  try {
    out.record = host_record_from_json(json);
    if (out.record.plan != plan || out.record.shard != shard)
      out.problem = "it is of another plan";
    else if (ec)
      out.problem = "it has no report.json";
    else if (bytes != out.record.report_bytes)
      out.problem = fmt::format("its report.json has {} bytes of {}", bytes, out.record.report_bytes);
  } catch (const Json::exception&) {
    out.problem = "it has no sound host.json";
  }
  return out;
}

// The one that was done first, then those done again by attempt.
void sort(std::vector<FinishedShard>* folders) {
  std::ranges::sort(*folders, {}, [](const FinishedShard& f) {
    return std::pair(f.folder.extension() != "", f.record.attempt);
  });
}

Json device_json(const HostRecord& r) {
  Json device = part_to_json(r.device);
  device["uuid"] = r.uuid;
  device["pci"] = r.pci;
  return device;
}

}  // namespace

std::string shard_name(size_t shard) { return fmt::format("{:05}", shard); }

Json to_json(const HostRecord& r) {
  return {{"schema", kSchema},
          {"plan", r.plan},
          {"shard", r.shard},
          {"attempt", r.attempt},
          {"host", r.host},
          {"node", r.node},
          {"job", r.job},
          {"device", device_json(r)},
          {"ended", r.ended},
          {"seconds", r.seconds},
          {"cases", {{"ok", r.cases.ok}, {"failed", r.cases.failed}, {"skipped", r.cases.skipped}}},
          {"report_bytes", r.report_bytes}};
}

HostRecord host_record_from_json(const Json& json) {
  HostRecord r;
  r.plan = json.at("plan");
  r.shard = json.at("shard");
  r.attempt = json.at("attempt");
  r.host = json.at("host");
  r.node = json.at("node");
  r.job = json.at("job");
  Json device = json.at("device");
  r.uuid = device.at("uuid");
  r.pci = device.at("pci");
  device.erase("uuid");
  device.erase("pci");
  r.device = part_from_json<DeviceReport>(device);
  r.ended = json.at("ended");
  r.seconds = json.at("seconds");
  const Json& cases = json.at("cases");
  r.cases = {cases.at("ok"), cases.at("failed"), cases.at("skipped")};
  r.report_bytes = json.at("report_bytes");
  return r;
}

std::string device_class(const DeviceReport& d) {
  return Json{d.name, d.driver, d.driver_version, d.subgroup_size, d.settings}.dump();
}

std::string class_text(const DeviceReport& d) {
  std::string text =
      fmt::format("{}, {} {}, subgroup {}", d.name, d.driver, d.driver_version, d.subgroup_size);
  for (const auto& [name, value] : d.settings) text += fmt::format(", {}={}", name, value);
  return text;
}

std::string class_folder(const DeviceReport& d) {
  std::string out;
  for (const char c : d.name) {
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '.')
      out += c;
    else if (!out.empty() && out.back() != '-')
      out += '-';
  }
  return out.substr(0, 80) + (out.ends_with('-') ? "" : "-") +
         Hasher().text(device_class(d)).hex().substr(0, 6);
}

fs::path SweepFolder::attempts(size_t shard) const { return root_ / "attempts" / shard_name(shard); }
fs::path SweepFolder::work(size_t shard, size_t attempt) const {
  return root_ / "shards" / fmt::format(".{}.attempt-{}", shard_name(shard), attempt);
}
fs::path SweepFolder::done(size_t shard) const { return root_ / "shards" / shard_name(shard); }
fs::path SweepFolder::done_again(size_t shard, size_t attempt) const {
  return root_ / "shards" / fmt::format("{}.attempt-{}", shard_name(shard), attempt);
}

std::vector<std::vector<FinishedShard>> SweepFolder::finished(const std::string& plan, size_t count) const {
  std::vector<std::vector<FinishedShard>> out(count);
  std::error_code ec;
  for (const auto& entry : fs::directory_iterator(root_ / "shards", ec)) {
    const auto shard = shard_of(entry.path().filename().string());
    if (shard && *shard < count) out[*shard].push_back(look_at(entry.path(), plan, *shard));
  }
  for (auto& folders : out) sort(&folders);
  return out;
}

std::vector<FinishedShard> SweepFolder::finished_of(const std::string& plan, size_t shard) const {
  return finished(plan, shard + 1).back();
}

fs::path SweepFolder::finish(size_t shard, size_t attempt) const {
  const fs::path from = work(shard, attempt);
  sync_path(from);
  for (const fs::path& to : {done(shard), done_again(shard, attempt)}) {
    if (::rename(from.c_str(), to.c_str()) == 0) {
      sync_one(root_ / "shards");
      return to;
    }
    if (errno != ENOTEMPTY && errno != EEXIST) break;
  }
  throw fail(ErrorKind::output, "{}: can't be moved to {}: {}", from.string(), done(shard).string(),
             std::strerror(errno));
}

void sync_path(const fs::path& path) {
  std::error_code ec;
  if (fs::is_directory(path, ec)) {
    for (const auto& entry : fs::recursive_directory_iterator(path)) sync_one(entry.path());
  }
  sync_one(path);
}

}  // namespace vsglbench
