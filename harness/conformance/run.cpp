#include "conformance/run.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/nearest.h"
#include "frame/checked_method.h"

namespace vsglbench {
namespace {

constexpr size_t kGuardBytes = 4096;
constexpr size_t kWideGuard = 64 << 20, kAllWideGuards = 512 << 20;
constexpr uint32_t kGuardWord = 0x5AFE5AFEu;
constexpr uint32_t kLeftoverWord = 0x7FC0FFEEu;  // a NaN, and a large index

// Writes `inside` up to byte `end`, and guard words from there on.
void write_guarded(Buffer& buffer, size_t end, uint32_t inside) {
  buffer.fill(inside, end, 0);
  buffer.fill(kGuardWord, buffer.size() / 4 * 4 - end, end);
}

// Byte of the first guard word that was written, counted from `end`; -1: none was. Recorder::fill() writes
// whole buffers, this one's guard too, and is no overrun: what counts is a word unlike the last one.
int64_t first_overrun(const Buffer& buffer, size_t end) {
  std::vector<uint32_t> guard((buffer.size() - end) / 4);
  buffer.download(guard.data(), guard.size() * 4, end);
  const auto changed = std::ranges::find_if(guard, [&](uint32_t word) { return word != guard.back(); });
  return changed == guard.end() ? -1 : 4 * (changed - guard.begin());
}

std::string describe_overrun(const std::string& name, size_t end, int64_t at) {
  return at < 0 ? "" : fmt::format("byte {} past the end of {} ({} bytes) was written", at, name, end);
}

// Counts dispatches that no pass holds: the recorder labels every pass, and this listens to the labels.
class DispatchWatch {
 public:
  explicit DispatchWatch(Recorder& recorder)
      : device_(recorder.device()), begin_(device_.begin_label), end_(device_.end_label) {
    watched_ = this;
    recorder_ = &recorder;
    device_.begin_label = &DispatchWatch::pass_begins;
    device_.end_label = &DispatchWatch::pass_ends;
  }
  ~DispatchWatch() {
    device_.begin_label = begin_;
    device_.end_label = end_;
    watched_ = nullptr;
  }
  DispatchWatch(const DispatchWatch&) = delete;
  DispatchWatch& operator=(const DispatchWatch&) = delete;
  unsigned outside() const { return recorder_->dispatches() - inside_; }

 private:
  static void VKAPI_CALL pass_begins(VkCommandBuffer commands, const VkDebugUtilsLabelEXT* label) {
    watched_->before_ = watched_->recorder_->dispatches();
    if (watched_->begin_) watched_->begin_(commands, label);
  }
  static void VKAPI_CALL pass_ends(VkCommandBuffer commands) {
    watched_->inside_ += watched_->recorder_->dispatches() - watched_->before_;
    if (watched_->end_) watched_->end_(commands);
  }
  static inline DispatchWatch* watched_ = nullptr;
  Device& device_;
  PFN_vkCmdBeginDebugUtilsLabelEXT begin_;
  PFN_vkCmdEndDebugUtilsLabelEXT end_;
  Recorder* recorder_ = nullptr;
  unsigned before_ = 0, inside_ = 0;
};

// The method; where it reads a parameter that it does not declare, the error says which.
std::unique_ptr<Method> create(const MethodInfo& info, MethodContext& context, const Json& parameters) {
  try {
    return make_method(info, context, parameters);
  } catch (const Json::out_of_range& e) {
    std::vector<std::string> declared;
    for (const ParameterInfo& p : info.parameters) declared.push_back(p.name);
    const std::string what = e.what();  // "[...] key 'blurr' not found"
    const size_t open = what.find('\''), close = what.rfind('\'');
    const std::string key = open < close ? what.substr(open + 1, close - open - 1) : "";
    throw fail(ErrorKind::plugin, "`create` reads parameter '{}', which MethodInfo::parameters lacks{}", key,
               suggestion(key, declared));
  }
}

}  // namespace

MethodRun::MethodRun(KernelLibrary& kernels, const MethodInfo& info, const Json& parameters)
    : kernels_(kernels),
      scratch_(kernels.device()),
      recorder_(kernels.device()),
      context_(kernels, scratch_, info.folder),
      method_(create(info, context_, resolve_parameters(info, parameters))),
      guard_bytes_(kGuardBytes) {
  if (!method_) throw std::logic_error("`create` made no method");
}

MethodRun::~MethodRun() = default;

HalfOutput MethodRun::frame(const DeviceHalf& texels, Half half, uint32_t wanted, glm::uvec2 shift) {
  const Field field = texels.field(half, method_->uses_importance());
  const uint32_t count = method_->light_count(wanted, field.texels());
  const size_t bytes = count * light_stride(method_->kind());
  // Never less than what a buffer rounds up to, so that the guard is where it is looked for.
  Buffer lights(kernels_.device(), "lights", bytes + guard_behind(bytes));
  write_guarded(lights, bytes, unwritten_word);
  HalfOutput out;
  recorder_.begin();
  {
    const DispatchWatch watch(recorder_);
    Steps steps(recorder_, half);
    method_->generate(steps, field, {&lights, count, shift});
    out.dispatches_outside = watch.outside();
  }
  out.passes = recorder_.submit_and_wait().passes;
  out.lights = read_lights(method_->kind(), lights, count);
  out.overrun = describe_overrun("the lights", bytes, first_overrun(lights, bytes));
  if (out.overrun.empty()) out.overrun = overrun_scratch();
  return out;
}

void MethodRun::widen_guards(const MethodRun& other) {
  const size_t buffers = other.context_.scratch_buffers().size() + 1;
  guard_bytes_ = std::min(kWideGuard, kAllWideGuards / buffers / 4 * 4);
}

// What the device can bind behind so many bytes.
size_t MethodRun::guard_behind(size_t bytes) const {
  const uint64_t range = kernels_.device().info().max_storage_range;
  const uint64_t room = range > bytes + kGuardBytes ? (range - bytes) / 4 * 4 : kGuardBytes;
  return std::min<uint64_t>(guard_bytes_, room);
}

void MethodRun::guard_scratch_like(MethodRun& other) {
  for (const auto& [name, last] : other.context_.scratch_buffers()) {
    const size_t bytes = last.buffer->size() / 4 * 4;  // the most that was asked for
    write_guarded(scratch_.get(name, bytes + guard_behind(bytes)), bytes, kLeftoverWord);
    guarded_[name] = bytes;
  }
}

std::string MethodRun::overrun_scratch() {
  for (const auto& [name, bytes] : guarded_) {
    const int64_t at = first_overrun(scratch_.get(name, 0), bytes);
    if (at >= 0) return describe_overrun(fmt::format("scratch buffer '{}'", name), bytes, at);
  }
  return "";
}

}  // namespace vsglbench
