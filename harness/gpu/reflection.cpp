#include "gpu/reflection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <set>
#include <span>
#include <spirv/unified1/spirv.hpp11>
#include <utility>

#include "base/error.h"
#include "gpu/loop_check.h"

namespace vsglbench {
namespace {

using spv::Decoration;
using spv::Op;
using spv::StorageClass;
using Words = std::span<const uint32_t>;       // of one instruction, its opcode first
using Member = std::pair<uint32_t, uint32_t>;  // struct type, index

Op opcode_of(Words instruction) { return static_cast<Op>(instruction[0] & spv::OpCodeMask); }
Decoration decoration_of(uint32_t word) { return static_cast<Decoration>(word); }

struct Variable {
  uint32_t pointer_type;
  StorageClass storage;
};

struct Reflected {
  std::map<uint32_t, uint32_t> binding, set;         // variable → decoration
  std::map<uint32_t, uint32_t> array_stride;         // array type → bytes
  std::map<Member, uint32_t> offset, matrix_stride;  // bytes
  std::map<Member, std::string> member_name;
  std::set<Member> row_major, read_only_member;
  std::set<uint32_t> read_only;            // variables
  std::map<uint32_t, Words> types;         // result id → instruction
  std::map<uint32_t, uint32_t> constants;  // of one word: result id → value
  std::map<uint32_t, Variable> variables;
  bool infinite_constant = false;

  // The length of an array type that has one; 0 where a specialisation constant sets it.
  uint32_t length(uint32_t array) const {
    const auto known = constants.find(types.at(array)[3]);
    return known == constants.end() ? 0 : known->second;
  }
  Op opcode(uint32_t type) const { return types.count(type) ? opcode_of(types.at(type)) : Op::OpNop; }
};

bool is_infinite(uint32_t bits) { return (bits & 0x7fffffffu) == 0x7f800000u; }

void take_decoration(Words w, Reflected& r) {
  const Decoration decoration = decoration_of(w[2]);
  if (decoration == Decoration::NonWritable) r.read_only.insert(w[1]);
  if (w.size() < 4) return;
  if (decoration == Decoration::Binding) r.binding[w[1]] = w[3];
  if (decoration == Decoration::DescriptorSet) r.set[w[1]] = w[3];
  if (decoration == Decoration::ArrayStride) r.array_stride[w[1]] = w[3];
}

void take_member_decoration(Words w, Reflected& r) {
  const Member member{w[1], w[2]};
  const Decoration decoration = decoration_of(w[3]);
  if (decoration == Decoration::NonWritable) r.read_only_member.insert(member);
  if (decoration == Decoration::RowMajor) r.row_major.insert(member);
  if (w.size() < 5) return;
  if (decoration == Decoration::Offset) r.offset[member] = w[4];
  if (decoration == Decoration::MatrixStride) r.matrix_stride[member] = w[4];
}

void take(Words w, Reflected& r) {
  const Op opcode = opcode_of(w);
  if (opcode >= Op::OpTypeInt && opcode <= Op::OpTypePointer && w.size() >= 2) r.types[w[1]] = w;
  if (opcode == Op::OpDecorate && w.size() >= 3) take_decoration(w, r);
  if (opcode == Op::OpMemberDecorate && w.size() >= 4) take_member_decoration(w, r);
  if (opcode == Op::OpMemberName && w.size() >= 4) {
    const auto* text = reinterpret_cast<const char*>(&w[3]);
    r.member_name[{w[1], w[2]}] = std::string(text, strnlen(text, 4 * (w.size() - 3)));
  }
  if (opcode == Op::OpConstant && w.size() == 4) {
    r.constants[w[2]] = w[3];
    r.infinite_constant |= r.opcode(w[1]) == Op::OpTypeFloat && is_infinite(w[3]);
  }
  if (opcode == Op::OpBitcast && w.size() == 4 && r.constants.count(w[3])) {
    r.infinite_constant |= r.opcode(w[1]) == Op::OpTypeFloat && is_infinite(r.constants.at(w[3]));
  }
  if (opcode == Op::OpVariable && w.size() >= 4) r.variables[w[2]] = {w[1], static_cast<StorageClass>(w[3])};
}

Reflected scan(const std::vector<uint32_t>& spirv) {
  Reflected r;
  for (size_t i = 5; i < spirv.size();) {
    const uint32_t words = spirv[i] >> spv::WordCountShift;
    if (words == 0 || i + words > spirv.size()) break;
    take(Words(&spirv[i], words), r);
    i += words;
  }
  return r;
}

// Finds the floats of an element, however deep.
class FloatFinder {
 public:
  explicit FloatFinder(const Reflected& reflected) : r_(reflected) {}

