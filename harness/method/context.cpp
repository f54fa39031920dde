#include "method/context.h"

#include <algorithm>

#include "base/file.h"
#include "method/kept_kernels.h"

namespace vsglbench {

std::vector<std::filesystem::path> KernelLibrary::include_dirs() {
  const auto harness = data_root() / "harness";
  return {harness / "shaders", harness / "method" / "shaders", harness / "frame"};
}

const Kernel& KernelLibrary::get(const std::filesystem::path& path, const ShaderDefines& defines) {
  auto& slot = kernels_[{path.string(), defines}];
  if (slot) return *slot;
  const auto kept = kept_includes(path.parent_path());
  slot = std::make_unique<Kernel>(device_, path, defines,
                                  kept.empty() ? include_dirs() : std::vector<std::filesystem::path>{kept});
  return *slot;
}

Buffer& GrowingBuffer::get(Device& device, const std::string& name, size_t bytes) {
  if (!buffer_ || buffer_.size() < bytes) {
    buffer_ = Buffer();  // give the old one back first: both may not fit
    buffer_ = Buffer(device, name, bytes, kGuardBytes);
    buffer_.fill(unwritten_word, (buffer_.size() + buffer_.guard()) / 4 * 4, 0);
  }
  return buffer_;
}

Buffer& ScratchPool::get(const std::string& name, size_t bytes) {
  return buffers_[name].get(device_, name, bytes);
}

size_t ScratchPool::bytes() const {
  size_t total = 0;
  for (const auto& [name, buffer] : buffers_) total += buffer.size();
  return total;
}

const Kernel& MethodContext::kernel(const std::string& file, const ShaderDefines& defines) {
  return use(folder_ / file, defines);
}

const Kernel& MethodContext::shared_kernel(const std::string& file, const ShaderDefines& defines) {
  const auto kept = kept_includes(folder_);
  return use((kept.empty() ? data_root() / "harness" / "method" / "shaders" : kept) / file, defines);
}

const Kernel& MethodContext::use(const std::filesystem::path& path, const ShaderDefines& defines) {
  used_files_.insert(path);
  ShaderDefines all = defines_;
  all.insert(defines.begin(), defines.end());
  return **used_kernels_.insert(&kernels_.get(path, all)).first;
}

Buffer& MethodContext::scratch(const std::string& name, size_t bytes) {
  Buffer& buffer = scratch_.get(name, bytes);
  Scratch& used = used_scratch_[name];
  used = {&buffer, bytes, std::max(used.most, bytes)};
  return buffer;
}

size_t MethodContext::scratch_bytes() const {
  size_t total = 0;
  for (const auto& [name, used] : used_scratch_) total += used.bytes;
  return total;
}

}  // namespace vsglbench
