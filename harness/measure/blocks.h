// Inside measure/ only: the blocks that block_map.h names.
#pragma once

#include "measure/block_map.h"
#include "method/context.h"

namespace vsglbench {

std::unique_ptr<Block> make_sort_block(Device& device);
std::unique_ptr<Block> make_nearest_block(Device& device);
std::unique_ptr<Block> make_sum_block(Device& device);
std::unique_ptr<Block> make_warp_block(Device& device);
std::unique_ptr<Block> make_mipmap_block(Device& device);

// What the device's contestants of a block are made with.
struct BlockDevice {
  explicit BlockDevice(Device& d)
      : device(d), kernels(d), scratch(d), context(kernels, scratch, std::filesystem::path()), recorder(d) {}
  Device& device;
  KernelLibrary kernels;
  ScratchPool scratch;
  MethodContext context;
  Recorder recorder;
};

}  // namespace vsglbench