  // `owner`: the member of a struct that the value is, or is part of, which says how matrices lie.
  void find(uint32_t type, Member owner, const std::string& name, uint32_t offset) {
    const Words w = r_.types.count(type) ? r_.types.at(type) : Words();
    switch (r_.opcode(type)) {
      case Op::OpTypeFloat:
        if (w[2] == 32) fields.push_back({name, offset});
        break;
      case Op::OpTypeVector:
        for (uint32_t i = 0; i < w[3]; ++i)
          find(w[2], owner, within(name, std::string(1, "xyzw"[i % 4])), offset + 4 * i);
        break;
      case Op::OpTypeMatrix:
        find_matrix(w, owner, name, offset);
        break;
      case Op::OpTypeArray:
        for (uint32_t i = 0; i < r_.length(type); ++i)
          find(w[2], owner, fmt::format("{}[{}]", name, i), offset + i * r_.array_stride.at(type));
        break;
      case Op::OpTypeStruct:
        for (uint32_t i = 0; i + 2 < w.size(); ++i) {
          const Member member{type, i};
          find(w[i + 2], member, within(name, name_of(member)), offset + r_.offset.at(member));
        }
        break;
      default:;
    }
  }
  std::string name_of(Member member) const {
    return r_.member_name.count(member) ? r_.member_name.at(member) : fmt::format("member{}", member.second);
  }

  std::vector<FloatField> fields;

