// Modified filtered importance sampling: the footprint holds the same probability everywhere [MFIS16].
#version 460
#include "types.h"
#include "filtered_sampling.glsl"
#include "equal_probability.glsl"
