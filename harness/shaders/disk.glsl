// The disk that a VSGL is seen as from a surface [VSGL14 §3.1].
#ifndef VSGLBENCH_DISK_GLSL
#define VSGLBENCH_DISK_GLSL

// r² = 2σ² of the variance in three dimensions [VSGL14 §3.2], which is no smaller than λ_σ = d²/σ² <= 2^41
// asks for: nothing overflows.
float disk_radius2(float variance, float distance2) { return 2.0 * max(variance, distance2 * 4.5474735e-13); }

// |Ω|/(πr²) = 2(1-cosθ)/r² with cosθ = d/√(d²+r²), without its cancellation, 1/m².
float solid_angle_over_area(float distance, float radius2) {
  float h = sqrt(distance * distance + radius2);
  return 2.0 / (h * (h + distance));
}

// Of a disk across `normal`, seen from `height` > 0 above its plane: the mean of ω cosθ_v/d² over its points,
// ω towards the point, d its distance, θ_v from the normal to the surface, 1/m². It is the vector irradiance
// of that disk of radiance 1/(πr²), whose components along the normal and across it are the form factors of
// a plane element that is parallel to the disk and of one that stands upright; closed:
//   ½(1-(d²-r²)/S)/r²  and  ½ h/ρ ((d²+r²)/S-1)/r²,  S² = (d²+r²)²-4r²ρ² = (d²-r²)²+4r²h²,  d² = h²+ρ²,
// here without their cancellation.
vec3 disk_flow(vec3 to_centre, float distance2, vec3 normal, float height, float radius2) {
  float difference = distance2 - radius2;
  float s = max(sqrt(difference * difference + 4.0 * radius2 * height * height), 1e-18);
  float far = s + abs(difference);
  bool outside = difference > 0.0;
  float down = (outside ? 2.0 * height * height : 0.5 * far) / ((outside ? far : radius2) * s);
  float along = 2.0 * height / ((distance2 + radius2 + s) * s);
  return along * to_centre + (height * along - down) * normal;
}

// The mean of cosθ_v max(cosθ_x,0)/d² over the disk's points, 1/m², θ_x from the surface's normal. `rise` is
// how far the disk's centre is above the surface's horizon, as a part of how far its rim reaches up and down
// from there. Where the horizon doesn't cut the disk this is flow·n. Where it does, what is lost below adds
// to that: five eighths of what Hill and Heitz (2016, "Real-Time Area Lighting") add, (l²+z)/(l+1) of a
// sphere of the same vector irradiance, which is too much for a disk by a third. It fades out in the quarters
// next to rise = 0 and 1, so that it doesn't jump as a light's mean sets; flow·n still does where the disk is
// turned towards the surface.
float above_horizon(vec3 flow, vec3 normal, float radius2, float rise) {
  float magnitude = length(flow);
  float form_factor = min(magnitude * radius2, 1.0);
  float facing = dot(flow, normal), uncut = max(facing, 0.0);
  float sphere = max(form_factor * magnitude + facing, 0.0) / (form_factor + 1.0);
  float share = 0.625 * clamp(4.0 * min(rise, 1.0 - rise), 0.0, 1.0);
  return mix(uncut, sphere, share);
}

#endif
