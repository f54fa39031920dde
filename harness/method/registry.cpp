#include "method/registry.h"

#include <dlfcn.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/log.h"
#include "base/nearest.h"
#include "base/supervise.h"
#include "method/kept_kernels.h"
#include "method/plugin.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

constexpr double kLoadLimit_s = 20;  // a plugin that takes longer to load hangs

std::vector<fs::path>& own_folders() {
  static std::vector<fs::path> folders;
  return folders;
}

std::vector<fs::path> split(const std::string& folders) {
  std::vector<fs::path> out;
  for (size_t at = 0; at <= folders.size();) {
    const size_t end = std::min(folders.find(':', at), folders.size());
    if (end > at) out.emplace_back(folders.substr(at, end - at));
    at = end + 1;
  }
  return out;
}

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

// UTF-8 without control characters: what can stand in a line, and in JSON.
bool is_text(const std::string& bytes) {
  try {
    [[maybe_unused]] const std::string quoted = Json(bytes).dump();
  } catch (const Json::exception&) {
    return false;
  }
  return std::ranges::none_of(bytes, is_control);
}

// The same with '?' for what is no ASCII text.
std::string shown(std::string bytes) {
  std::ranges::replace_if(
      bytes, [](char c) { return is_control(c) || (c & 0x80) != 0; }, '?');
  return bytes;
}

std::vector<fs::path> libraries_in(const fs::path& folder) {
  std::vector<fs::path> out;
  std::error_code ec;
  for (const auto& entry : fs::directory_iterator(folder, ec)) {
    if (entry.path().extension() != ".so" || !entry.is_regular_file(ec)) continue;
    if (const std::string name = fs::absolute(entry.path()).string(); is_text(name)) {
      out.push_back(entry.path());
    } else {
      log_warning("plugin {}: left out: its name holds bytes that are no text; rename it", shown(name));
    }
  }
  std::ranges::sort(out, {}, [](const fs::path& p) { return p.stem(); });
  return out;
}

// What this file's name and place say.
MethodInfo named_after(const fs::path& library) {
  MethodInfo info;
  info.name = library.stem().string();
  info.library = fs::absolute(library).lexically_normal();
  info.folder = info.library.parent_path() / info.name;
  return info;
}

MethodInfo refuse(const fs::path& library, const std::string& why) {
  MethodInfo info = named_after(library);
  info.refused = fmt::format("plugin {}: {}", info.library.string(), why);
  return info;
}

// A default outside its own range, or one name twice, is the plugin's mistake: better told now than in a run.
std::string mistake_in(const MethodInfo& info) {
  if (!info.create) return "has no `create`";
  if (info.makes_importance && !is_light_kind(*info.makes_importance))
    return "makes importance by lights of no kind";
  for (const double bound : {info.flux_bound, info.uneven_flux_bound})
    if (!std::isfinite(bound)) return fmt::format("has a flux_bound of {}", bound);
  for (const auto& p : info.parameters) {
    if (!std::isfinite(p.minimum) || !std::isfinite(p.maximum)) {
      return fmt::format("has a parameter '{}' within {} … {}; both must be finite", p.name, p.minimum,
                         p.maximum);
    }
    const auto same = [&](const ParameterInfo& q) { return q.name == p.name; };
    if (std::ranges::count_if(info.parameters, same) > 1) {
      return fmt::format("has two parameters '{}'", p.name);
    }
  }
  try {
    resolve_parameters(info, Json::object());
  } catch (const Error& e) {
    return fmt::format("has a default that it refuses itself: {}", e.what());
  }
  return "";
}

