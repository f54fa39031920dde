#include "sweep/device_choice.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>

#include "base/log.h"
#include "base/supervise.h"
#include "gpu/clock_watch.h"

namespace vsglbench {
namespace {

bool is_gpu(const DeviceInfo& d) { return d.type != "cpu"; }

std::string names_of(const std::vector<DeviceInfo>& devices) {
  std::string text;
  for (const DeviceInfo& d : devices)
    text += fmt::format("{}{} (UUID {})", text.empty() ? "" : ", ", d.name, d.uuid);
  return text.empty() ? "none" : text;
}

// "GPU-0123abcd-…" as the hex digits of DeviceInfo::uuid, or their beginning: CUDA takes a part that is one
// device's alone.
std::string digits_of(const std::string& uuid) {
  std::string out;
  for (const char c : uuid.substr(uuid.find('-') + 1))
    if (c != '-') out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

const DeviceInfo& of_uuid(const std::vector<DeviceInfo>& devices, const std::string& digits,
                          const std::string& given) {
  const DeviceInfo* found = nullptr;
  for (const DeviceInfo& d : devices) {
    if (digits.empty() || !d.uuid.starts_with(digits)) continue;
    if (found) throw WrongDevice(fmt::format("CUDA_VISIBLE_DEVICES={} is the beginning of two UUIDs", given));
    found = &d;
  }
  if (found) return *found;
  throw WrongDevice(
      fmt::format("Vulkan doesn't know the GPU of CUDA_VISIBLE_DEVICES={}; it knows {}; is its "
                  "Vulkan driver installed?",
                  given, names_of(devices)));
}

// Of an index whose UUID nobody tells.
const DeviceInfo& only_one(const std::vector<DeviceInfo>& devices, const std::string& given) {
  const auto gpus = std::ranges::count_if(devices, is_gpu);
  if (gpus > 1) {
    throw WrongDevice(
        fmt::format("which of {} GPUs CUDA_VISIBLE_DEVICES={} is can't be told without NVIDIA's "
                    "management library; give --device",
                    gpus, given));
  }
  const DeviceInfo& only = gpus == 1 ? *std::ranges::find_if(devices, is_gpu) : select_device(devices, "");
  log_warning("CUDA_VISIBLE_DEVICES={} can't be told by its UUID; measuring on {}, the only {}", given,
              only.name, gpus == 1 ? "GPU" : "kind of device");
  return only;
}

const DeviceInfo& given_by_engine(const std::vector<DeviceInfo>& devices, const std::string& given,
                                  const GpuOfIndex& gpu_of_index) {
  const std::string first = given.substr(0, given.find(','));
  if (first.empty() || first == "-1" || first == "NoDevFiles") {
    const auto other = std::ranges::find_if_not(devices, is_gpu);
    if (other != devices.end()) return *other;
    throw WrongDevice(
        fmt::format("CUDA_VISIBLE_DEVICES='{}' gives the task no GPU, and the machine has no other "
                    "device; ask the engine for one (--gres)",
                    given));
  }
  if (first.starts_with("MIG-"))
    throw WrongDevice(
        fmt::format("CUDA_VISIBLE_DEVICES={} is a part of a GPU, which Vulkan can't use", given));
  if (first.starts_with("GPU-")) return of_uuid(devices, digits_of(first), given);
  unsigned index = 0;
  const auto parsed = std::from_chars(first.data(), first.data() + first.size(), index);
  if (parsed.ec != std::errc() || parsed.ptr != first.data() + first.size())
    throw WrongDevice(fmt::format("CUDA_VISIBLE_DEVICES='{}' is neither index nor UUID", given));
  const auto uuid = gpu_of_index(index);
  return uuid ? of_uuid(devices, *uuid, given) : only_one(devices, given);
}

// The message of the process that looks at the devices.
struct ChosenDevice {
  DeviceInfo info;
  std::string wrong;  // WrongDevice's message
};

Json to_json(const ChosenDevice& c) {
  const DeviceInfo& d = c.info;
  return {{"index", d.index}, {"name", d.name},     {"uuid", d.uuid},  {"pci", d.pci},
          {"type", d.type},   {"driver", d.driver}, {"wrong", c.wrong}};
}

void from_json(const Json& json, ChosenDevice* c) {
  c->info.index = json.at("index");
  c->info.name = json.at("name");
  c->info.uuid = json.at("uuid");
  c->info.pci = json.at("pci");
  c->info.type = json.at("type");
  c->info.driver = json.at("driver");
  c->wrong = json.at("wrong");
}

}  // namespace

DeviceWish device_wish(const std::string& select, const std::string& require) {
  DeviceWish wish{select, std::nullopt, require};
  if (const char* given = std::getenv("CUDA_VISIBLE_DEVICES")) wish.cuda_visible = given;
  return wish;
}

bool is_required(const std::string& name, const std::string& uuid, const std::string& require) {
  return require.empty() || name.find(require) != std::string::npos || uuid == digits_of("GPU-" + require) ||
         uuid == digits_of(require);
}

const DeviceInfo& choose_device(const std::vector<DeviceInfo>& devices, const DeviceWish& wish,
                                const GpuOfIndex& gpu_of_index) {
  const bool by_engine = wish.select.empty() && wish.cuda_visible && !devices.empty();
  const DeviceInfo& chosen = by_engine ? given_by_engine(devices, *wish.cuda_visible, gpu_of_index)
                                       : select_device(devices, wish.select);
  if (is_required(chosen.name, chosen.uuid, wish.require)) return chosen;
  throw WrongDevice(fmt::format("the task's device is {} (UUID {}), and '{}' is required", chosen.name,
                                chosen.uuid, wish.require));
}

DeviceInfo find_device(const DeviceWish& wish) {
  ChosenDevice found;
  supervise<ChosenDevice>(
      {.name = "looking at the devices",
       .work =
           [&](const Worker<ChosenDevice>& worker, const std::vector<size_t>& left) {
             ChosenDevice chosen;
             try {
               chosen.info =
                   choose_device(list_devices(), wish, [](unsigned index) { return nvml_uuid_of(index); });
             } catch (const WrongDevice& e) {
               chosen.wrong = e.what();
             }
             worker.done(left.front(), chosen);
           },
       .told = [&](const ChosenDevice& chosen) { found = chosen; },
       .lost =
           [&](size_t, const End& end) {
             if (end.kind == ErrorKind::device) throw Error(end.kind, end.how);
             throw fail(ErrorKind::device, "looking at the devices {}; see vsglbench doctor", end.how);
           }});
  if (!found.wrong.empty()) throw WrongDevice(found.wrong);
  return found.info;
}

}  // namespace vsglbench
