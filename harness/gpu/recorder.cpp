#include "gpu/recorder.h"

#include <chrono>
#include <utility>

#include "base/error.h"
#include "gpu/check.h"
#include "gpu/loop_check.h"
#include "gpu/timestamps.h"

namespace vsglbench {

struct Recorder::State {
  VkFence fence = VK_NULL_HANDLE;
  SubmissionTimes times;  // of what was submitted since begin()
  PassObserver* observer = nullptr;
  bool in_pass = false;  // below: with an observer
  PassRecord pass;
};

Recorder::Recorder(Device& device)
    : device_(device), state_(std::make_unique<State>()), descriptors_(device) {
  const VkCommandBufferAllocateInfo allocate{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                             .commandPool = device.command_pool(),
                                             .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
                                             .commandBufferCount = 1};
  VK_CHECK(vkAllocateCommandBuffers(device.handle(), &allocate, &commands_));
  const VkQueryPoolCreateInfo queries{.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                      .queryType = VK_QUERY_TYPE_TIMESTAMP,
                                      .queryCount = 2 * kMaxPasses};
  VK_CHECK(vkCreateQueryPool(device.handle(), &queries, nullptr, &queries_));
  const VkFenceCreateInfo fence{.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
  VK_CHECK(vkCreateFence(device.handle(), &fence, nullptr, &state_->fence));
}

Recorder::~Recorder() {
  vkDestroyFence(device_.handle(), state_->fence, nullptr);
  vkDestroyQueryPool(device_.handle(), queries_, nullptr);
  vkFreeCommandBuffers(device_.handle(), device_.command_pool(), 1, &commands_);
}

void Recorder::observe(PassObserver* observer) { state_->observer = observer; }

void Recorder::begin() {
  dispatches_ = 0;
  state_->times = {};
  state_->in_pass = false;
  open();
}

void Recorder::open() {
  passes_.clear();
  descriptors_.reset();
  vkResetQueryPool(device_.handle(), queries_, 0, 2 * kMaxPasses);
  const VkCommandBufferBeginInfo begin{.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                       .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT};
  VK_CHECK(vkBeginCommandBuffer(commands_, &begin));
  barrier();
}

void Recorder::pass(const PassId& pass, const std::function<void()>& record) {
  State& s = *state_;
  if (!s.observer || s.in_pass) return record_pass(pass, record);
  s.in_pass = true;
  s.pass = {pass, {}};
  record_pass(pass, record);
  s.in_pass = false;
  s.observer->before(s.pass);
  submit();
  s.observer->after(s.pass);
  open();
}

void Recorder::record_pass(const PassId& pass, const std::function<void()>& record) {
  if (passes_.size() == kMaxPasses) throw std::logic_error("too many passes in one submission");
  const auto index = static_cast<uint32_t>(passes_.size());
  passes_.push_back(pass);
  if (device_.begin_label) {
    const std::string name = pass.name();
    const VkDebugUtilsLabelEXT label{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT,
                                     .pLabelName = name.c_str()};
    device_.begin_label(commands_, &label);
  }
  // lavapipe takes a timestamp when the next barrier flushes it, so each needs a barrier of its own: without
  // one a compute pass would start its clock after the work.
  vkCmdWriteTimestamp2(commands_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_, 2 * index);
  barrier();
  record();
  barrier();
  vkCmdWriteTimestamp2(commands_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_, 2 * index + 1);
  barrier();
  if (device_.end_label) device_.end_label(commands_);
}

void Recorder::dispatch(const Kernel& kernel, const Bindings& bindings, const void* push, size_t push_bytes,
                        uint32_t groups_x, uint32_t groups_y, uint32_t groups_z) {
  kernel.dispatch(commands_, descriptors_, bindings, push, push_bytes, groups_x, groups_y, groups_z);
  if (groups_x == 0 || groups_y == 0 || groups_z == 0) return;
  ++dispatches_;
  if (!state_->in_pass) return;
  for (uint32_t i = 0; i < bindings.all().size(); ++i) {
    if (const Buffer* buffer = bindings.all()[i].buffer) state_->pass.uses.push_back({buffer, &kernel, i});
  }
}

void Recorder::barrier() {
  const VkMemoryBarrier2 barrier{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                 .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                 .srcAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
                                 .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                 .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT};
  const VkDependencyInfo dependency{
      .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &barrier};
  vkCmdPipelineBarrier2(commands_, &dependency);
}

void Recorder::fill(const Buffer& buffer, uint32_t word) {
  vkCmdFillBuffer(commands_, buffer.handle(), 0, buffer.size() / 4 * 4, word);
  if (state_->in_pass) state_->pass.uses.push_back({&buffer, nullptr, 0});
}

SubmissionTimes Recorder::submit_and_wait() {
  submit();
  state_->times.dispatches = dispatches_;
  return std::move(state_->times);
}

// Waits, too, and adds what was timed to the times so far.
void Recorder::submit() {
  VK_CHECK(vkEndCommandBuffer(commands_));
  const VkSubmitInfo submit{
      .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &commands_};
  const auto submitted = std::chrono::steady_clock::now();
  VK_CHECK(vkQueueSubmit(device_.queue(), 1, &submit, state_->fence));
  VK_CHECK(vkWaitForFences(device_.handle(), 1, &state_->fence, VK_TRUE, UINT64_MAX));
  const std::chrono::duration<double, std::milli> waited = std::chrono::steady_clock::now() - submitted;
  VK_CHECK(vkResetFences(device_.handle(), 1, &state_->fence));
  if (LoopCheck* check = LoopCheck::of(device_)) check->report();

  if (passes_.empty()) return;
  std::vector<uint64_t> stamps(2 * passes_.size());
  VK_CHECK(vkGetQueryPoolResults(device_.handle(), queries_, 0, static_cast<uint32_t>(stamps.size()),
                                 stamps.size() * sizeof(uint64_t), stamps.data(), sizeof(uint64_t),
                                 VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT));
  const TimestampClock clock{static_cast<double>(device_.info().timestamp_period_ns) * 1e-6,
                             device_.info().timestamp_valid_bits};
  if (const std::string fault = timestamp_fault(stamps, clock, waited.count()); !fault.empty()) {
    throw fail(ErrorKind::case_failed, "pass {}: the device's clock can't be true: {}", passes_.front(),
               fault);
  }
  for (size_t i = 0; i < passes_.size(); ++i) {
    state_->times.passes.push_back({passes_[i], clock.milliseconds(stamps[2 * i], stamps[2 * i + 1])});
  }
  state_->times.span_ms += clock.milliseconds(stamps.front(), stamps.back());
}

}  // namespace vsglbench