// Opens it in this process, for good.
MethodInfo open_plugin(const fs::path& library) {
  MethodInfo place = named_after(library);
  void* handle = ::dlopen(place.library.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle) return refuse(library, fmt::format("can't be loaded: {}", ::dlerror()));
  using Entry = const PluginHeader* (*)();
  const auto entry = reinterpret_cast<Entry>(::dlsym(handle, "vsglbench_plugin"));
  if (!entry) return refuse(library, "is no vsglbench method (it lacks VSGLBENCH_METHOD)");
  const PluginHeader* header = entry();
  if (header->abi != plugin_abi) {
    return refuse(library, fmt::format("was built for plugin ABI {}, but this programme has ABI {}; build it "
                                       "again against this vsglbench",
                                       header->abi, plugin_abi));
  }
  if (!fs::is_directory(place.folder)) {
    try {
      place.folder = unpack_kernels(static_cast<const char* const*>(::dlsym(handle, "vsglbench_kernels")));
    } catch (const Error& e) {
      return refuse(library, fmt::format("its kernels can't be unpacked: {}", e.what()));
    }
  }
  if (place.folder.empty()) {
    return refuse(library, fmt::format("its folder of kernels {}/ is missing; copy it too", place.name));
  }
  MethodInfo info = header->info();
  info.name = place.name;
  info.library = place.library;
  info.folder = place.folder;
  if (const std::string mistake = mistake_in(info); !mistake.empty()) return refuse(library, mistake);
  return info;
}

// Asks each in a process of its own.
std::vector<MethodInfo> inspect(const std::vector<fs::path>& libraries) {
  std::vector<MethodInfo> found;
  supervise<MethodInfo>({.name = "plugins",
                         .jobs = libraries.size(),
                         .work =
                             [&](const Worker<MethodInfo>& worker, const std::vector<size_t>& left) {
                               for (const size_t i : left) {
                                 worker.now({i, "being loaded", kLoadLimit_s});
                                 worker.done(i, open_plugin(libraries[i]));
                               }
                             },
                         .told = [&](const MethodInfo& info) { found.push_back(info); },
                         .lost =
                             [&](size_t i, const End& end) {
                               found.push_back(refuse(libraries[i], end.how + " while it was loaded"));
                             }});
  return found;
}

std::vector<MethodInfo> search() {
  std::vector<fs::path> libraries;
  for (const auto& folder : plugin_folders()) {
    for (const auto& library : libraries_in(folder)) {
      const auto same = [&](const fs::path& other) { return other.stem() == library.stem(); };
      if (std::ranges::none_of(libraries, same)) libraries.push_back(library);
    }
  }
  return inspect(libraries);
}

MethodInfo checked(MethodInfo info, const DeviceInfo& device) {
  if (!info.refused.empty()) throw Error(ErrorKind::plugin, info.refused);
  std::vector<std::string> missing;
  for (const auto& feature : info.device_features) {
    if (std::ranges::count(device.features, feature) == 0) missing.push_back(feature);
  }
  if (!missing.empty()) {
    throw fail(ErrorKind::plugin, "plugin {}: needs {}, which {} lacks", info.library.string(),
               fmt::join(missing, ", "), device.name);
  }
  return info;
}

}  // namespace

void set_plugin_path(const std::string& folders) {
  own_folders() = split(folders);
  for (const auto& folder : own_folders()) {
    std::error_code ec;
    if (!fs::is_directory(folder, ec)) {
      throw fail(ErrorKind::usage, "--plugin-path {}: no such folder", folder.string());
    }
  }
}

std::vector<fs::path> plugin_folders() {
  std::vector<fs::path> folders = own_folders();
  if (const char* more = std::getenv("VSGLBENCH_PLUGINS")) {
    for (auto& folder : split(more)) folders.push_back(std::move(folder));
  }
  folders.push_back(library_directory() / "vsglbench" / "plugins");
  return folders;
}

const std::vector<const MethodInfo*>& all_methods() {
  static const std::vector<MethodInfo> found = search();
  static const std::vector<const MethodInfo*> pointers = [] {
    std::vector<const MethodInfo*> out;
    for (const MethodInfo& info : found) out.push_back(&info);
    return out;
  }();
  return pointers;
}

const MethodInfo& find_method(const std::string& name) {
  std::vector<std::string> known;
  for (const MethodInfo* method : all_methods()) {
    if (method->name == name) return *method;
    known.push_back(method->name);
  }
  throw fail(ErrorKind::config, "no method '{}'{}", name, suggestion(name, known));
}

