// The moments of a set of VPLs that a VSGL is made from [MFIS16 App. B], and how two sets merge.
//
// Unlike the paper, which filters E[y], E[|y|²] and E[r ξ] and subtracts, every moment is kept central:
// variance about the own mean, and q = 1-|mean direction|. Merging uses the parallel-axis identities, which
// equal the paper's sums in exact arithmetic and cancel nothing in single precision.
#ifndef VSGLBENCH_MOMENTS_GLSL
#define VSGLBENCH_MOMENTS_GLSL

#include "math.glsl"
#include "sg.glsl"
#include "types.h"

struct Lobe {
  vec3 power;      // ΣΦR, W
  vec3 direction;  // Σw r ξ / Σw with w = luminance(ΦR), r = λ/(λ+1)
  float q;         // 1-|direction|
};

struct Moments {
#if LIGHT_LOBES & DIFFUSE_LOBE
  Lobe diffuse;
#endif
#if LIGHT_LOBES & SPECULAR_LOBE
  Lobe specular;
#endif
  vec3 mean;       // μ, weighted with luminance(Φ(Rd+Rs))
  float variance;  // E|y-μ|²
};

Lobe empty_lobe() { return Lobe(vec3(0.0), vec3(0.0), 1.0); }
Moments empty_moments() {
  Moments m;
#if LIGHT_LOBES & DIFFUSE_LOBE
  m.diffuse = empty_lobe();
#endif
#if LIGHT_LOBES & SPECULAR_LOBE
  m.specular = empty_lobe();
#endif
  m.mean = vec3(0.0);
  m.variance = 0.0;
  return m;
}

float lobe_weight(Lobe l) { return luminance(l.power); }
float moments_weight(Moments m) {
#if LIGHT_LOBES == DIFFUSE_LOBE
  return lobe_weight(m.diffuse);
#elif LIGHT_LOBES == SPECULAR_LOBE
  return lobe_weight(m.specular);
#else
  return lobe_weight(m.diffuse) + lobe_weight(m.specular);
#endif
}

// Four sets as one: the k-th counts `factor[k]` times.
//  direction = Σ w v / Σw;  1-|direction| = Σ w (q + |v| ½|ξ-ξ̄|²) / Σw with ξ, ξ̄ the unit directions.
Lobe merge_lobes(Lobe a[4], vec4 factor) {
  Lobe m = Lobe(vec3(0.0), vec3(0.0), 0.0);
  vec4 w;
  float total = 0.0;
  for (int k = 0; k < 4; ++k) {
    m.power += factor[k] * a[k].power;
    w[k] = factor[k] * lobe_weight(a[k]);
    total += w[k];
    m.direction += w[k] * a[k].direction;
  }
  if (total <= 0.0) return empty_lobe();
  m.direction /= total;
  vec3 axis = safe_normalize(m.direction, vec3(0.0));
  for (int k = 0; k < 4; ++k) {
    vec3 d = safe_normalize(a[k].direction, axis) - axis;
    m.q += w[k] / total * (a[k].q + (1.0 - a[k].q) * 0.5 * dot(d, d));
  }
  m.q = m.q > 1.0 ? 1.0 : m.q;
  return m;
}

Moments merge(Moments a[4], vec4 factor) {
  Moments m;
#if LIGHT_LOBES & DIFFUSE_LOBE
  m.diffuse = merge_lobes(Lobe[4](a[0].diffuse, a[1].diffuse, a[2].diffuse, a[3].diffuse), factor);
#endif
#if LIGHT_LOBES & SPECULAR_LOBE
  m.specular = merge_lobes(Lobe[4](a[0].specular, a[1].specular, a[2].specular, a[3].specular), factor);
#endif
  m.mean = vec3(0.0);
  m.variance = 0.0;
  vec4 w;
  float total = 0.0;
  for (int k = 0; k < 4; ++k) {
    w[k] = factor[k] * moments_weight(a[k]);
    total += w[k];
  }
  if (total <= 0.0) return empty_moments();
  w /= total;
  // The mean as offsets from the heaviest set, so that far from the origin nothing rounds away.
  int heaviest = 0;
  for (int k = 1; k < 4; ++k) heaviest = w[k] > w[heaviest] ? k : heaviest;
  vec3 base = a[heaviest].mean;
  vec3 offset = vec3(0.0);
  for (int k = 0; k < 4; ++k) offset += w[k] > 0.0 ? w[k] * (a[k].mean - base) : vec3(0.0);
  m.mean = base + offset;
  for (int k = 0; k < 4; ++k) {
    vec3 d = (a[k].mean - base) - offset;
    m.variance += w[k] > 0.0 ? w[k] * (a[k].variance + dot(d, d)) : 0.0;
  }
  return m;
}

