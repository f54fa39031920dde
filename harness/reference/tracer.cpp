#include "reference/tracer.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "scene/surface.h"

namespace vsglbench {

// Triangles of one Embree geometry and their indices in the scene.
struct Tracer::Group {
  const Scene* scene = nullptr;
  bool alpha_tested = false;
  std::vector<uint32_t> triangles;

  // Embree's filter: a hit on a hole is no hit.
  static void drop_holes(const RTCFilterFunctionNArguments* args) {
    const auto& group = *static_cast<const Group*>(args->geometryUserPtr);
    for (unsigned i = 0; i < args->N; ++i) {
      if (args->valid[i] == 0) continue;
      const uint32_t triangle = group.triangles[RTCHitN_primID(args->hit, args->N, i)];
      const glm::vec2 barycentric(RTCHitN_u(args->hit, args->N, i), RTCHitN_v(args->hit, args->N, i));
      if (is_hole(*group.scene, triangle, barycentric)) args->valid[i] = 0;
    }
  }
};

namespace {

bool alpha_tested(const Scene& scene, uint32_t triangle) {
  return scene.materials[scene.triangle_material[triangle]].alpha_cutoff >= 0;
}

RTCRay make_ray(const glm::vec3& origin, const glm::vec3& direction, float start, float end) {
  RTCRay ray;
  ray.org_x = origin.x, ray.org_y = origin.y, ray.org_z = origin.z;
  ray.dir_x = direction.x, ray.dir_y = direction.y, ray.dir_z = direction.z;
  ray.tnear = start, ray.tfar = end, ray.time = 0;
  ray.mask = ~0u, ray.id = 0, ray.flags = 0;
  return ray;
}

// Copies lanes [first, first + N) of a packet into Embree's own N-wide ray.
template <int N, class RayN>
void load_lanes(const SegmentPacket& packet, int first, RayN* ray, int* valid) {
  for (int i = 0; i < N; ++i) {
    const int lane = first + i;
    ray->org_x[i] = packet.origin[0][lane];
    ray->org_y[i] = packet.origin[1][lane];
    ray->org_z[i] = packet.origin[2][lane];
    ray->dir_x[i] = packet.direction[0][lane];
    ray->dir_y[i] = packet.direction[1][lane];
    ray->dir_z[i] = packet.direction[2][lane];
    ray->tnear[i] = 0;
    ray->tfar[i] = packet.end[lane];
    ray->time[i] = 0;
    ray->mask[i] = ~0u;
    ray->id[i] = 0;
    ray->flags[i] = 0;
    valid[i] = packet.end[lane] >= 0 ? -1 : 0;
  }
}

// Traces a packet N lanes at a time. Embree marks a blocked lane by tfar = -inf.
template <int N, class RayN, class Occluded>
uint32_t trace_lanes(const SegmentPacket& packet, Occluded occluded) {
  uint32_t blocked = 0;
  for (int first = 0; first < SegmentPacket::width; first += N) {
    RayN ray;
    alignas(64) int valid[N];
    load_lanes<N>(packet, first, &ray, valid);
    occluded(valid, &ray);
    for (int i = 0; i < N; ++i) blocked |= uint32_t(valid[i] != 0 && ray.tfar[i] < 0) << (first + i);
  }
  return blocked;
}

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
  rtc_.reset(rtcNewScene(device_.get()));
  rtcSetSceneFlags(handle(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(handle(), RTC_BUILD_QUALITY_HIGH);

  // Only alpha-tested triangles pay for the filter: they are a geometry of their own.
  for (int i = 0; i < 2; ++i) {
    groups_[i] = std::make_unique<Group>();
    groups_[i]->scene = &scene;
    groups_[i]->alpha_tested = i == 1;
  }
  for (uint32_t t = 0; t < scene.triangles.size(); ++t)
    groups_[alpha_tested(scene, t)]->triangles.push_back(t);
  all_opaque_ = groups_[1]->triangles.empty();
  for (auto& group : groups_) attach(*group);
  rtcCommitScene(handle());
  if (const RTCError error = rtcGetDeviceError(device_.get()); error != RTC_ERROR_NONE) {
    throw fail(ErrorKind::scene, "{}: Embree can't build its tree over {} triangles (error {})", scene.name,
               scene.triangles.size(), static_cast<int>(error));
  }
}

Tracer::~Tracer() = default;

void Tracer::attach(Group& group) {
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  const unsigned id = group.alpha_tested;
  if (!group.triangles.empty()) {
    // Embree's own buffers: a shared float3 buffer must be padded, which Scene::positions is not.
    auto* vertices = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), scene_.positions.size()));
    auto* indices = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), group.triangles.size()));
    if (vertices && indices) {
      std::copy(scene_.positions.begin(), scene_.positions.end(), vertices);
      for (size_t i = 0; i < group.triangles.size(); ++i) indices[i] = scene_.triangles[group.triangles[i]];
    }
    if (group.alpha_tested) {
      rtcSetGeometryUserData(geometry, &group);
      rtcSetGeometryIntersectFilterFunction(geometry, Group::drop_holes);
      rtcSetGeometryOccludedFilterFunction(geometry, Group::drop_holes);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(handle(), geometry, id);
  }
  rtcReleaseGeometry(geometry);
}

std::optional<Hit> Tracer::intersect(const glm::vec3& origin, const glm::vec3& direction, float start,
                                     float end) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit r;
  r.ray = make_ray(origin, direction, start, end);
  r.hit.geomID = r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(handle(), &context, &r);
  if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const uint32_t triangle = all_opaque_ ? r.hit.primID : groups_[r.hit.geomID]->triangles[r.hit.primID];
  return Hit{r.ray.tfar, triangle, glm::vec2(r.hit.u, r.hit.v),
             glm::vec3(r.hit.Ng_x, r.hit.Ng_y, r.hit.Ng_z)};
}

bool Tracer::occluded(const glm::vec3& a, const glm::vec3& b) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = make_ray(a, b - a, 0, 1);
  rtcOccluded1(handle(), &context, &ray);
  return ray.tfar < 0;
}

uint32_t Tracer::occluded(const SegmentPacket& packet) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  switch (native_width_) {
    case 16:
      return trace_lanes<16, RTCRay16>(
          packet, [&](const int* valid, RTCRay16* ray) { rtcOccluded16(valid, handle(), &context, ray); });
    case 8:
      return trace_lanes<8, RTCRay8>(
          packet, [&](const int* valid, RTCRay8* ray) { rtcOccluded8(valid, handle(), &context, ray); });
    default:
      return trace_lanes<4, RTCRay4>(
          packet, [&](const int* valid, RTCRay4* ray) { rtcOccluded4(valid, handle(), &context, ray); });
  }
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
