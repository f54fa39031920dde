// Accessors (glTF 2.0, 3.6.2), with every range checked before it is read.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "scene/gltf_file.h"

namespace vsglbench {
namespace {

constexpr size_t kMostZeroElements = 1u << 24;  // of an accessor with no bytes behind it

size_t component_size(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

template <class T>
double load(const uint8_t* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return static_cast<double>(value);
}

double load_component(const uint8_t* at, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return normalized ? std::max(load<int8_t>(at) / 127.0, -1.0) : load<int8_t>(at);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load<uint8_t>(at) / (normalized ? 255.0 : 1.0);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return normalized ? std::max(load<int16_t>(at) / 32767.0, -1.0) : load<int16_t>(at);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<uint16_t>(at) / (normalized ? 65535.0 : 1.0);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return load<uint32_t>(at);
    default:
      return load<float>(at);
  }
}

// `count` elements of `size` bytes, `stride` apart, from `offset` of a view. Points at the first one.
const uint8_t* elements_of(const GltfFile& file, int view, size_t offset, size_t count, size_t size,
                           size_t stride, const std::string& what) {
  const ByteRange bytes = view_bytes(file, view, what);
  if (stride < size)
    throw file.error("{}: byteStride {} is less than an element's {} bytes", what, stride, size);
  const bool inside = count == 0 || (offset <= bytes.size && size <= bytes.size - offset &&
                                     count - 1 <= (bytes.size - offset - size) / stride);
  if (!inside) {
    throw file.error("{}: {} elements of {} bytes from byte {} leave buffer view {} of {} bytes", what, count,
                     size, offset, view, bytes.size);
  }
  return count == 0 ? bytes.data : bytes.data + offset;
}

// Overwrites the elements that the sparse part lists.
void apply_sparse(const GltfFile& file, const tinygltf::Accessor& accessor, int components,
                  const std::string& what, std::vector<double>* values) {
  const auto& sparse = accessor.sparse;
  const int type = sparse.indices.componentType;
  const size_t index_size = component_size(type), value_size = component_size(accessor.componentType);
  const bool unsigned_type = type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                             type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                             type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  if (!unsigned_type || sparse.count < 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0) {
    throw file.error("{}: malformed sparse accessor", what);
  }
  const size_t count = static_cast<size_t>(sparse.count), element_size = value_size * components;
  const uint8_t* indices =
      elements_of(file, sparse.indices.bufferView, static_cast<size_t>(sparse.indices.byteOffset), count,
                  index_size, index_size, what + " (sparse indices)");
  const uint8_t* replacements =
      elements_of(file, sparse.values.bufferView, static_cast<size_t>(sparse.values.byteOffset), count,
                  element_size, element_size, what + " (sparse values)");
  for (size_t i = 0; i < count; ++i) {
    const size_t target = static_cast<size_t>(load_component(indices + i * index_size, type, false));
    if (target >= accessor.count)
      throw file.error("{}: sparse index {} is past {}", what, target, accessor.count);
    for (int k = 0; k < components; ++k) {
      (*values)[target * components + k] = load_component(replacements + i * element_size + k * value_size,
                                                          accessor.componentType, accessor.normalized);
    }
  }
}

}  // namespace

ByteRange view_bytes(const GltfFile& file, int buffer_view, const std::string& what) {
  const auto& view = element(file, file.model.bufferViews, buffer_view, what + ": buffer view");
  const auto& buffer = element(file, file.model.buffers, view.buffer, what + ": buffer");
  if (view.byteOffset > buffer.data.size() || view.byteLength > buffer.data.size() - view.byteOffset) {
    throw file.error("{}: buffer view {} ({} bytes from {}) leaves its buffer of {} bytes", what, buffer_view,
                     view.byteLength, view.byteOffset, buffer.data.size());
  }
  return {buffer.data.data() + view.byteOffset, view.byteLength};
}

std::vector<double> read_accessor(const GltfFile& file, int index, int components, const std::string& what,
                                  Numbers numbers) {
  const auto& accessor = element(file, file.model.accessors, index, what + ": accessor");
  if (tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type)) != components) {
    throw file.error("{}: accessor {} does not have {} components", what, index, components);
  }
  const size_t size = component_size(accessor.componentType);
  if (size == 0) throw file.error("{}: component type {} is not allowed", what, accessor.componentType);

  std::vector<double> values;
  if (accessor.bufferView >= 0) {
    const size_t element_size = size * components;
    const auto& view = element(file, file.model.bufferViews, accessor.bufferView, what + ": buffer view");
    const size_t stride = view.byteStride > 0 ? view.byteStride : element_size;
    const uint8_t* at = elements_of(file, accessor.bufferView, accessor.byteOffset, accessor.count,
                                    element_size, stride, what);
    values.reserve(accessor.count * components);
    for (size_t i = 0; i < accessor.count; ++i) {
      for (int k = 0; k < components; ++k) {
        values.push_back(
            load_component(at + i * stride + k * size, accessor.componentType, accessor.normalized));
      }
    }
  } else {
    // No bytes: zeros, for the sparse part to fill.
    if (accessor.count > kMostZeroElements) {
      throw file.error("{}: accessor {} has {} elements but no buffer view", what, index, accessor.count);
    }
    values.assign(accessor.count * components, 0.0);
  }
  if (accessor.sparse.isSparse) apply_sparse(file, accessor, components, what, &values);
  for (size_t i = 0; numbers == Numbers::finite && i < values.size(); ++i) {
    if (!std::isfinite(values[i])) throw file.error("{}: element {} is not finite", what, i / components);
  }
  return values;
}

std::vector<uint32_t> read_indices(const GltfFile& file, int index, const std::string& what) {
  const auto& accessor = element(file, file.model.accessors, index, what + ": accessor");
  const int type = accessor.componentType;
  if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
      type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
    throw file.error("{}: component type {} is no unsigned integer", what, type);
  }
  std::vector<uint32_t> out;
  for (const double v : read_accessor(file, index, 1, what)) out.push_back(static_cast<uint32_t>(v));
  return out;
}

}  // namespace vsglbench