// Two sets as one, for sums of many sets one after the other: as merge(), with 1-r of the mean direction in
// closed form. Of vectors f_a r_a ξ_a and f_b r_b ξ_b, f_a + f_b = 1:  r² = (1-p)² - e  with
// p = f_a q_a + f_b q_b and e = f_a r_a f_b r_b |ξ_a-ξ_b|²;  so 1-r = (p (2-p) + e) / (1+r): nothing cancels.
Lobe merge_two(Lobe a, Lobe b) {
  float wa = lobe_weight(a), wb = lobe_weight(b), total = wa + wb;
  if (total <= 0.0) return empty_lobe();
  float fa = wa / total, fb = wb / total;
  vec3 d = safe_normalize(a.direction, vec3(0.0)) - safe_normalize(b.direction, vec3(0.0));
  float p = fa * a.q + fb * b.q;
  float e = fa * (1.0 - a.q) * (fb * (1.0 - b.q)) * dot(d, d);
  float r = sqrt(max((1.0 - p) * (1.0 - p) - e, 0.0));
  float q = min((p * (2.0 - p) + e) / (1.0 + r), 1.0);
  return Lobe(a.power + b.power, fa * a.direction + fb * b.direction, q);
}

Moments merge_two(Moments a, Moments b) {
  float wa = moments_weight(a), wb = moments_weight(b), total = wa + wb;
  if (total <= 0.0) return empty_moments();
  float fa = wa / total, fb = wb / total;
  Moments m;
#if LIGHT_LOBES & DIFFUSE_LOBE
  m.diffuse = merge_two(a.diffuse, b.diffuse);
#endif
#if LIGHT_LOBES & SPECULAR_LOBE
  m.specular = merge_two(a.specular, b.specular);
#endif
  // Offset from the first set: of an empty one, the position means nothing.
  vec3 d = b.mean - a.mean;
  m.mean = wa > 0.0 ? a.mean + fb * d : b.mean;
  m.variance = wa > 0.0 ? fa * a.variance + fb * b.variance + fa * fb * dot(d, d) : b.variance;
  return m;
}

// The light whose VPLs have these moments, all powers multiplied by `factor`.
Vsgl make_vsgl(Moments m, float factor, float level) {
  Vsgl v;
  v.mean = m.mean;
  v.variance = m.variance < 1e-20 ? 1e-20 : m.variance;  // not max(), which would hide a NaN
  vec3 axis = vec3(0.0, 1.0, 0.0);
#if LIGHT_LOBES & SPECULAR_LOBE
  v.specular_sharpness = lobe_sharpness(m.specular.q);
  v.specular_axis = axis = safe_normalize(m.specular.direction, axis);
  v.specular = factor * m.specular.power / sg_integral(v.specular_sharpness);
#endif
#if LIGHT_LOBES & DIFFUSE_LOBE
  v.diffuse_sharpness = lobe_sharpness(m.diffuse.q);
  v.diffuse_axis = safe_normalize(m.diffuse.direction, axis);
  v.diffuse = factor * m.diffuse.power / sg_integral(v.diffuse_sharpness);
#endif
  v.level = level;
  v.power = factor * moments_weight(m);
  return v;
}

Vsgl no_light() { return make_vsgl(empty_moments(), 0.0, -1.0); }

#endif
