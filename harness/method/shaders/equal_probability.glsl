// Footprints that hold the same probability everywhere [MFIS16 §3.2, §4.2]: footprint_level() and
// footprint_share() of filtered_sampling.glsl, which is included before.

// Solves 4^l/M p̄(x,l) = K/N by bisection [MFIS16 Eq. 3, Alg. 1], 12 steps as in the paper. Between two
// levels of the pyramid p̄(x,l) is linear, so that all steps between the same two read the pyramid once: about
// 5 times, not 12.
float footprint_level(Centre c) {
  uint top = top_level(base_size());
  float lo = 0.0, hi = float(top);
  for (int k = 0; k < 12;) {
    uint below = uint(0.5 * (lo + hi));
    float p_below = pdf_on_level(c, below), p_above = pdf_on_level(c, min(below + 1u, top));
    for (bool between = true; between && k < 12; ++k) {
      float level = 0.5 * (lo + hi);
      float p = mix(p_below, p_above, level - float(below));
      bool is_less = footprint_area(level) * p < footprint_size / float(count);
      lo = is_less ? level : lo;
      hi = is_less ? hi : level;
      between = uint(0.5 * (lo + hi)) == below;
    }
  }
  // Unlike Alg. 1: where even one texel holds more than K/N, stay on it (the bisection's own end would be
  // half a step above 0, which blends in a 2^-13th of the neighbours).
  return hi * 4096.0 <= 1.5 * float(top_level(base_size())) ? 0.0 : 0.5 * (lo + hi);
}

// f̄/(N p̄(x,l)) [MFIS16 Eq. 5].
float footprint_share(Centre c, float level) {
  float p = filtered_pdf(c, level);
  return p > 0.0 ? 1.0 / (float(count) * p) : 0.0;
}
