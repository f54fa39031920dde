// What a method is given to work with: its kernels and scratch memory.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "gpu/kernel.h"
#include "shaders/types.h"

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

// Device memory that several users share, one after the other: what it holds lasts for one frame only. It
// grows when more is asked for; ask again in every frame instead of keeping the handle. Behind it lies a
// guard; both hold unwritten_word at first.
class GrowingBuffer {
 public:
  static constexpr size_t kGuardBytes = 16384;
  // At least `bytes`. `name`: for labels.
  Buffer& get(Device& device, const std::string& name, size_t bytes);
  size_t size() const { return buffer_ ? buffer_.size() : 0; }

 private:
  Buffer buffer_;
};

// The memory of methods, by the names that they give it, shared by all cases of a run.
class ScratchPool {
 public:
  explicit ScratchPool(Device& device) : device_(device) {}
  Buffer& get(const std::string& name, size_t bytes);
  size_t bytes() const;
  void clear() { buffers_.clear(); }

 private:
  Device& device_;
  std::map<std::string, GrowingBuffer> buffers_;
};

class MethodContext {
 public:
  // `defines`: of every kernel, as lights are made to be shaded (frame/shading.h) and as the effects that the
  // scene calls for want them (frame/permutation.h). `lobes`: of the lights, as in shaders/types.h.
  MethodContext(KernelLibrary& kernels, ScratchPool& scratch, std::filesystem::path folder,
                ShaderDefines defines = {}, unsigned lobes = DIFFUSE_LOBE | SPECULAR_LOBE)
      : kernels_(kernels),
        scratch_(scratch),
        folder_(std::move(folder)),
        defines_(std::move(defines)),
        lobes_(lobes) {}
  Device& device() { return kernels_.device(); }
  // Which lobes the lights have that this context's kernels make.
  unsigned lobes() const { return lobes_; }
  // A kernel from the method's own folder.
  const Kernel& kernel(const std::string& file, const ShaderDefines& defines = {});
  // A kernel that several methods share, from harness/method/shaders.
  const Kernel& shared_kernel(const std::string& file, const ShaderDefines& defines = {});
  Buffer& scratch(const std::string& name, size_t bytes);

  // What the method has asked for so far.
  const std::set<const Kernel*>& kernels() const { return used_kernels_; }
  const std::set<std::filesystem::path>& kernel_files() const { return used_files_; }
  size_t scratch_bytes() const;
  struct Scratch {
    Buffer* buffer = nullptr;
    size_t bytes = 0, most = 0;  // asked for last, and at most
  };
  const std::map<std::string, Scratch>& scratch_buffers() const { return used_scratch_; }  // by name

 private:
  KernelLibrary& kernels_;
  ScratchPool& scratch_;
  std::filesystem::path folder_;
  ShaderDefines defines_;
  unsigned lobes_;
  const Kernel& use(const std::filesystem::path& path, const ShaderDefines& defines);
  std::set<const Kernel*> used_kernels_;
  std::set<std::filesystem::path> used_files_;
  std::map<std::string, Scratch> used_scratch_;
};

}  // namespace vsglbench
