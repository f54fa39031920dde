#include "reference/tracer.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace vsglbench {
namespace {

int native_packet_width(RTCDevice device) {
  if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED)) return 16;
  if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED)) return 8;
  if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY4_SUPPORTED)) return 4;
  return 1;
}

}  // namespace

Tracer::Tracer(const Scene& scene, const std::string& device_config)
    : scene_(scene), least_extent_(scene.diagonal() / 8) {
  device_.reset(rtcNewDevice(device_config.c_str()));
  if (!device_) {
    throw fail(ErrorKind::scene, "{}: Embree gave no device (error {})", scene.name,
               static_cast<int>(rtcGetDeviceError(nullptr)));
  }
  native_width_ = native_packet_width(device_.get());
  still_ = std::make_unique<RayTree>(device_.get(), scene, RayTree::Part::still);
  if (!scene.animation.objects.empty()) {
    moving_ = std::make_unique<RayTree>(device_.get(), scene, RayTree::Part::moving);
  }
  check_embree("build");
}

Tracer::~Tracer() = default;

void Tracer::update(const Moved& moved) {
  if (!moving_) return;
  moving_->update(moved.objects);
  check_embree("refit");
}

void Tracer::check_embree(const char* what) const {
  if (const RTCError error = rtcGetDeviceError(device_.get()); error != RTC_ERROR_NONE) {
    throw fail(ErrorKind::scene, "{}: Embree can't {} its tree over {} triangles (error {})", scene_.name,
               what, scene_.triangles.size(), static_cast<int>(error));
  }
}

std::optional<Hit> Tracer::intersect(const glm::vec3& origin, const glm::vec3& direction, float start,
                                     float end) const {
  const std::optional<Hit> still = still_->intersect(origin, direction, start, end);
  if (!moving_) return still;
  const std::optional<Hit> moving =
      moving_->intersect(origin, direction, start, still ? still->distance : end);
  // What stands still wins a draw.
  return moving && !(still && still->distance <= moving->distance) ? moving : still;
}

bool Tracer::occluded(const glm::vec3& a, const glm::vec3& b) const {
  return still_->occluded(a, b) || (moving_ && moving_->occluded(a, b));
}

uint32_t Tracer::occluded(const SegmentPacket& packet) const {
  const uint32_t still = still_->occluded(packet, native_width_, 0);
  return moving_ ? still | moving_->occluded(packet, native_width_, still) : still;
}

float Tracer::epsilon(const glm::vec3& point) const {
  const float extent =
      std::max(std::max(std::abs(point.x), std::abs(point.y)), std::max(std::abs(point.z), least_extent_));
  return extent * 0x1p-16f;
}

glm::vec3 Tracer::offset(const glm::vec3& point, const glm::vec3& normal) const {
  return point + epsilon(point) * normal;
}

}  // namespace vsglbench
