#include "reference/ray_tree.h"

#include <algorithm>
#include <numeric>

#include "scene/animation.h"
#include "scene/surface.h"

namespace vsglbench {

// Its triangles' indices in the scene, and the scene's vertices that they use.
struct RayTree::Group {
  const Scene* scene = nullptr;
  bool alpha_tested = false;
  std::vector<uint32_t> triangles;
  uint32_t first_vertex = 0, vertex_count = 0;

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
void load_lanes(const SegmentPacket& packet, uint32_t skip, int first, RayN* ray, int* valid) {
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
    valid[i] = packet.end[lane] >= 0 && (skip >> lane & 1) == 0 ? -1 : 0;
  }
}

// Traces a packet N lanes at a time. Embree marks a blocked lane by tfar = -inf.
template <int N, class RayN, class Occluded>
uint32_t trace_lanes(const SegmentPacket& packet, uint32_t skip, Occluded occluded) {
  uint32_t blocked = 0;
  for (int first = 0; first < SegmentPacket::width; first += N) {
    RayN ray;
    alignas(64) int valid[N];
    load_lanes<N>(packet, skip, first, &ray, valid);
    occluded(valid, &ray);
    for (int i = 0; i < N; ++i) blocked |= uint32_t(valid[i] != 0 && ray.tfar[i] < 0) << (first + i);
  }
  return blocked;
}

}  // namespace

RayTree::RayTree(RTCDevice device, const Scene& scene, Part part)
    : device_(device), scene_(scene), moves_(part == Part::moving), rtc_(rtcNewScene(device)) {
  if (moves_) {
    // A tree a geometry, which is refitted, and a small one over them.
    rtcSetSceneFlags(handle(), RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC);
    add_moving();
  } else {
    rtcSetSceneFlags(handle(), RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(handle(), RTC_BUILD_QUALITY_HIGH);
    add_still();
  }
  for (unsigned id = 0; id < groups_.size(); ++id) attach(id);
  rtcCommitScene(handle());
}

RayTree::~RayTree() = default;

// Only alpha-tested triangles pay for the filter: they are a geometry of their own.
void RayTree::add_still() {
  for (int i = 0; i < 2; ++i) {
    groups_.push_back(std::make_unique<Group>());
    groups_[i]->scene = &scene_;
    groups_[i]->alpha_tested = i == 1;
    groups_[i]->vertex_count = static_cast<uint32_t>(still_vertices(scene_));
  }
  const auto count = static_cast<uint32_t>(still_triangles(scene_));
  for (uint32_t t = 0; t < count; ++t) groups_[alpha_tested(scene_, t)]->triangles.push_back(t);
  direct_ = groups_[1]->triangles.empty();
}

void RayTree::add_moving() {
  for (const MovingObject& object : scene_.animation.objects) {
    groups_.push_back(std::make_unique<Group>());
    Group& group = *groups_.back();
    group.scene = &scene_;
    group.alpha_tested = alpha_tested(scene_, object.first_triangle);
    group.triangles.resize(object.triangle_count);
    std::iota(group.triangles.begin(), group.triangles.end(), object.first_triangle);
    group.first_vertex = object.first_vertex;
    group.vertex_count = object.vertex_count;
  }
}

void RayTree::attach(unsigned id) {
  Group& group = *groups_[id];
  if (group.triangles.empty()) return;
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  // Embree's own buffers: a shared float3 buffer must be padded, which Scene::positions is not.
  auto* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                           sizeof(glm::vec3), group.vertex_count);
  auto* indices = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), group.triangles.size()));
  if (vertices && indices) {
    copy_positions(group, vertices);
    for (size_t i = 0; i < group.triangles.size(); ++i) {
      indices[i] = scene_.triangles[group.triangles[i]] - group.first_vertex;
    }
  }
  if (group.alpha_tested) {
    rtcSetGeometryUserData(geometry, &group);
    rtcSetGeometryIntersectFilterFunction(geometry, Group::drop_holes);
    rtcSetGeometryOccludedFilterFunction(geometry, Group::drop_holes);
  }
  if (moves_) rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_REFIT);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(handle(), geometry, id);
  rtcReleaseGeometry(geometry);
}

void RayTree::copy_positions(const Group& group, void* vertices) const {
  std::copy_n(scene_.positions.begin() + group.first_vertex, group.vertex_count,
              static_cast<glm::vec3*>(vertices));
}

void RayTree::update(const std::vector<uint32_t>& objects) {
  if (objects.empty()) return;
  for (const uint32_t id : objects) {
    RTCGeometry geometry = rtcGetGeometry(handle(), id);
    copy_positions(*groups_[id], rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_VERTEX, 0));
    rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcCommitGeometry(geometry);
  }
  rtcCommitScene(handle());
}

std::optional<Hit> RayTree::intersect(const glm::vec3& origin, const glm::vec3& direction, float start,
                                      float end) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit r;
  r.ray = make_ray(origin, direction, start, end);
  r.hit.geomID = r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(handle(), &context, &r);
  if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const uint32_t triangle = direct_ ? r.hit.primID : groups_[r.hit.geomID]->triangles[r.hit.primID];
  return Hit{r.ray.tfar, triangle, glm::vec2(r.hit.u, r.hit.v),
             glm::vec3(r.hit.Ng_x, r.hit.Ng_y, r.hit.Ng_z)};
}

bool RayTree::occluded(const glm::vec3& a, const glm::vec3& b) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = make_ray(a, b - a, 0, 1);
  rtcOccluded1(handle(), &context, &ray);
  return ray.tfar < 0;
}

uint32_t RayTree::occluded(const SegmentPacket& packet, int native_width, uint32_t skip) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  switch (native_width) {
    case 16:
      return trace_lanes<16, RTCRay16>(packet, skip, [&](const int* valid, RTCRay16* ray) {
        rtcOccluded16(valid, handle(), &context, ray);
      });
    case 8:
      return trace_lanes<8, RTCRay8>(packet, skip, [&](const int* valid, RTCRay8* ray) {
        rtcOccluded8(valid, handle(), &context, ray);
      });
    default:
      return trace_lanes<4, RTCRay4>(packet, skip, [&](const int* valid, RTCRay4* ray) {
        rtcOccluded4(valid, handle(), &context, ray);
      });
  }
}

}  // namespace vsglbench
