#include "frame/scene_gpu.h"

#include <algorithm>
#include <cstddef>
#include <span>

#include "base/error.h"
#include "base/file.h"
#include "method/context.h"

namespace vsglbench {

DeferredTargets::DeferredTargets(Device& device, const std::string& name, uint32_t w, uint32_t h,
                                 const Channels& channels, VkImageUsageFlags more_usage)
    : width(w), height(h) {
  static constexpr const char* names[] = {"position", "normal", "geometric normal", "diffuse", "f0"};
  const bool there[] = {true, true, channels.geometric_normal, channels.diffuse, channels.f0};
  for (size_t i = 0; i < maps.size(); ++i) {
    if (!there[i]) continue;
    maps[i] = DeviceImage(device, name + " " + names[i], VK_FORMAT_R32G32B32A32_SFLOAT, w, h,
                          VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                              VK_IMAGE_USAGE_TRANSFER_SRC_BIT | more_usage);
  }
  depth = DeviceImage(device, name + " depth", VK_FORMAT_D32_SFLOAT, w, h,
                      VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | more_usage);
}

FieldMaps DeferredTargets::field_maps() const {
  const auto map = [&](size_t i) { return maps[i] ? &maps[i] : nullptr; };
  return {map(0), map(1), map(2), map(3), map(4)};
}

gpu::Emitter make_emitter(const View& view, uint32_t width, uint32_t height, const glm::vec3& power,
                          bool importance) {
  return {.position = view.position,
          .perspective = view.perspective ? 1u : 0u,
          .forward = view.forward,
          .width = width,
          .right = view.right,
          .height = height,
          .up = view.up,
          .footprint_cosine = 0.1f,
          .extent = view.extent,
          .power = power,
          .importance = importance ? 1u : 0u};
}

SceneGpu::SceneGpu(Device& device, const Scene& scene) : device_(device), triangles_(scene.triangles.size()) {
  upload_geometry(device, scene);
  upload_textures(device, scene);
  make_draws(scene);
}

const RasterPipeline& SceneGpu::pipeline(const ShaderDefines& defines, size_t targets) {
  const auto found = pipelines_.find(defines);
  if (found != pipelines_.end()) return found->second;
  const auto folder = data_root() / "harness" / "frame";
  const std::vector<VkFormat> formats(targets, VK_FORMAT_R32G32B32A32_SFLOAT);
  RasterPipeline made(device_, folder / "gbuffer.vert", folder / "gbuffer.frag", defines,
                      KernelLibrary::include_dirs(), formats, sizeof(gpu::Vertex),
                      {{VK_FORMAT_R32G32B32_SFLOAT, offsetof(gpu::Vertex, position)},
                       {VK_FORMAT_R32G32B32_SFLOAT, offsetof(gpu::Vertex, normal)},
                       {VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(gpu::Vertex, tangent)},
                       {VK_FORMAT_R32G32_SFLOAT, offsetof(gpu::Vertex, uv)}});
  return pipelines_.emplace(defines, std::move(made)).first->second;
}

void SceneGpu::upload_geometry(Device& device, const Scene& scene) {
  vertices_ = Buffer(device, "vertices", scene.positions.size() * sizeof(gpu::Vertex));
  upload_vertices(scene, 0, scene.positions.size());
  indices_ = Buffer(device, "indices", scene.triangles.size() * sizeof(glm::uvec3));
  indices_.upload(std::span<const glm::uvec3>(scene.triangles));
  face_normals_ = Buffer(device, "face normals", scene.triangles.size() * sizeof(glm::vec4));
  upload_face_normals(scene, 0, scene.triangles.size());
}

size_t SceneGpu::upload_vertices(const Scene& scene, size_t first, size_t count) {
  std::vector<gpu::Vertex> vertices(count);
  for (size_t i = 0; i < count; ++i) {
    const size_t v = first + i;
    vertices[i] = {scene.positions[v], scene.normals[v], scene.tangents[v], scene.uvs[v]};
  }
  vertices_.upload(vertices.data(), count * sizeof(gpu::Vertex), first * sizeof(gpu::Vertex));
  return count * sizeof(gpu::Vertex);
}

size_t SceneGpu::upload_face_normals(const Scene& scene, size_t first, size_t count) {
  std::vector<glm::vec4> normals(count);
  for (size_t i = 0; i < count; ++i) {
    const glm::uvec3 t = scene.triangles[first + i];
    const glm::dvec3 a(scene.positions[t.x]), b(scene.positions[t.y]), c(scene.positions[t.z]);
    const glm::dvec3 n = glm::cross(b - a, c - a);
    // A triangle of no area covers no sample: its normal is never read.
    normals[i] = glm::length(n) > 0 ? glm::vec4(glm::normalize(n), 0) : glm::vec4(0, 1, 0, 0);
  }
  face_normals_.upload(normals.data(), count * sizeof(glm::vec4), first * sizeof(glm::vec4));
  return count * sizeof(glm::vec4);
}

size_t SceneGpu::update(const Scene& scene, const Moved& moved) {
  size_t bytes = 0;
  for (const uint32_t index : moved.objects) {
    const MovingObject& object = scene.animation.objects.at(index);
    bytes += upload_vertices(scene, object.first_vertex, object.vertex_count);
    bytes += upload_face_normals(scene, object.first_triangle, object.triangle_count);
  }
  return bytes;
}

void SceneGpu::upload_textures(Device& device, const Scene& scene) {
  constexpr VkImageUsageFlags usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  white_ = DeviceImage(device, "white", VK_FORMAT_R8G8B8A8_UNORM, 1, 1, usage);
  const uint8_t white[] = {255, 255, 255, 255};
  white_.upload(white, sizeof white);
  for (const Texture& texture : scene.textures) {
    if (texture.rgba.empty()) {  // read by no material
      textures_.emplace_back();
      continue;
    }
    const VkFormat format = texture.srgb ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_R8G8B8A8_UNORM;
    textures_.emplace_back(device, texture.name, format, texture.width, texture.height, usage);
    textures_.back().upload(texture.rgba.data(), texture.rgba.size());
  }
}

void SceneGpu::make_draws(const Scene& scene) {
  for (const Batch& batch : scene.batches) {
    const Material& m = scene.materials[batch.material];
    Draw draw;
    draw.first_index = 3 * batch.first_triangle;
    draw.index_count = 3 * batch.triangle_count;
    draw.textures = {m.base_color_texture, m.metallic_roughness_texture, m.normal_texture};
    draw.push = {.base_color = m.base_color,
                 .metallic = m.metallic,
                 .roughness = m.roughness,
                 .phong_exponent = m.phong_exponent,
                 .specular = m.specular,
                 .alpha_cutoff = m.alpha_cutoff,
                 .normal_scale = m.normal_scale,
                 .first_triangle = batch.first_triangle};
    for (uint32_t slot = 0; slot < 3; ++slot)
      draw.push.textures |= draw.textures[slot] >= 0 ? 1u << slot : 0u;
    draws_.push_back(draw);
  }
  const std::vector<uint32_t>& moving = scene.animation.moves.objects;
  const size_t end =
      moving.empty() ? scene.triangles.size() : scene.animation.objects.at(moving.front()).first_triangle;
  still_draws_ = static_cast<size_t>(
      std::ranges::count_if(scene.batches, [&](const Batch& b) { return b.first_triangle < end; }));
}

uint64_t SceneGpu::draw(Recorder& recorder, const View& view, const Buffer& viewer,
                        const DeferredTargets& targets, const ShaderDefines& defines, Part part) {
  const size_t first = part == Part::moving ? still_draws_ : 0,
               end = part == Part::still ? still_draws_ : draws_.size();
  uint64_t triangles = 0;
  std::vector<const DeviceImage*> maps;
  for (const DeviceImage& map : targets.maps)
    if (map) maps.push_back(&map);
  const RasterPipeline& pipeline = this->pipeline(defines, maps.size());
  const VkCommandBuffer commands = recorder.commands();
  const glm::mat4 view_projection = view.view_projection();
  const auto start = part == Part::moving ? RasterPipeline::Start::copied : RasterPipeline::Start::cleared;
  pipeline.render(commands, maps, targets.depth, start, [&] {
    const VkBuffer vertices = vertices_.handle();
    const VkDeviceSize zero = 0;
    vkCmdBindVertexBuffers(commands, 0, 1, &vertices, &zero);
    vkCmdBindIndexBuffer(commands, indices_.handle(), 0, VK_INDEX_TYPE_UINT32);
    for (const Draw& draw : std::span(draws_).subspan(first, end - first)) {
      const auto texture = [&](int slot) -> const DeviceImage& {
        return draw.textures[slot] < 0 ? white_ : textures_[draw.textures[slot]];
      };
      gpu::DrawPush push = draw.push;
      push.view_projection = view_projection;
      pipeline.bind(commands, recorder.descriptors(),
                    {texture(0), texture(1), texture(2), viewer, face_normals_}, push);
      vkCmdDrawIndexed(commands, draw.index_count, 1, draw.first_index, 0, 0);
      triangles += draw.index_count / 3;
    }
  });
  return triangles;
}

}  // namespace vsglbench
