#include "fuzz/targets.h"

namespace vsglbench::fuzz {

const std::vector<Target>& targets() {
  static const std::vector<Target> all = {{"gltf", read_gltf},
                                          {"scene", read_scene},
                                          {"config", read_config},
                                          {"exr", read_exr},
                                          {"reference_cache", read_reference_cache},
                                          {"spirv_cache", read_spirv_cache},
                                          {"sg_rows", read_sg_rows}};
  return all;
}

}  // namespace vsglbench::fuzz
