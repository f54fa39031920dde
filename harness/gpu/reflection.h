// What a SPIR-V module says of its bindings and of the floats that it may write.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <string>
#include <vector>

namespace vsglbench {

// Descriptor types of set 0, in binding order, as the SPIR-V declares them. Throws Error(plugin) for
// another set, a gap, or a resource that is neither a storage buffer, uniform buffer nor sampled image.
std::vector<VkDescriptorType> reflect_bindings(const std::vector<uint32_t>& spirv, const std::string& name);

// Bytes of the push-constant block, from 0 to the end of its last member; 0 without one.
uint32_t reflect_push_bytes(const std::vector<uint32_t>& spirv);

// A 32-bit float within an element: "power", "mean.x", "x"; "" where the element is one.
struct FloatField {
  std::string name;
  uint32_t offset = 0;  // bytes
};

// The floats of one member of a storage block, which is an array or else counts as one of one element.
struct FloatArray {
  uint32_t binding = 0;
  std::string name;                            // the member's
  uint32_t offset = 0, stride = 0, count = 0;  // bytes, bytes, elements; count 0: to the end of the buffer
  std::vector<FloatField> fields;
};

struct FloatOutputs {
  std::vector<FloatArray> arrays;
  // The code holds a constant that is infinite: to the kernel an Inf is a value like others.
  bool uses_infinity = false;
};

// All 32-bit floats of the storage blocks of set 0 that are not `readonly`; other types of an element are
// left out, so a block without floats is not listed.
FloatOutputs reflect_float_outputs(const std::vector<uint32_t>& spirv);

}  // namespace vsglbench
