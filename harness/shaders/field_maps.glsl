// The deferred targets of a half, which the host binds first and together (FieldMaps); what else a kernel
// binds comes from AFTER_MAPS on. A map that SURFACE_LOBES or FACE_NORMALS leaves out (types.h) does not
// exist.
#ifndef VSGLBENCH_FIELD_MAPS_GLSL
#define VSGLBENCH_FIELD_MAPS_GLSL

#include "types.h"

#define GEOMETRIC_MAPS (FACE_NORMALS == 1 ? 0 : 1)
#define DIFFUSE_MAPS ((SURFACE_LOBES & DIFFUSE_LOBE) != 0 ? 1 : 0)
#define F0_MAPS ((SURFACE_LOBES & SPECULAR_LOBE) != 0 ? 1 : 0)
layout(set = 0, binding = 0) uniform sampler2D position_map;  // xyz, w = 1 where there is a surface
layout(set = 0, binding = 1) uniform sampler2D normal_map;    // shading normal, or the face's; w: ndf
#if FACE_NORMALS == 0
layout(set = 0, binding = 2) uniform sampler2D geometric_map;  // geometric normal
#endif
#if SURFACE_LOBES & DIFFUSE_LOBE
layout(set = 0, binding = 2 + GEOMETRIC_MAPS) uniform sampler2D diffuse_map;  // Rd
#endif
#if SURFACE_LOBES & SPECULAR_LOBE
layout(set = 0, binding = 2 + GEOMETRIC_MAPS + DIFFUSE_MAPS) uniform sampler2D f0_map;  // F0
#endif
#define AFTER_MAPS (2 + GEOMETRIC_MAPS + DIFFUSE_MAPS + F0_MAPS)

#endif
