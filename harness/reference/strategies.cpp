#include "reference/strategies.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "image/image.h"
#include "reference/random.h"
#include "scene/surface.h"

namespace vsglbench {
namespace {

bool is_black(const glm::vec3& c) { return c.x <= 0 && c.y <= 0 && c.z <= 0; }

// Calls visit(hit) for the closest hit, or for every hit along the ray where nothing occludes.
template <class Visit>
void for_hits(RayStream& rays, const glm::vec3& origin, const glm::vec3& direction, bool closest_only,
              const Visit& visit) {
  // A step of a few ulps, or a picometre from a hit at the origin itself, passes the triangle just met: the
  // ray is the same, so is the distance Embree finds. Triangles that coincide count as one.
  constexpr float past = 1 + 0x1p-21f, least = 1e-12f;
  auto hit = rays.intersect(origin, direction);
  while (hit) {
    visit(*hit);
    if (closest_only) return;
    hit = rays.intersect(origin, direction, std::max(hit->distance * past, least));
  }
}

// Whether a direction leaves the surface on the side of both normals.
bool leaves(const Brdf& brdf, const glm::vec3& direction) {
  return glm::dot(brdf.geometric_normal(), direction) > 0 && glm::dot(brdf.normal(), direction) > 0;
}

}  // namespace

Strategies::Strategies(const Tracer& tracer, const ImagePlane& camera, uint32_t width, uint32_t height,
                       const ReferenceParameters& p, const std::vector<Footprint>& footprints)
    : tracer_(tracer),
      light_(light_view(tracer.scene().light)),
      camera_(camera),
      axis_flux_(flux_density(tracer.scene().light, {0.5f, 0.5f})),
      width_(width),
      height_(height),
      seed_(p.seed),
      occlusion_(p.occlusion),
      shading_normals_(p.shading_normals),
      footprints_(footprints),
      pool_(size_t(pool_size()) * pool_size()),
      guide_(width, height),
      photon_guide_(1, 1) {}

Strategies::Emitter Strategies::make_emitter(const Hit& hit, const glm::vec2& uv, const glm::vec3& to_light,
                                             float distance) const {
  const Surface surface = surface_at(tracer_.scene(), hit.triangle, hit.barycentric, to_light);
  Emitter x1;
  x1.position = surface.position;
  x1.ray_origin = tracer_.offset(surface.position, surface.geometric_normal);
  const float c = -glm::dot(to_light, light_.view().forward);
  x1.flux = light_.view().perspective ? c * c * c : 1;  // as flux_density has it
  x1.density =
      light_.facing_density(-to_light, distance) * std::abs(glm::dot(surface.geometric_normal, to_light));
  x1.brdf = Brdf(surface, to_light);
  if (shading_normals_ == ShadingNormals::camera) {
    x1.flux *= glm::dot(surface.normal, to_light) / glm::dot(surface.geometric_normal, to_light);
  }
  x1.cell = LightGuide::cell(uv);
  return x1;
}

Strategies::Emitter Strategies::trace_emitter(const glm::vec2& uv, RayStream& rays) const {
  glm::vec3 origin, direction;
  light_.view().ray(uv, &origin, &direction);
  const auto hit = rays.intersect(origin, direction);
  return hit ? make_emitter(*hit, uv, -direction, hit->distance) : Emitter();
}

void Strategies::trace_pool_row(uint32_t row, uint32_t batch, RayStream& rays) {
  for (uint32_t column = 0; column < pool_size(); ++column) {
    const uint32_t cell = row * pool_size() + column;
    const glm::vec2 jitter(random4(seed_, Stream::pool, batch, cell));
    pool_[cell] = trace_emitter((glm::vec2(column, row) + jitter) / float(pool_size()), rays);
  }
}

std::optional<double> Strategies::aim_photons() {
  double sharp = 0, all = 0;
  for (const Emitter& x1 : pool_) {
    if (!(x1.density > 0)) continue;
    all += x1.flux;
    sharp += x1.flux * x1.brdf.sharpness();
    photon_guide_.teach(0, x1.cell, x1.flux * x1.brdf.sharpness());
  }
  if (!(all > 0)) return std::nullopt;
  photon_guide_.learn(0);
  return sharp / all;
}

void Strategies::set_counts(const SampleCounts& counts) {
  counts_ = counts;
  const double points = double(footprints_.size()) * counts.light / connections_a_point;
  while (pool_bits_ < most_pool_bits && std::exp2(2 * pool_bits_) < points) ++pool_bits_;
  pool_.resize(size_t(pool_size()) * pool_size());
}

glm::vec3 Strategies::contribution(const Emitter& x1, const Receiver& x2) const {
  const Brdf &brdf1 = x1.brdf, &brdf2 = x2.footprint->brdf;
  const glm::vec3 d = x1.position - x2.position;
  const float distance2 = glm::dot(d, d);
  if (!(distance2 > 0)) return glm::vec3(0);
  const float inverse = 1 / std::sqrt(distance2), inverse2 = inverse * inverse;
  const glm::vec3 to_x1 = d * inverse;
  const BrdfValue f2 = brdf2.evaluate(to_x1);
  if (is_black(f2.f)) return glm::vec3(0);
  const BrdfValue f1 = brdf1.evaluate(-to_x1);
  if (is_black(f1.f)) return glm::vec3(0);

  // The balance heuristic's sum of n_i p_i over k p_L.
  const float geometric1 = -glm::dot(brdf1.geometric_normal(), to_x1);
  const float geometric2 =
      x2.geometric_cosine >= 0 ? x2.geometric_cosine : glm::dot(brdf2.geometric_normal(), to_x1);
  const float light = static_cast<float>(counts_.light) * guide_.density(x2.footprint->tile, x1.cell);
  const float receiver =
      static_cast<float>(receiver_samples(*x2.footprint)) * f2.pdf * geometric1 * inverse2 / x1.density;
  const float photons = static_cast<float>(counts_.photons) * photon_guide_.density(0, x1.cell);
  const float emitter = photons * f1.pdf * geometric2 * inverse2 / x2.kernel;
  const float sum = light + receiver + emitter;
  if (!(sum > 0)) return glm::vec3(0);
  const bool of_light = shading_normals_ == ShadingNormals::light;
  const float cosine1 = of_light ? -glm::dot(brdf1.normal(), to_x1) : geometric1;
  const float cosine2 = glm::dot(brdf2.normal(), to_x1);
  return axis_flux_ * f1.f * f2.f * (x1.flux * cosine1 * cosine2 * inverse2 / sum);
}

glm::vec3 Strategies::connect_receiver(const Footprint& x2, const glm::vec3& direction, const Hit& hit,
                                       RayStream& rays) const {
  // x1 must lie in the light's frustum, lit from the side that x2 sees, with nothing before it.
  const glm::vec3 point = x2.ray_origin + hit.distance * direction;
  const auto uv = light_.project(point);
  if (!uv) return glm::vec3(0);
  const glm::vec3 origin = light_.origin(point), d = origin - point;
  const float side = glm::dot(hit.face_normal, direction) < 0 ? 1 : -1;
  if (side * glm::dot(hit.face_normal, d) <= 0) return glm::vec3(0);
  const glm::vec3 normal = glm::normalize(hit.face_normal) * side;
  if (rays.occluded(tracer_.offset(point, normal), origin)) return glm::vec3(0);
  const float distance = glm::length(d);
  return contribution(make_emitter(hit, *uv, d / distance, distance), {&x2, x2.position, x2.kernel, -1});
}

glm::vec3 Strategies::from_receiver(const Footprint& x2, const glm::vec3& random, RayStream& rays) const {
  glm::vec3 direction;
  if (!x2.brdf.sample(random, &direction) || !leaves(x2.brdf, direction)) return glm::vec3(0);
  glm::vec3 sum(0);
  for_hits(rays, x2.ray_origin, direction, occlusion_,
           [&](const Hit& hit) { sum += connect_receiver(x2, direction, hit, rays); });
  return sum;
}

// A cell of the guide, then one of the pool's in it.
const Strategies::Emitter& Strategies::choose(uint32_t tile, const glm::uvec3& bits) const {
  const uint32_t inner = pool_bits_ - LightGuide::cell_bits;
  const glm::uvec2 cell = LightGuide::column_row(guide_.sample(tile, bits.x));
  const glm::uvec2 place = glm::uvec2(bits.y, bits.z) >> (32 - inner);
  return pool_[(((cell.y << inner) + place.y) << pool_bits_) + (cell.x << inner) + place.x];
}

// The lanes that x1 lights: facing it, with nothing between.
uint32_t Strategies::connect_light(const ReceiverGroup& group, const Emitter& x1, RayStream& rays) const {
  SegmentPacket packet;
  const GroupTarget target = {x1.position, x1.ray_origin, x1.brdf.normal(), x1.brdf.geometric_normal()};
  const uint32_t facing = aim(group, target, &packet);
  return facing != 0 && occlusion_ ? facing & ~rays.occluded(packet) : facing;
}

void Strategies::gather_light(const ReceiverGroup& group, uint32_t tile, const glm::uvec3& shift, bool teach,
                              RayStream& rays, glm::vec3* estimate) {
  const PointLattice lattice(counts_.light, shift);
  Lesson lesson;
  const Emitter* next = &choose(tile, lattice.bits(0));
  for (uint32_t i = 0; i < counts_.light; ++i) {
    // The next x1 comes into the cache while this one's rays are traced.
    const Emitter& x1 = *next;
    next = &choose(tile, lattice.bits(i + 1));
    __builtin_prefetch(next);
    __builtin_prefetch(&next->flux);
    if (!(x1.density > 0)) continue;
    for (uint32_t lit = connect_light(group, x1, rays); lit != 0; lit &= lit - 1) {
      const auto lane = static_cast<uint32_t>(std::countr_zero(lit));
      const Footprint& x2 = footprints_[group.pixel[lane]];
      const glm::vec3 radiance = contribution(x1, {&x2, x2.position, x2.kernel, -1});
      estimate[group.pixel[lane]] += radiance;
      if (!teach || is_black(radiance)) continue;
      lesson.found.push_back({lane, x1.cell, luminance(radiance)});
      lesson.total[lane] += luminance(radiance);
    }
  }
  // Each pixel teaches the shares of its own light, so that dark pixels count too.
  for (const auto& f : lesson.found) guide_.teach(tile, f.cell, f.luminance / lesson.total[f.lane]);
}

glm::vec3 Strategies::gather_receiver(uint32_t pixel, uint32_t batch, RayStream& rays) const {
  const Footprint& x2 = footprints_[pixel];
  const uint32_t n = receiver_samples(x2);
  const PointLattice directions(n, glm::uvec3(random_bits(seed_, Stream::receiver, batch, pixel)));
  glm::vec3 sum(0);
  for (uint32_t i = 0; i < n; ++i) sum += from_receiver(x2, directions.point(i), rays);
  return sum;
}

// `light` group by group, whose lattices interleave along the guide's order; `receiver` pixel by pixel.
void Strategies::gather_block(uint32_t x0, uint32_t y0, uint32_t batch, bool teach, RayStream& rays,
                              glm::vec3* estimate) {
  const glm::uvec3 first(random_bits(seed_, Stream::light, batch, y0 * width_ + x0));
  for (uint32_t g = 0; g < ReceiverGroup::groups; ++g) {
    const ReceiverGroup group = make_receiver_group(footprints_, width_, height_, x0, y0, g);
    if (group.lanes == 0 || counts_.light == 0) continue;
    const glm::uvec3 shift = first + g * glm::uvec3((1u << 30) / counts_.light, 1u << 30, 1u << 30);
    gather_light(group, guide_.tile(x0, y0), shift, teach, rays, estimate);
  }
  if (counts_.receiver == 0) return;
  for (uint32_t y = y0; y < std::min(y0 + ReceiverGroup::block, height_); ++y) {
    for (uint32_t x = x0; x < std::min(x0 + ReceiverGroup::block, width_); ++x) {
      const uint32_t pixel = y * width_ + x;
      if (footprints_[pixel].valid) estimate[pixel] += gather_receiver(pixel, batch, rays);
    }
  }
}

void Strategies::gather(uint32_t tile, uint32_t batch, bool teach, RayStream& rays, glm::vec3* estimate) {
  const uint32_t size = guide_.tile_size();
  const uint32_t x0 = tile % guide_.tiles_x() * size, y0 = tile / guide_.tiles_x() * size;
  const uint32_t x1 = std::min(x0 + size, width_), y1 = std::min(y0 + size, height_);
  for (uint32_t y = y0; y < y1; ++y)
    std::fill(estimate + y * width_ + x0, estimate + y * width_ + x1, glm::vec3(0));
  for (uint32_t y = y0; y < y1; y += ReceiverGroup::block) {
    for (uint32_t x = x0; x < x1; x += ReceiverGroup::block) gather_block(x, y, batch, teach, rays, estimate);
  }
}

bool Strategies::land(const Emitter& x1, const glm::vec3& direction, const Hit& hit, RayStream& rays,
                      Splat* splat) const {
  // The pixel it projects to, if that pixel's centre sees the same surface.
  const glm::vec3 point = x1.ray_origin + hit.distance * direction;
  const auto uv = camera_.project(point);
  if (!uv) return false;
  const uint32_t x = std::min(static_cast<uint32_t>(uv->x * static_cast<float>(width_)), width_ - 1);
  const uint32_t y = std::min(static_cast<uint32_t>(uv->y * static_cast<float>(height_)), height_ - 1);
  const Footprint& footprint = footprints_[size_t(y) * width_ + x];
  if (!footprint.valid) return false;
  const glm::vec3 eye = camera_.view().position, to_eye = eye - point;
  glm::vec3 normal = glm::normalize(hit.face_normal);
  if (glm::dot(normal, to_eye) < 0) normal = -normal;
  const float cosine = -glm::dot(normal, direction);
  if (!(cosine > 0) || !footprint.same_surface(point, normal)) return false;

  // Its kernel: the footprint's density where it landed.
  const float distance = glm::length(to_eye);
  const float facing = camera_.facing_density(-to_eye / distance, distance);
  const float kernel = facing * glm::dot(normal, to_eye) / distance * footprint.uv_density;
  *splat = {y * width_ + x, contribution(x1, {&footprint, point, kernel, cosine})};
  return !is_black(splat->radiance) && !rays.occluded(tracer_.offset(point, normal), eye);
}

void Strategies::emit(uint32_t first, uint32_t last, uint32_t batch, RayStream& rays,
                      std::vector<Splat>* splats) const {
  const PointLattice lattice(counts_.photons, glm::uvec3(random_bits(seed_, Stream::photon_plane, batch, 0)));
  for (uint32_t i = first; i < last; ++i) {
    // x1: a cell of the photons' guide, a place in it.
    const glm::uvec3 bits = lattice.bits(i);
    const glm::vec2 cell(LightGuide::column_row(photon_guide_.sample(0, bits.x)));
    const glm::vec2 place(to_unit(bits.y), to_unit(bits.z));
    const Emitter x1 = trace_emitter((cell + place) / float(LightGuide::cells), rays);
    if (!(x1.density > 0)) continue;

    // x2, by its BRDF.
    glm::vec3 direction;
    const glm::vec3 random(random4(seed_, Stream::photon_direction, batch, i));
    if (!x1.brdf.sample(random, &direction) || !leaves(x1.brdf, direction)) continue;
    for_hits(rays, x1.ray_origin, direction, occlusion_, [&](const Hit& hit) {
      Splat splat;
      if (land(x1, direction, hit, rays, &splat)) splats->push_back(splat);
    });
  }
}

}  // namespace vsglbench
