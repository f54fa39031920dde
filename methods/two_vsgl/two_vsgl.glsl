// Sums of many sets of VPLs: of their diffuse lobes alone, and of their specular ones; each sum with the mean
// and the variance of its own lobes' positions.
#include "types.h"
layout(local_size_x = 64) in;

const uint kFan = 64u;

struct Pair {
  Moments diffuse, specular;
};
