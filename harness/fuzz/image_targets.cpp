#include <algorithm>
#include <stdexcept>

#include "fuzz/input.h"
#include "fuzz/targets.h"
#include "image/exr.h"
#include "reference/cache.h"

namespace vsglbench::fuzz {
namespace {

void check_sizes(const ExrLayers& layers) {
  const size_t count = size_t{layers.width} * layers.height;
  const auto fits = [&](const auto& layer) { return layer.second.pixels.size() == count; };
  const auto scalar_fits = [&](const auto& layer) { return layer.second.size() == count; };
  if (!std::ranges::all_of(layers.colors, fits) || !std::ranges::all_of(layers.scalars, scalar_fits))
    throw std::logic_error("read_exr_layers made layers of different sizes");
}

}  // namespace

bool read_exr(Bytes bytes) {
  const auto path = write_input("input.exr", bytes);
  ExrLayers layers;
  if (!accepts([&] { layers = read_exr_layers(path); })) return false;
  check_sizes(layers);
  return true;
}

std::string pack_reference(std::string_view json, std::string_view exr) {
  std::string out{static_cast<char>(json.size() & 0xff), static_cast<char>(json.size() >> 8)};
  return out.append(json).append(exr);
}

bool read_reference_cache(Bytes bytes) {
  if (bytes.size() < 2) return false;
  const size_t length = std::min<size_t>(bytes[0] | bytes[1] << 8, bytes.size() - 2);
  const std::string name = std::string("references/") + kReferenceHash;
  write_input(name + ".json", bytes.subspan(2, length));
  write_input(name + ".exr", bytes.subspan(2 + length));
  ReferenceParameters parameters;
  parameters.width = kReferenceWidth;
  parameters.height = kReferenceHeight;
  const auto reference = cached_reference(kReferenceHash, parameters);
  if (reference && reference->mean.pixels.size() != size_t{kReferenceWidth} * kReferenceHeight)
    throw std::logic_error("cached_reference accepted an image of another size");
  return reference.has_value();
}

}  // namespace vsglbench::fuzz
