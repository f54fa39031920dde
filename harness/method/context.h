// What a method is given to work with: its kernels and scratch memory.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "gpu/kernel.h"

namespace vsglbench {

// Compiles each (file, defines) once; cases share it.
class KernelLibrary {
 public:
  explicit KernelLibrary(Device& device) : device_(device) {}
  // Includes are found beside the file, in harness/shaders and in harness/method/shaders.
  const Kernel& get(const std::filesystem::path& path, const ShaderDefines& defines = {});
  Device& device() { return device_; }
  static std::vector<std::filesystem::path> include_dirs();

 private:
  Device& device_;
  std::map<std::pair<std::string, ShaderDefines>, std::unique_ptr<Kernel>> kernels_;
};

// Device buffers by name, shared by all cases of a run: what they hold lasts for one frame only. A buffer
// grows when a larger one is asked for; ask again in every frame instead of keeping the reference. Behind
// each lies a guard; both hold unwritten_word at first.
class ScratchPool {
 public:
  static constexpr size_t kGuardBytes = 16384;
  explicit ScratchPool(Device& device) : device_(device) {}
  Buffer& get(const std::string& name, size_t bytes);
  size_t bytes() const;
  void clear() { buffers_.clear(); }

 private:
  Device& device_;
  std::map<std::string, Buffer> buffers_;
};

class MethodContext {
 public:
  // `shading`: defines of every kernel, as lights are made to be shaded (frame/shading.h).
  MethodContext(KernelLibrary& kernels, ScratchPool& scratch, std::filesystem::path folder,
                ShaderDefines shading = {})
      : kernels_(kernels), scratch_(scratch), folder_(std::move(folder)), shading_(std::move(shading)) {}
  Device& device() { return kernels_.device(); }
  // A kernel from the method's own folder.
  const Kernel& kernel(const std::string& file, const ShaderDefines& defines = {});
  // A kernel that several methods share, from harness/method/shaders.
  const Kernel& shared_kernel(const std::string& file, const ShaderDefines& defines = {});
  Buffer& scratch(const std::string& name, size_t bytes);

  // What the method has asked for so far.
  size_t kernel_count() const { return used_kernels_.size(); }
  const std::set<std::filesystem::path>& kernel_files() const { return used_files_; }
  size_t scratch_bytes() const;
  const std::map<std::string, size_t>& scratch_buffers() const { return used_bytes_; }  // bytes by name
  // The same, of what was asked for under a name the most.
  const std::map<std::string, size_t>& largest_scratch() const { return most_bytes_; }

 private:
  KernelLibrary& kernels_;
  ScratchPool& scratch_;
  std::filesystem::path folder_;
  ShaderDefines shading_;
  const Kernel& use(const std::filesystem::path& path, const ShaderDefines& defines);
  std::set<const Kernel*> used_kernels_;
  std::set<std::filesystem::path> used_files_;
  std::map<std::string, size_t> used_bytes_, most_bytes_;
};

}  // namespace vsglbench
