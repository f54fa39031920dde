// Named, labelled, timestamped passes with a full barrier between any two.
#pragma once

#include <vulkan/vulkan.h>

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gpu/kernel.h"
#include "gpu/limits.h"
#include "gpu/pass_id.h"

namespace vsglbench {

struct PassTime {
  PassId pass;
  double ms = 0;
};

struct SubmissionTimes {
  std::vector<PassTime> passes;  // in order; one may come more than once
  double span_ms = 0;            // from the first timestamp to the last
  unsigned dispatches = 0;
};

// What a pass's dispatches and fills were given, in their order.
struct PassRecord {
  struct Use {
    const Buffer* buffer;
    const Kernel* kernel;  // null: filled
    uint32_t binding;
  };
  PassId pass;
  std::vector<Use> uses;
};

// Looks at every pass by itself. Commands that don't go through dispatch() or fill() it does not hear of.
class PassObserver {
 public:
  virtual ~PassObserver() = default;
  virtual void before(const PassRecord& pass) = 0;  // recorded, and not yet begun; the device is idle
  virtual void after(const PassRecord& pass) = 0;   // finished
};

// Records one command buffer at a time: begin, passes, submit_and_wait.
class Recorder {
 public:
  explicit Recorder(Device& device);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  Device& device() { return device_; }
  VkCommandBuffer commands() const { return commands_; }
  DescriptorArena& descriptors() { return descriptors_; }

  void begin();
  // Everything `record` records belongs to `pass`. Passes don't nest.
  void pass(const PassId& pass, const std::function<void()>& record);
  // Inside a pass. Later dispatches see what earlier ones wrote only after barrier().
  void dispatch(const Kernel& kernel, const Bindings& bindings, const void* push, size_t push_bytes,
                uint32_t groups_x, uint32_t groups_y = 1, uint32_t groups_z = 1);
  template <class Push>
  void dispatch(const Kernel& kernel, const Bindings& bindings, const Push& push, uint32_t groups_x,
                uint32_t groups_y = 1, uint32_t groups_z = 1) {
    static_assert(sizeof(Push) <= limits::push_bytes && std::is_trivially_copyable_v<Push>);
    dispatch(kernel, bindings, &push, sizeof push, groups_x, groups_y, groups_z);
  }
  void barrier();
  void fill(const Buffer& buffer, uint32_t word);  // every 32-bit word but the guard's
  // Submits, waits, and reads the timestamps.
  SubmissionTimes submit_and_wait();
  unsigned dispatches() const { return dispatches_; }  // since begin()
  // From the next begin() on every pass is submitted and waited for by itself, so that times lack what passes
  // gain from each other. Null: no longer. The observer outlives it.
  void observe(PassObserver* observer);

 private:
  struct State;
  void open();
  void submit();
  void record_pass(const PassId& pass, const std::function<void()>& record);
  static constexpr uint32_t kMaxPasses = 512;
  Device& device_;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  VkQueryPool queries_ = VK_NULL_HANDLE;
  std::unique_ptr<State> state_;  // the rest; apart, so that plugins need not know its size
  DescriptorArena descriptors_;
  std::vector<PassId> passes_;  // of the open submission
  unsigned dispatches_ = 0;
};

// Groups of `size` that cover `count` items.
inline uint32_t groups_for(uint64_t count, uint32_t size) {
  return static_cast<uint32_t>((count + size - 1) / size);
}

}  // namespace vsglbench
