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

#endif
