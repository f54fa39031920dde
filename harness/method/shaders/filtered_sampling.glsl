// VSGLs by filtered importance sampling [MFIS16 §3–4, App. D]. The including kernel defines
//   float footprint_level(Centre c)               the mip level l_i
//   float footprint_share(Centre c, float level)  the total is this times the filtered mean f̄(x_i, l_i)
// and, with OWN_CENTRES, uvec2 choose_texel(uint i), the base texel of light i; else a stratified point is
// warped. With CARRIED, a buffer at binding AFTER_MOMENTS + 2 holds what the frame before left, and `frame`
// says how many there were.
layout(local_size_x = 64) in;
layout(set = 0, binding = 0, std430) readonly buffer Pdf { float pdf[]; };
#define PDF(i) pdf[i]
#define MOMENTS_BINDING 1
#include "moments_buffers.glsl"
#include "warp.glsl"
layout(set = 0, binding = AFTER_MOMENTS, scalar) writeonly buffer Lights { Vsgl lights[]; };
layout(set = 0, binding = AFTER_MOMENTS + 1, std430) writeonly buffer Squares {
  vec4 squares[];
};  // LightShapes
layout(push_constant, scalar) uniform Push {
  uint width, height;
  uint count;  // N
  uint step;   // floor(2^32/N)
  uvec2 shift;
  float footprint_size;  // K
#ifdef CARRIED
  uint frame;
#endif
};

struct Centre {
  vec2 position;  // in base texels: the centre of the texel that was chosen
  float p;        // PDF there, of mean 1
  float scale;    // 1/mean of the stored PDF
};

uvec2 base_size() { return uvec2(width, height); }
float texel_count() { return float(width) * float(height); }

// p̄(x, l), bilinear on one level.
float pdf_on_level(Centre c, uint level) {
  Taps taps = bilinear_taps(base_size(), level, c.position);
  float sum = 0.0;
  for (int k = 0; k < 4; ++k) sum += taps.weight[k] * PDF(taps.index[k]);
  return sum * c.scale;
}
// p̄(x, l), trilinear.
float filtered_pdf(Centre c, float level) {
  uint lo = uint(level), top = top_level(base_size());
  return mix(pdf_on_level(c, lo), pdf_on_level(c, min(lo + 1u, top)), level - float(lo));
}
// 4^l/M.
float footprint_area(float level) { return exp2(2.0 * level) / texel_count(); }

float footprint_level(Centre c);
float footprint_share(Centre c, float level);
#ifdef OWN_CENTRES
uvec2 choose_texel(uint i);
#else
uvec2 choose_texel(uint i) { return warp(base_size(), unit_interval(lattice_point(i, step, shift))); }
#endif

// f̄(x, l): the moments merged with trilinear weights.
Moments moments_on_level(Centre c, uint level) {
  Taps taps = bilinear_taps(base_size(), level, c.position);
  Moments a[4];
  for (int k = 0; k < 4; ++k) a[k] = load_moments(taps.index[k]);
  return merge(a, vec4(taps.weight[0], taps.weight[1], taps.weight[2], taps.weight[3]));
}
Moments filtered_moments(Centre c, float level) {
  uint lo = uint(level), top = top_level(base_size());
  float f = level - float(lo);
  Moments a[4] = Moments[4](moments_on_level(c, lo), moments_on_level(c, min(lo + 1u, top)), empty_moments(),
                            empty_moments());
  return merge(a, vec4(1.0 - f, f, 0.0, 0.0));
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  float mean = PDF(level_offset(base_size(), top_level(base_size())));
  if (!(mean > 0.0)) {  // a PDF that is zero everywhere gives no lights
    lights[i] = no_light();
    squares[i] = vec4(0.0);
    return;
  }
  // 1. Centre.
  uvec2 texel = choose_texel(i);
  Centre c = Centre(vec2(texel) + 0.5, PDF(texel.y * width + texel.x) / mean, 1.0 / mean);
  // 2. Size of the footprint.  3. Total of the RSM values within it.
  float level = footprint_level(c);
  float share = footprint_share(c, level) * texel_count();  // stored powers are per texel
  lights[i] = make_vsgl(filtered_moments(c, level), share, level);
  squares[i] = vec4(c.position, exp2(level), 0.0);
}
