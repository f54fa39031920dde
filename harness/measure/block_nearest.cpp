// The nearest of 2048 centres to every texel, in the image and in the world, against FLANN.
#include <fmt/format.h>

#include <cmath>
#include <flann/flann.hpp>
#include <random>

#include "measure/blocks.h"
#include "measure/stopwatch.h"
#include "method/nearest_centre.h"

namespace vsglbench {
namespace {

constexpr uint32_t kCentres = 2048;  // lights on the G-buffer [MFIS16 §5]

// What a camera sees in a hall 20 × 6 × 30 m with two rows of round columns: surfaces with steps in depth.
class Hall {
 public:
  static glm::vec3 seen(float u, float v) {
    const glm::vec3 eye(0, 1.7f, 0.5f),
        d = glm::normalize(glm::vec3(1.4f * (u - 0.5f), 0.8f * (0.5f - v), 1));
    float t = 1e30f;
    for (int k = 0; k < 3; ++k) {
      const glm::vec3 lo(-10, 0, 0), hi(10, 6, 30);
      if (d[k] != 0) t = std::min(t, ((d[k] > 0 ? hi[k] : lo[k]) - eye[k]) / d[k]);
    }
    for (int row = 1; row <= 5; ++row) {
      for (const float side : {-4.0f, 4.0f})
        t = std::min(t, column(eye, d, side, 5.0f * static_cast<float>(row)));
    }
    return eye + t * d;
  }

 private:
  static float column(const glm::vec3& eye, const glm::vec3& d, float x, float z) {
    const glm::vec2 o(eye.x - x, eye.z - z), e(d.x, d.z);
    const float a = glm::dot(e, e), b = glm::dot(o, e), c = glm::dot(o, o) - 0.36f, root = b * b - a * c;
    const float t = root > 0 ? (-b - std::sqrt(root)) / a : 0;
    return t > 0 ? t : 1e30f;
  }
};

class NearestBlock : public Block {
 public:
  explicit NearestBlock(Device& device) : on_(device) {}
  std::string name() const override { return "nearest"; }
  std::string counted() const override { return "texels"; }
  std::vector<std::string> inputs() const override {
    return {"2-D, even", "2-D, crowded", "3-D, even", "3-D, crowded"};
  }
  std::vector<uint64_t> sizes() const override { return {1 << 16, 262144, 1 << 20, 2088960}; }

  std::vector<Contestant> prepare(const std::string& input, uint64_t size) override {
    dimensions_ = input.starts_with("2") ? 2 : 3;
    const auto [width, height] = image_size(size);
    place_texels(width, height);
    draw_centres(input.ends_with("crowded"));
    field_.emitter.width = width;
    field_.emitter.height = height;
    field_.maps.position = &map_;
    ids_ = Buffer(on_.device, "ids", size * 4);
    std::vector<Contestant> all;
    using Search = NearestCentre::Search;
    for (const Search s : {Search::kd_tree, Search::tiles}) {
      const char* search = s == Search::kd_tree ? "kd-tree" : "tiles";
      all.push_back({search, true, [this, s] { return search_on_device(s); }, [this] { return mistake(); }});
    }
    // First, since the others are compared with it.
    all.insert(all.begin(),
               {"FLANN, 2 threads", false, [this] { return search_by_flann(); }, [] { return ""; }});
    return all;
  }

