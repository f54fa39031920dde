// One VSGL from each of 2048 clusters of sorted texels: of one size, and with one that holds half or nine
// tenths of the texels.
#include <fmt/format.h>

#include <cmath>

#include "measure/blocks.h"
#include "method/cluster_sum.h"
#include "method/made_half.h"

namespace vsglbench {
namespace {

constexpr uint32_t kClusters = 2048;  // lights on the G-buffer [MFIS16 §5]

class SumBlock : public Block {
 public:
  explicit SumBlock(Device& device) : on_(device) {}
  std::string name() const override { return "sum"; }
  std::string counted() const override { return "texels"; }
  std::vector<std::string> inputs() const override { return {"even", "one holds half", "one holds 90 %"}; }
  std::vector<uint64_t> sizes() const override { return {1 << 16, 262144, 1 << 20, 2088960}; }

  std::vector<Contestant> prepare(const std::string& input, uint64_t size) override {
    if (half_.texels.size() != size) {
      const auto [width, height] = image_size(size);
      half_ = smooth_half(width, height);
      on_device_ = std::make_unique<DeviceHalf>(on_.device, half_);
    }
    make_clusters(input == "even" ? 0 : input == "one holds half" ? 0.5 : 0.9, static_cast<uint32_t>(size));
    lights_ = Buffer(on_.device, "lights", kClusters * sizeof(gpu::Vsgl));
    std::vector<Contestant> all;
    all.push_back({"host, 2 threads", false, [this] { return sum_on_host(); }, [] { return ""; }});
    using Variant = ClusterSumVariant;
    for (const Variant v : {Variant::per_cluster, Variant::segmented}) {
      const char* variant = v == Variant::per_cluster ? "one thread a cluster" : "segmented";
      all.push_back({variant, true, [this, v] { return sum_on_device(v); }, [this] { return mistake(); }});
    }
    return all;
  }

 private:
  // Sorted by cluster; a cluster's texels are neighbours in a row, as those of an image mostly are. The first
  // cluster holds `share` of them, the others the same each.
  void make_clusters(double share, uint32_t size) {
    ids_.resize(size);
    std::vector<uint32_t> texels(size);
    const auto large = static_cast<uint64_t>(share * size);
    for (uint32_t i = 0; i < size; ++i) {
      texels[i] = i;
      if (share == 0) {
        ids_[i] = static_cast<uint32_t>(uint64_t{i} * kClusters / size);
      } else {
        ids_[i] = i < large ? 0 : static_cast<uint32_t>(1 + (i - large) * (kClusters - 1) / (size - large));
      }
    }
    id_buffer_ = Buffer(on_.device, "ids", size * 4);
    id_buffer_.upload(std::span<const uint32_t>(ids_));
    texel_buffer_ = Buffer(on_.device, "texels", size * 4);
    texel_buffer_.upload(std::span<const uint32_t>(texels));
  }

  double sum_on_device(ClusterSumVariant variant) {
    ClusterSum sum(on_.context, variant);
    const double ms = device_ms(on_.recorder, [&] {
      sum.record(on_.recorder, on_device_->field(Half::gbuffer),
                 {&id_buffer_, &texel_buffer_, static_cast<uint32_t>(ids_.size())},
                 {&lights_, kClusters, glm::uvec2(0)});
    });
    result_ = lights_.download<gpu::Vsgl>(kClusters);
    return ms;
  }

  // In double precision, half of the texels a thread; the cluster at the seam is joined after.
  double sum_on_host() {
    std::vector<oracle::Sums> sums[2];
    const double ms = two_threads_ms([&](int part) {
      sums[part].assign(kClusters, {});
      const uint32_t width = half_.emitter.width;
      const size_t from = part * ids_.size() / 2, to = (part + 1) * ids_.size() / 2;
      for (size_t i = from; i < to; ++i) {
        const auto texel = static_cast<uint32_t>(i);
        sums[part][ids_[i]].add(oracle::texel_sums(half_, texel % width, texel / width), 1);
      }
    });
    for (size_t c = 0; c < kClusters; ++c) sums[0][c].add(sums[1][c], 1);
    expected_ = std::move(sums[0]);
    return ms;
  }

  std::string mistake() const {
    for (size_t c = 0; c < kClusters; ++c) {
      const oracle::Vsgl e = oracle::make_vsgl(expected_[c], 1);
      const double power = std::abs(result_[c].power - e.power) / std::max(e.power, 1e-30);
      const double variance = std::abs(result_[c].variance - e.variance) / std::max(e.variance, 1e-30);
      if (e.power > 0 ? !(power < 1e-4 && variance < 1e-3) : result_[c].power != 0) {
        return fmt::format("cluster {}: power {} and variance {}, in double precision {} and {}", c,
                           result_[c].power, result_[c].variance, e.power, e.variance);
      }
    }
    return "";
  }

  BlockDevice on_;
  oracle::Half half_;
  std::unique_ptr<DeviceHalf> on_device_;
  std::vector<uint32_t> ids_;
  Buffer id_buffer_, texel_buffer_, lights_;
  std::vector<oracle::Sums> expected_;
  std::vector<gpu::Vsgl> result_;
};

}  // namespace

std::unique_ptr<Block> make_sum_block(Device& device) { return std::make_unique<SumBlock>(device); }

}  // namespace vsglbench