 private:
  static std::string within(const std::string& outer, const std::string& inner) {
    return outer.empty() ? inner : outer + "." + inner;
  }
  void find_matrix(Words w, Member owner, const std::string& name, uint32_t offset) {
    const uint32_t columns = w[3], rows = r_.types.at(w[2])[3], scalar = r_.types.at(w[2])[2];
    const uint32_t stride = r_.matrix_stride.at(owner);
    const bool row_major = r_.row_major.count(owner) > 0;
    for (uint32_t c = 0; c < columns; ++c) {
      for (uint32_t row = 0; row < rows; ++row) {
        const uint32_t at = row_major ? row * stride + 4 * c : c * stride + 4 * row;
        find(scalar, owner, fmt::format("{}[{}][{}]", name, c, row), offset + at);
      }
    }
  }
  const Reflected& r_;
};

// Bytes from the start of a value to the end of its last part. `owner` as in FloatFinder::find().
uint32_t bytes_of(const Reflected& r, uint32_t type, Member owner) {
  const Words w = r.types.at(type);
  switch (r.opcode(type)) {
    case Op::OpTypeInt:
    case Op::OpTypeFloat:
      return w[2] / 8;
    case Op::OpTypeVector:
      return w[3] * bytes_of(r, w[2], owner);
    case Op::OpTypeMatrix: {
      const uint32_t columns = w[3], rows = r.types.at(w[2])[3],
                     scalar = bytes_of(r, r.types.at(w[2])[2], owner);
      const bool row_major = r.row_major.count(owner) > 0;
      return ((row_major ? rows : columns) - 1) * r.matrix_stride.at(owner) +
             (row_major ? columns : rows) * scalar;
    }
    case Op::OpTypeArray:
      return r.length(type) == 0 ? 0
                                 : (r.length(type) - 1) * r.array_stride.at(type) + bytes_of(r, w[2], owner);
    case Op::OpTypeStruct: {
      uint32_t end = 0;
      for (uint32_t i = 0; i + 2 < w.size(); ++i)
        end = std::max(end, r.offset.at({type, i}) + bytes_of(r, w[i + 2], {type, i}));
      return end;
    }
    default:
      return 0;
  }
}

// One member of a block.
FloatArray float_array(const Reflected& r, Member member, uint32_t type) {
  FloatFinder finder(r);
  FloatArray array;
  array.name = finder.name_of(member);
  array.offset = r.offset.at(member);
  array.count = 1;
  uint32_t element = type;
  const Op opcode = r.opcode(type);
  if (opcode == Op::OpTypeArray || opcode == Op::OpTypeRuntimeArray) {
    element = r.types.at(type)[2];
    array.stride = r.array_stride.at(type);
    array.count = opcode == Op::OpTypeArray ? r.length(type) : 0;
  }
  finder.find(element, member, "", 0);
  array.fields = std::move(finder.fields);
  return array;
}

}  // namespace

std::vector<VkDescriptorType> reflect_bindings(const std::vector<uint32_t>& spirv, const std::string& name) {
  const Reflected r = scan(spirv);
  std::map<uint32_t, VkDescriptorType> found;
  for (const auto& [id, binding] : r.binding) {
    if (r.set.count(id) && r.set.at(id) == LoopCheck::kSet && binding == LoopCheck::kBinding) continue;
    if (r.set.count(id) && r.set.at(id) != 0) {
      throw fail(ErrorKind::plugin, "{}: binding {} is in set {}; use set 0", name, binding, r.set.at(id));
    }
    const auto [pointer, storage] = r.variables.at(id);
    const bool sampled = r.opcode(r.types.at(pointer)[3]) == Op::OpTypeSampledImage;
    if (storage == StorageClass::StorageBuffer) {
      found[binding] = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    } else if (storage == StorageClass::Uniform) {
      found[binding] = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    } else if (storage == StorageClass::UniformConstant && sampled) {
      found[binding] = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
    } else {
      throw fail(ErrorKind::plugin, "{}: binding {} is neither a buffer nor a sampler", name, binding);
    }
  }
  std::vector<VkDescriptorType> types;
  for (const auto& [binding, type] : found) {
    if (binding != types.size())
      throw fail(ErrorKind::plugin, "{}: binding {} is missing", name, types.size());
    types.push_back(type);
  }
  return types;
}

uint32_t reflect_push_bytes(const std::vector<uint32_t>& spirv) {
  const Reflected r = scan(spirv);
  for (const auto& [id, variable] : r.variables) {
    if (variable.storage == StorageClass::PushConstant)
      return bytes_of(r, r.types.at(variable.pointer_type)[3], {});
  }
  return 0;
}

FloatOutputs reflect_float_outputs(const std::vector<uint32_t>& spirv) {
  const Reflected r = scan(spirv);
  FloatOutputs outputs{.uses_infinity = r.infinite_constant};
  for (const auto& [id, binding] : r.binding) {
    const auto [pointer, storage] = r.variables.at(id);
    const uint32_t block = r.types.at(pointer)[3];
    if (storage != StorageClass::StorageBuffer || r.read_only.count(id) ||
        r.opcode(block) != Op::OpTypeStruct)
      continue;
    const Words members = r.types.at(block).subspan(2);
    for (uint32_t i = 0; i < members.size(); ++i) {
      if (r.read_only_member.count({block, i})) continue;
      FloatArray array = float_array(r, {block, i}, members[i]);
      array.binding = binding;
      if (!array.fields.empty()) outputs.arrays.push_back(std::move(array));
    }
  }
  return outputs;
}

}  // namespace vsglbench
