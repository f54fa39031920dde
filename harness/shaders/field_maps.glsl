// The deferred targets of a half, which the host binds first and together (FieldMaps); what else a kernel
// binds comes from AFTER_MAPS on.
layout(set = 0, binding = 0) uniform sampler2D position_map;   // xyz, w = 1 where there is a surface
layout(set = 0, binding = 1) uniform sampler2D normal_map;     // shading normal, ndf
layout(set = 0, binding = 2) uniform sampler2D geometric_map;  // geometric normal
layout(set = 0, binding = 3) uniform sampler2D diffuse_map;    // Rd
layout(set = 0, binding = 4) uniform sampler2D f0_map;         // F0
#define AFTER_MAPS 5
