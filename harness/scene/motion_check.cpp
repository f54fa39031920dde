#include "scene/motion_check.h"

#include <cmath>

#include "base/error.h"
#include "scene/animation.h"
#include "scene/view_motion.h"

namespace vsglbench {
namespace {

template <class... Args>
void require(bool condition, const Scene& scene, fmt::format_string<Args...> format, Args&&... args) {
  if (condition) return;
  throw fail(ErrorKind::scene, "scene {}: {}", scene.name, fmt::format(format, std::forward<Args>(args)...));
}

template <class T>
void check_track(const Scene& scene, const std::string& owner, const char* what, const Track<T>& track) {
  const std::string problem = problem_of(track);
  require(problem.empty(), scene, "the {} of {}: {}", what, owner, problem);
}

void check_nodes(const Scene& scene) {
  const std::vector<MovingNode>& nodes = scene.animation.nodes;
  for (size_t i = 0; i < nodes.size(); ++i) {
    const MovingNode& node = nodes[i];
    require(node.parent >= -1 && node.parent < static_cast<int>(i), scene,
            "node '{}': its parent {} is not before it", node.name, node.parent);
    const std::string owner = fmt::format("'{}'", node.name);
    check_track(scene, owner, "translation", node.translation);
    check_track(scene, owner, "rotation", node.rotation);
    check_track(scene, owner, "scale", node.scale);
  }
}

void check_aim(const Scene& scene, const char* owner, const AimMotion& aim) {
  require(aim.unit > 0 && std::isfinite(aim.unit), scene, "{} has a unit of {} m", owner, aim.unit);
  // A sun that lights what there is has no position.
  check_track(scene, owner, "position", aim.position);
  check_track(scene, owner, "aim", aim.aim);
  check_track(scene, owner, "up", aim.up);
}

void check_views(const Scene& scene) {
  if (const auto& camera = scene.animation.camera) {
    check_aim(scene, "the camera", camera->aim);
    check_track(scene, "the camera", "angle", camera->vfov);
  }
  if (const auto& light = scene.animation.light) {
    check_aim(scene, "the light", light->aim);
    check_track(scene, "the light", "power", light->power);
    if (!light->sun) check_track(scene, "the light", "angle", light->fov);
  }
}

// Every object continues where the one before it ends, the last one at the end.
void check_objects(const Scene& scene) {
  size_t vertex = still_vertices(scene), triangle = still_triangles(scene);
  for (const MovingObject& o : scene.animation.objects) {
    require(o.first_vertex == vertex && o.first_triangle == triangle, scene,
            "object '{}' does not follow what is before it", o.name);
    require(o.node < scene.animation.nodes.size(), scene, "object '{}': no node {}", o.name, o.node);
    require(o.positions.size() == o.vertex_count && o.normals.size() == o.vertex_count &&
                o.tangents.size() == o.vertex_count,
            scene, "object '{}': {} vertices but {} positions, {} normals, {} tangents", o.name,
            o.vertex_count, o.positions.size(), o.normals.size(), o.tangents.size());
    require(o.extents.size() == frame_count(scene), scene, "object '{}' is not measured in {} frames", o.name,
            frame_count(scene));
    vertex += o.vertex_count;
    triangle += o.triangle_count;
    require(triangle <= scene.triangles.size(), scene, "object '{}' has triangles past the {} there are",
            o.name, scene.triangles.size());
    for (size_t t = o.first_triangle; t < triangle; ++t) {
      for (int k = 0; k < 3; ++k) {
        const uint32_t v = scene.triangles[t][k];
        require(v >= o.first_vertex && v < vertex, scene,
                "triangle {} of object '{}' has vertex {} of another", t, o.name, v);
      }
    }
  }
  require(vertex == scene.positions.size() && triangle == scene.triangles.size(), scene,
          "{} vertices and {} triangles come after the last object", scene.positions.size() - vertex,
          scene.triangles.size() - triangle);
  for (size_t t = 0; t < still_triangles(scene); ++t) {
    for (int k = 0; k < 3; ++k) {
      require(scene.triangles[t][k] < still_vertices(scene), scene,
              "triangle {} stands still but its vertex {} moves", t, scene.triangles[t][k]);
    }
  }
}

void check_frames(const Scene& scene) {
  for (uint32_t frame = 0; frame < frame_count(scene); ++frame) {
    const double time = frame_time(scene, frame);
    try {
      world_transforms(scene.animation, time);
      if (scene.animation.camera) posed(*scene.animation.camera, scene, time);
      if (scene.animation.light) posed(*scene.animation.light, scene, time);
    } catch (const Error& e) {
      throw fail(ErrorKind::scene, "scene {}: at frame {}: {}", scene.name, frame, e.what());
    }
  }
}

}  // namespace

void check_motion(const Scene& scene) {
  const Animation& animation = scene.animation;
  require(animation.rate > 0 && std::isfinite(animation.rate), scene, "{} frames a second is no rate",
          animation.rate);
  check_nodes(scene);
  check_views(scene);
  check_objects(scene);
  check_frames(scene);
}

}  // namespace vsglbench
