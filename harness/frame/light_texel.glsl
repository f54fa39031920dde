// The RSM texel at a light's mean, and the flux behind the power that the light reflects. The including file
// has `emitter`, the RSM's, and field.glsl.
#ifndef VSGLBENCH_LIGHT_TEXEL_GLSL
#define VSGLBENCH_LIGHT_TEXEL_GLSL

// Texel that `position` falls into.
ivec2 texel_of(vec3 position) {
  vec3 d = position - emitter.position;
  float along = emitter.perspective != 0u ? max(dot(d, emitter.forward), 1e-20) : 1.0;
  vec2 plane = vec2(dot(d, emitter.right), dot(d, emitter.up)) / (along * emitter.extent);
  ivec2 size = ivec2(emitter.width, emitter.height);
  return clamp(ivec2((vec2(0.5) + vec2(0.5, -0.5) * plane) * vec2(size)), ivec2(0), size - 1);
}

// Φ of a light of this reflected power; 0 where the texel reflects nothing.
vec3 flux_behind(vec3 reflected, vec3 reflectance) {
  return mix(vec3(0.0), reflected / max(reflectance, vec3(1e-20)), greaterThan(reflectance, vec3(0.0)));
}

#endif
