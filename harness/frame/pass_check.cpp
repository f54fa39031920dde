#include "frame/pass_check.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/error.h"
#include "method/filtered_sampling.h"

namespace vsglbench {
namespace {

constexpr const char* kMapNames[] = {"position", "normal", "geometric normal", "diffuse", "f0"};

// Whole elements of the array within the first `bytes` of its buffer.
uint64_t element_count(const FloatArray& array, size_t bytes) {
  if (bytes <= array.offset) return 0;
  if (array.stride == 0) return 1;
  const uint64_t whole = (bytes - array.offset) / array.stride;
  return array.count == 0 ? whole : std::min<uint64_t>(whole, array.count);
}

// Calls visit(element, field, bits) for every float of the array, in their order.
template <class Visit>
void every_float(const FloatArray& array, size_t bytes, std::vector<uint32_t>& words, const Visit& visit) {
  const uint64_t count = element_count(array, bytes);
  for (uint64_t i = 0; i < count; ++i) {
    for (const FloatField& field : array.fields) {
      const uint64_t at = array.offset + i * array.stride + field.offset;
      if (at + sizeof(float) <= bytes) visit(i, field, words[at / sizeof(float)]);
    }
  }
}

bool is_nan(uint32_t bits) { return std::isnan(std::bit_cast<float>(bits)); }
bool is_finite(uint32_t bits) { return std::isfinite(std::bit_cast<float>(bits)); }
// What nobody wrote is no pass's output; MemoryWatch tells whether it should have been.
bool is_sound(uint32_t bits) { return is_finite(bits) || bits == unwritten_word; }

std::vector<uint32_t> words_of(const Buffer& buffer) {
  return buffer.download<uint32_t>(buffer.size() / sizeof(uint32_t));
}

template <class Act>
void every_array(const PassRecord::Use& use, const Act& act) {
  if (!use.kernel) return;
  for (const FloatArray& array : use.kernel->float_outputs().arrays) {
    if (array.binding == use.binding) act(array);
  }
}

// Counts elements with a NaN, or else an Inf, and keeps the first.
class Finding {
 public:
  explicit Finding(bool inf_is_bad) : inf_is_bad_(inf_is_bad) {}

  void take(uint64_t element, const std::string& field, uint32_t bits) {
    if (is_sound(bits) || (!inf_is_bad_ && !is_nan(bits))) return;
    if (bad.nan + bad.inf == 0) {
      bad.element = element;
      bad.field = field;
      bad.is_nan = is_nan(bits);
    }
    // A NaN among an element's numbers counts before an Inf.
    const bool same = last_ == element;
    if (!same) ++(is_nan(bits) ? bad.nan : bad.inf);
    if (same && !last_is_nan_ && is_nan(bits)) {
      ++bad.nan;
      --bad.inf;
    }
    last_is_nan_ = is_nan(bits) || (same && last_is_nan_);
    last_ = element;
  }

  BadOutput bad;

 private:
  bool inf_is_bad_, last_is_nan_ = false;
  std::optional<uint64_t> last_;  // element
};

}  // namespace

std::string BadOutput::message() const {
  std::string where = fmt::format("{} {}", is_light ? "light" : "element", element);
  if (!field.empty()) where += fmt::format(" ({})", field);
  if (texel) where += fmt::format(", texel ({}, {})", texel->x, texel->y);
  if (level) where += fmt::format(" of level {}", *level);
  return fmt::format("pass {} is the first to hold {}: buffer {}, {}", pass, is_nan ? "a NaN" : "an Inf",
                     buffer, where);
}

void PassCheck::restart() {
  bad_.reset();
  used_.clear();
}

void PassCheck::before(const PassRecord& pass) {
  for (const PassRecord::Use& use : pass.uses) {
    if (!used_.insert({use.buffer, use.buffer->handle(), use.buffer->size()}).second) continue;
    every_array(use, [&](const FloatArray& array) {
      auto words = words_of(*use.buffer);
      bool stale = false;
      every_float(array, use.buffer->size(), words, [&](uint64_t, const FloatField&, uint32_t& bits) {
        if (is_sound(bits)) return;
        bits = 0;
        stale = true;
      });
      if (stale) use.buffer->upload(std::span<const uint32_t>(words));
    });
  }
}

void PassCheck::after(const PassRecord& pass) {
  if (bad_) return;
  if (const DeferredTargets* targets = outputs_.targets(pass.pass)) check_targets(pass.pass, *targets);
  std::set<std::tuple<const Buffer*, const Kernel*, uint32_t>> checked;
  for (const PassRecord::Use& use : pass.uses) {
    if (!bad_ && checked.insert({use.buffer, use.kernel, use.binding}).second) check(pass.pass, use);
  }
}

void PassCheck::check_targets(const PassId& pass, const DeferredTargets& targets) {
  for (size_t map = 0; map < targets.maps.size(); ++map) {
    if (!targets.maps[map]) continue;
    std::vector<uint32_t> words(size_t(targets.width) * targets.height * 4);
    targets.maps[map].download(words.data(), words.size() * sizeof(uint32_t));
    Finding finding(true);
    for (size_t i = 0; i < words.size(); ++i) finding.take(i / 4, std::string(1, "xyzw"[i % 4]), words[i]);
    if (finding.bad.nan + finding.bad.inf == 0) continue;
    bad_ = finding.bad;
    bad_->pass = pass;
    bad_->buffer = fmt::format("{} {}", pass, kMapNames[map]);
    bad_->texel = glm::uvec2(bad_->element % targets.width, bad_->element / targets.width);
    return;
  }
}

void PassCheck::check(const PassId& pass, const PassRecord::Use& use) {
  every_array(use, [&](const FloatArray& array) {
    if (bad_) return;
    const FrameOutputs::NamedBuffer named = outputs_.buffer(pass, *use.buffer);
    auto words = words_of(*use.buffer);
    Finding finding(!use.kernel->float_outputs().uses_infinity);
    every_float(array, named.bytes, words, [&](uint64_t element, const FloatField& field, uint32_t bits) {
      finding.take(element, field.name, bits);
    });
    if (finding.bad.nan + finding.bad.inf == 0) return;
    bad_ = finding.bad;
    bad_->pass = pass;
    bad_->buffer = !named.name.empty() ? named.name : fmt::format("{} of {}", array.name, use.kernel->name());
    bad_->is_light = named.holds_lights;
    locate(pass, element_count(array, named.bytes));
  });
}

// The texel, where the number of elements tells that there is one for each.
void PassCheck::locate(const PassId& pass, uint64_t elements) {
  const auto [base, lights] = outputs_.half(pass);
  if (base.x == 0 || bad_->is_light || elements == lights) return;
  const bool pyramid = elements != uint64_t(base.x) * base.y;
  if (pyramid && elements != pyramid_texels(base.x, base.y)) return;
  uint64_t at = bad_->element;
  for (uint32_t level = 0;; ++level) {
    const uint64_t round = (uint64_t{1} << level) - 1;
    const uint64_t width = (base.x + round) >> level, height = (base.y + round) >> level;
    if (at < width * height) {
      bad_->texel = glm::uvec2(at % width, at / width);
      if (pyramid) bad_->level = level;
      return;
    }
    at -= width * height;
  }
}

}  // namespace vsglbench
