// One virtual spherical light at one surface, without visibility [VSGL14 Eq. 2; Hašan et al. 2009]: the
// integral of ρ over the cone of directions towards the sphere, over πr², by Monte-Carlo with three-way
// multiple importance sampling of the cone and both BRDFs (balance heuristic, Veach 1997).
#ifndef VSGLBENCH_VSL_SHADING_GLSL
#define VSGLBENCH_VSL_SHADING_GLSL

#include "brdf_sampling.glsl"
#include "random.glsl"
#include "vpl_shading.glsl"

struct Cone {
  vec3 axis;
  float one_minus_cosine;  // of the half angle
};

// Half angle asin(r/d), π/2 inside the sphere [light-transport §5]. 1-cosθ without cancellation.
Cone vsl_cone(vec3 to_light, float radius, vec3 inside_axis) {
  float distance2 = dot(to_light, to_light);
  float sine2 = distance2 > radius * radius ? radius * radius / distance2 : 1.0;
  return Cone(safe_normalize(to_light, inside_axis), sine2 / (1.0 + sqrt(1.0 - sine2)));
}

float cone_pdf(Cone c) { return 1.0 / (2.0 * PI * c.one_minus_cosine); }

// Uniform over the cone's solid angle.
vec3 sample_cone(Cone c, vec2 u) {
  float low = u.x * c.one_minus_cosine;  // 1-cosθ
  float sine = sqrt(max(low * (2.0 - low), 0.0));
  return from_frame(c.axis, vec3(sine * cos(2.0 * PI * u.y), sine * sin(2.0 * PI * u.y), 1.0 - low));
}

// 1-ω·axis by the difference of unit vectors: a cone of 1e-4 still has an inside.
bool in_cone(Cone c, vec3 direction) {
  vec3 d = direction - c.axis;
  return 0.5 * dot(d, d) <= c.one_minus_cosine;
}

// ρ(ω)/(p_cone + p_receiver + p_emitter): what a direction of any of the three strategies is worth.
vec3 vsl_term(Surface s, Surface emitter, Vpl light, Cone c, vec3 direction) {
  if (!in_cone(c, direction)) return vec3(0.0);
  float density =
      cone_pdf(c) + brdf_pdf(s, direction, SURFACE_LOBES) + brdf_pdf(emitter, -direction, LIGHT_LOBES);
  return vpl_rho(s, light, direction) / density;
}

// As many samples of each strategy as the half angle asks for: `light.samples` at π/2, at least one.
vec3 shade_vsl(Surface s, Vpl light, uint random) {
  if (light.power <= 0.0 || light.radius <= 0.0) return vec3(0.0);
  Cone c = vsl_cone(light.position - s.position, light.radius, s.normal);
  float half_angle = acos(clamp(1.0 - c.one_minus_cosine, 0.0, 1.0));
  uint count = uint(clamp(ceil(light.samples * half_angle / (0.5 * PI)), 1.0, 1024.0));
  Surface emitter = vpl_surface(light);
  // Four sequences, each shifted by words of its own: without bias whatever they have in common.
  uvec2 seed[4];
  for (int k = 0; k < 4; ++k) {
    uint word = random_hash(random + uint(k));
    seed[k] = uvec2(word, random_hash(word));
  }
  vec3 sum = vec3(0.0);
  for (uint j = 0u; j < count; ++j) {
    vec2 choose = sequence_point(j, seed[3]);
    sum += vsl_term(s, emitter, light, c, sample_cone(c, sequence_point(j, seed[0])));
    vec3 by_surface = sample_brdf(s, sequence_point(j, seed[1]), choose.x, SURFACE_LOBES);
    vec3 by_emitter = -sample_brdf(emitter, sequence_point(j, seed[2]), choose.y, LIGHT_LOBES);
    sum += vsl_term(s, emitter, light, c, by_surface);
    sum += vsl_term(s, emitter, light, c, by_emitter);
  }
  return sum / (float(count) * PI * light.radius * light.radius);
}

#endif