// The programme's own folder is the last that is searched: a copy of its method under another name, in a
// folder of one's own, does not take its place unasked.
const MethodInfo& find_importance_maker(LightKind kind) {
  const auto serves = [&](const MethodInfo* method) {
    return method->refused.empty() && method->makes_importance == kind;
  };
  const fs::path own = plugin_folders().back();
  const auto is_own = [&](const MethodInfo* method) {
    return serves(method) && method->library.parent_path() == fs::absolute(own);
  };
  const auto& all = all_methods();
  auto found = std::ranges::find_if(all, is_own);
  if (found == all.end()) found = std::ranges::find_if(all, serves);
  if (found != all.end()) return **found;
  throw fail(ErrorKind::config,
             "no method says that it makes importance by lights of kind {}; build methods/, or use "
             "importance own",
             info_of(kind).name);
}

MethodInfo inspect_plugin(const fs::path& library) {
  std::error_code ec;
  if (const std::string name = fs::absolute(library).string(); !is_text(name)) {
    return refuse(shown(name), "its name holds bytes that are no text; rename it");
  }
  if (!fs::is_regular_file(library, ec)) return refuse(library, "no such file");
  return inspect({library}).front();
}

const MethodInfo& load_method(const std::string& name, const DeviceInfo& device) {
  static std::map<std::string, MethodInfo> loaded;
  const auto known = loaded.find(name);
  if (known != loaded.end()) return known->second;
  const MethodInfo& found = find_method(name);
  return loaded.emplace(name, checked(found.refused.empty() ? open_plugin(found.library) : found, device))
      .first->second;
}

MethodInfo load_plugin(const fs::path& library, const DeviceInfo& device) {
  return checked(open_plugin(library), device);
}

std::string plugin_hash(const MethodInfo& method) {
  std::map<std::string, fs::path> files{{"", method.library}};
  std::error_code ec;
  for (const auto& entry : fs::directory_iterator(method.folder, ec)) {
    const auto extension = entry.path().extension();
    if (extension == ".comp" || extension == ".glsl") files[entry.path().filename()] = entry.path();
  }
  Hasher hasher;
  for (const auto& [name, path] : files) hasher.text(name).text(read_text(path));
  return hasher.hex();
}

namespace {

// Json::other_error where there is none.
LightKind kind_named(const std::string& name) {
  for (const LightKind kind : light_kinds()) {
    if (info_of(kind).name == name) return kind;
  }
  throw Json::other_error::create(501, "no kind of light is called " + name, nullptr);
}

}  // namespace

void from_json(const Json& j, MethodInfo* info) {
  *info = named_after(j.at("library").get<std::string>());
  info->summary = j.at("summary");
  info->source = j.at("source");
  info->takes_light_count = j.at("takes_light_count");
  info->light_count = j.at("light_count");
  info->makes_vpls = j.at("makes_vpls");
  info->case_defaults = j.value("case_defaults", Json());
  info->device_features = j.at("device_features");
  info->flux_bound = j.at("flux_bound");
  info->uneven_flux_bound = j.at("uneven_flux_bound");
  if (!j.at("makes_importance").is_null()) info->makes_importance = kind_named(j.at("makes_importance"));
  info->refused = j.value("refused", "");
  for (const auto& p : j.at("parameters")) {
    info->parameters.push_back({p.at("name"), p.at("default"), p.at("description"), p.value("minimum", 0.0),
                                p.value("maximum", 0.0), p.value("choices", std::vector<std::string>())});
  }
}

Json to_json(const MethodInfo& method) {
  Json parameters = Json::array();
  for (const auto& p : method.parameters) {
    Json entry = {{"name", p.name}, {"default", p.default_value}, {"description", p.description}};
    if (p.default_value.is_string()) {
      entry["choices"] = p.choices;
    } else {
      entry["minimum"] = p.minimum;
      entry["maximum"] = p.maximum;
    }
    parameters.push_back(std::move(entry));
  }
  Json j = {
      {"name", method.name},
      {"summary", method.summary},
      {"source", method.source},
      {"takes_light_count", method.takes_light_count},
      {"light_count", method.light_count},
      {"makes_vpls", method.makes_vpls},
      {"parameters", std::move(parameters)},
      {"case_defaults", method.case_defaults},
      {"device_features", method.device_features},
      {"flux_bound", method.flux_bound},
      {"uneven_flux_bound", method.worst_flux_bound()},
      {"makes_importance", method.makes_importance ? Json(info_of(*method.makes_importance).name) : Json()},
      {"library", method.library.string()}};
  if (!method.refused.empty()) j["refused"] = method.refused;
  return j;
}

}  // namespace vsglbench