 private:
  void place_texels(uint32_t width, uint32_t height) {
    std::vector<glm::vec4> world(size_t(width) * height);
    queries_.resize(world.size());
    for (uint32_t y = 0; y < height; ++y) {
      for (uint32_t x = 0; x < width; ++x) {
        const glm::vec2 at(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
        const size_t i = size_t(y) * width + x;
        world[i] = {Hall::seen(at.x / static_cast<float>(width), at.y / static_cast<float>(height)), 1};
        queries_[i] = dimensions_ == 2 ? glm::vec3(at, 0) : glm::vec3(world[i]);
      }
    }
    map_ = DeviceImage(on_.device, "position", VK_FORMAT_R32G32B32A32_SFLOAT, width, height,
                       VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
    map_.upload(world.data(), world.size() * sizeof(glm::vec4));
    width_ = width;
  }

  // At texels: all alike, or nine of ten in a twentieth of the image.
  void draw_centres(bool crowded) {
    std::mt19937 random(11);
    const auto height = static_cast<uint32_t>(queries_.size() / width_);
    const auto in_part = [&](uint32_t extent, double part) {
      return static_cast<uint32_t>(random() % std::max(1u, static_cast<uint32_t>(extent * part)));
    };
    std::vector<glm::vec4> centres;
    for (uint32_t i = 0; i < kCentres; ++i) {
      const double part = crowded && i % 10 != 0 ? std::sqrt(0.05) : 1;
      const uint32_t x = in_part(width_, part), y = in_part(height, part);
      centres.emplace_back(queries_[size_t(y) * width_ + x], 1);
    }
    centres_ = Buffer(on_.device, "centres", centres.size() * sizeof(glm::vec4));
    centres_.upload(std::span<const glm::vec4>(centres));
    host_centres_ = std::move(centres);
  }

  double search_on_device(NearestCentre::Search search) {
    NearestCentre nearest(on_.context, dimensions_, search);
    const double ms =
        device_ms(on_.recorder, [&] { nearest.record(on_.recorder, field_, centres_, kCentres, ids_); });
    result_ = ids_.download<uint32_t>(queries_.size());
    return ms;
  }

  // Index and search, as the device builds its tree in its own time; exact, half of the texels a thread.
  double search_by_flann() {
    const auto columns = static_cast<size_t>(dimensions_);
    std::vector<float> points, queries;
    for (const auto& c : host_centres_) points.insert(points.end(), &c.x, &c.x + columns);
    for (const auto& q : queries_) queries.insert(queries.end(), &q.x, &q.x + columns);
    std::vector<int> found(queries_.size());
    distances_.resize(queries_.size());
    const Stopwatch watch;
    flann::Index<flann::L2_Simple<float>> index({points.data(), kCentres, columns},
                                                flann::KDTreeSingleIndexParams(10));
    index.buildIndex();
    two_threads_ms([&](int part) {
      const size_t from = part * found.size() / 2, to = (part + 1) * found.size() / 2;
      const flann::Matrix<float> some(&queries[from * columns], to - from, columns);
      flann::Matrix<int> indices(&found[from], to - from, 1);
      flann::Matrix<float> distances(&distances_[from], to - from, 1);
      index.knnSearch(some, indices, distances, 1, flann::SearchParams(flann::FLANN_CHECKS_UNLIMITED));
    });
    return watch.milliseconds();
  }

  // As near as FLANN's answer; which of equally near centres is open.
  std::string mistake() const {
    for (size_t i = 0; i < queries_.size(); ++i) {
      if (result_[i] >= kCentres) return fmt::format("texel {} has centre {} of {}", i, result_[i], kCentres);
      const glm::vec3 d = queries_[i] - glm::vec3(host_centres_[result_[i]]);
      const float distance = glm::dot(d, d);
      if (distance > distances_[i] * (1 + 1e-5f) + 1e-9f) {
        return fmt::format("texel {}: squared distance {}, FLANN's {}", i, distance, distances_[i]);
      }
    }
    return "";
  }

  BlockDevice on_;
  int dimensions_ = 2;
  uint32_t width_ = 0;
  Field field_;
  DeviceImage map_;
  Buffer centres_, ids_;
  std::vector<glm::vec4> host_centres_;
  std::vector<glm::vec3> queries_;
  std::vector<float> distances_;
  std::vector<uint32_t> result_;
};

}  // namespace

std::unique_ptr<Block> make_nearest_block(Device& device) { return std::make_unique<NearestBlock>(device); }

}  // namespace vsglbench
