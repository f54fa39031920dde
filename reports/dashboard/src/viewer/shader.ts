// One triangle over the pane; every fragment finds its pixel of the picture.
export const VERTEX = `#version 300 es
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }
`;

export const KINDS = { colour: 0, luminance: 1, signed: 2, smape: 3, png: 4 } as const;

export const FRAGMENT = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
uniform sampler2D x0, r0, x1, r1, ramps;
uniform ivec2 size;
uniform ivec2 kinds;
uniform vec2 origin;   // of the picture, in device pixels from the canvas's left lower corner
uniform float zoom;    // device pixels a pixel
uniform vec3 line;     // the second layer lies where line.xy * p >= line.z
uniform float exposure, range;
uniform vec2 stops;    // of false colours
uniform vec3 noSurface, notFinite;
out vec4 color;

bool isBad(vec3 v) { return any(equal(floatBitsToUint(v) & 0x7f800000u, uvec3(0x7f800000u))); }
float luminance(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }
float symmetric(float x, float r) {
  float sum = abs(x) + abs(r);
  return sum > 0.0 ? (x - r) / (0.5 * sum) : 0.0;
}
vec3 encode(vec3 c) {
  vec3 v = clamp(c, 0.0, 1.0);
  return mix(1.055 * pow(v, vec3(1.0 / 2.4)) - 0.055, 12.92 * v, lessThanEqual(v, vec3(0.0031308)));
}
// Row 0 is for what grows from 0, row 1 for what has two signs.
vec3 ramp(float t, float row) { return textureLod(ramps, vec2((0.5 + 255.0 * clamp(t, 0.0, 1.0)) / 256.0, (row + 0.5) / 2.0), 0.0).rgb; }

// What is averaged where the picture is made smaller; a: coverage, below 0 where the value is not finite.
vec4 value(sampler2D x, sampler2D r, int kind, ivec2 at) {
  vec4 a = texelFetch(x, at, 0);
  if (kind == 4) return vec4(a.rgb, 1.0);
  if (isBad(a.rgb)) return vec4(0.0, 0.0, 0.0, -1e9);
  if (kind == 0) return vec4(a.rgb, 1.0);
  if (kind == 1) return vec4(luminance(a.rgb), 0.0, 0.0, 1.0);
  vec4 b = texelFetch(r, at, 0);
  if (isBad(b.rgb)) return vec4(0.0, 0.0, 0.0, -1e9);
  if (b.a == 0.0) return vec4(0.0);
  if (kind == 2) return vec4(symmetric(luminance(a.rgb), luminance(b.rgb)), 0.0, 0.0, 1.0);
  float sum = 0.0;
  for (int c = 0; c < 3; ++c) sum += abs(symmetric(a[c], b[c]));
  return vec4(sum / 3.0, 0.0, 0.0, 1.0);
}

vec3 shade(sampler2D x, sampler2D r, int kind, vec2 pixel) {
  int n = clamp(int(ceil(1.0 / zoom - 0.01)), 1, 8);
  float side = 1.0 / zoom;
  vec4 sum = vec4(0.0);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      vec2 at = n == 1 ? pixel : pixel + side * ((vec2(i, j) + 0.5) / float(n) - 0.5);
      sum += value(x, r, kind, clamp(ivec2(floor(at)), ivec2(0), size - 1));
    }
  if (sum.a < 0.0) return notFinite;
  if (sum.a == 0.0) return noSurface;
  vec3 v = sum.rgb / sum.a;
  if (kind == 4) return v;
  if (kind == 0) return encode(exposure * v);
  if (kind == 1) return ramp(v.r * exposure > 0.0 ? (log2(v.r * exposure) - stops.x) / (stops.y - stops.x) : 0.0, 0.0);
  if (kind == 2) return ramp(0.5 + 0.5 * v.r / range, 1.0);
  return ramp(v.r / range, 0.0);
}

void main() {
  vec2 p = gl_FragCoord.xy;
  vec2 pixel = vec2(p.x - origin.x, origin.y - p.y) / zoom;
  if (any(lessThan(pixel, vec2(0.0))) || any(greaterThanEqual(pixel, vec2(size)))) color = vec4(0.0);
  else if (dot(line.xy, p) >= line.z) color = vec4(shade(x1, r1, kinds.y, pixel), 1.0);
  else color = vec4(shade(x0, r0, kinds.x, pixel), 1.0);
}
`;
