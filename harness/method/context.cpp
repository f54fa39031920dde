#include "method/context.h"

#include "base/file.h"

namespace vsglbench {

std::vector<std::filesystem::path> KernelLibrary::include_dirs() {
  const auto harness = data_root() / "harness";
  return {harness / "shaders", harness / "method" / "shaders", harness / "frame"};
}

const Kernel& KernelLibrary::get(const std::filesystem::path& path, const ShaderDefines& defines) {
  auto& slot = kernels_[{path.string(), defines}];
  if (!slot) slot = std::make_unique<Kernel>(device_, path, defines, include_dirs());
  return *slot;
}

Buffer& ScratchPool::get(const std::string& name, size_t bytes) {
  Buffer& buffer = buffers_[name];
  if (!buffer || buffer.size() < bytes) {
    buffer = Buffer();  // give the old one back first: both may not fit
    buffer = Buffer(device_, name, bytes);
  }
  return buffer;
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
  return use(data_root() / "harness" / "method" / "shaders" / file, defines);
}

const Kernel& MethodContext::use(const std::filesystem::path& path, const ShaderDefines& defines) {
  used_files_.insert(path);
  ShaderDefines all = shading_;
  all.insert(defines.begin(), defines.end());
  return **used_kernels_.insert(&kernels_.get(path, all)).first;
}

Buffer& MethodContext::scratch(const std::string& name, size_t bytes) {
  used_bytes_[name] = bytes;
  return scratch_.get(name, bytes);
}

size_t MethodContext::scratch_bytes() const {
  size_t total = 0;
  for (const auto& [name, bytes] : used_bytes_) total += bytes;
  return total;
}

}  // namespace vsglbench
