// What filtered importance sampling is made of: warping the PDF, and mipmapping the moments.
#include <fmt/format.h>

#include <cmath>

#include "measure/blocks.h"
#include "method/filtered_sampling.h"
#include "method/lattice.h"
#include "method/made_half.h"
#include "method/nearest_centre.h"

namespace vsglbench {
namespace {

class WarpBlock : public Block {
 public:
  explicit WarpBlock(Device& device)
      : on_(device), half_(random_half(512, 512, 3)), pyramid_(half_), on_device_(device, half_) {}
  std::string name() const override { return "warp"; }
  std::string counted() const override { return "lights"; }
  std::vector<std::string> inputs() const override { return {"PDF of 512²"}; }
  std::vector<uint64_t> sizes() const override { return {256, 1024, 4096, 16384, 65536}; }

  std::vector<Contestant> prepare(const std::string&, uint64_t size) override {
    count_ = static_cast<uint32_t>(size);
    centres_ = Buffer(on_.device, "centres", size * sizeof(glm::vec4));
    return {{"host, 2 threads", false, [this] { return warp_on_host(); }, [] { return ""; }},
            {"warp", true, [this] { return warp_on_device(); }, [this] { return mistake(); }}};
  }

 private:
  double warp_on_device() {
    CentreSampler sampler(on_.context, 2);
    const double ms = device_ms(on_.recorder, [&] {
      sampler.record(on_.recorder, on_device_.field(Half::rsm), glm::uvec2(0), centres_, count_);
    });
    result_ = centres_.download<glm::vec4>(count_);
    return ms;
  }

  double warp_on_host() {
    expected_.resize(count_);
    return two_threads_ms([&](int part) {
      for (uint32_t i = part * count_ / 2; i < (part + 1) * count_ / 2; ++i) {
        const glm::dvec2 u = unit_interval(lattice_point(i, count_, glm::uvec2(0)));
        expected_[i] = pyramid_.warp(u.x, u.y);
      }
    });
  }

  // In single precision half a per cent may fall on the other side of a comparison.
  std::string mistake() const {
    size_t different = 0;
    for (uint32_t i = 0; i < count_; ++i) different += glm::uvec2(result_[i]) != expected_[i];
    if (different <= 1 + count_ / 200) return "";
    return fmt::format("{} of {} lights on another texel than in double precision", different, count_);
  }

  BlockDevice on_;
  oracle::Half half_;
  oracle::Pyramid pyramid_;
  DeviceHalf on_device_;
  uint32_t count_ = 0;
  Buffer centres_;
  std::vector<glm::uvec2> expected_;
  std::vector<glm::vec4> result_;
};

class MipmapBlock : public Block {
 public:
  explicit MipmapBlock(Device& device) : on_(device) {}
  std::string name() const override { return "mipmap"; }
  std::string counted() const override { return "texels"; }
  std::vector<std::string> inputs() const override { return {"moments"}; }
  std::vector<uint64_t> sizes() const override { return {1 << 16, 262144, 1 << 20, 2088960}; }

  std::vector<Contestant> prepare(const std::string&, uint64_t size) override {
    const auto [width, height] = image_size(size);
    half_ = smooth_half(width, height);
    on_device_ = std::make_unique<DeviceHalf>(on_.device, half_);
    leaves_.resize(size);
    for (uint32_t i = 0; i < size; ++i) leaves_[i] = oracle::texel_sums(half_, i % width, i / width);
    return {{"host, 2 threads", false, [this] { return reduce_on_host(); }, [] { return ""; }},
            {"leaves and mipmap", true, [this] { return reduce_on_device(); }, [this] { return mistake(); }}};
  }

 private:
  double reduce_on_device() {
    MomentPyramid pyramid(on_.context);
    on_.recorder.begin();
    Steps steps(on_.recorder, Half::gbuffer);
    const auto moments = pyramid.build(steps, on_device_->field(Half::gbuffer));
    const SubmissionTimes times = on_.recorder.submit_and_wait();
    // Mean diffuse power of the whole half, from the last level.
    const uint32_t w = half_.emitter.width, h = half_.emitter.height;
    const auto power = moments.buffers[1]->download<glm::vec4>(pyramid_texels(w, h));
    top_ = glm::dvec3(power.back());
    // Leaves and level 1 are made by one kernel, so that the pyramid is both passes.
    double ms = 0;
    for (const PassTime& pass : times.passes) ms += pass.ms;
    return ms;
  }

  // The same pyramid of sums in double precision, half of each level's rows a thread.
  double reduce_on_host() {
    std::vector<oracle::Sums> level = leaves_;
    uint32_t w = half_.emitter.width, h = half_.emitter.height;
    double ms = 0;
    while (w > 1 || h > 1) {
      const uint32_t nw = (w + 1) / 2, nh = (h + 1) / 2;
      std::vector<oracle::Sums> next(size_t(nw) * nh);
      ms += two_threads_ms([&](int part) {
        for (uint32_t y = part * nh / 2; y < (part + 1) * nh / 2; ++y) {
          for (uint32_t x = 0; x < nw; ++x) {
            for (uint32_t k = 0; k < 4; ++k) {
              const uint32_t cx = 2 * x + k % 2, cy = 2 * y + k / 2;
              if (cx < w && cy < h) next[size_t(y) * nw + x].add(level[size_t(cy) * w + cx], 1);
            }
          }
        }
      });
      level = std::move(next);
      w = nw;
      h = nh;
    }
    expected_ = level.front().diffuse / static_cast<double>(leaves_.size());
    return ms;
  }

  std::string mistake() const {
    if (glm::length(top_ - expected_) <= 1e-5 * glm::length(expected_)) return "";
    return fmt::format("mean diffuse power {}, in double precision {}", top_.x, expected_.x);
  }

  BlockDevice on_;
  oracle::Half half_;
  std::unique_ptr<DeviceHalf> on_device_;
  std::vector<oracle::Sums> leaves_;
  glm::dvec3 top_{0}, expected_{0};
};

}  // namespace

std::unique_ptr<Block> make_warp_block(Device& device) { return std::make_unique<WarpBlock>(device); }
std::unique_ptr<Block> make_mipmap_block(Device& device) { return std::make_unique<MipmapBlock>(device); }

}  // namespace vsglbench
