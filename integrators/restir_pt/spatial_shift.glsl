// The pass core/reuse/spatial_shift.glsl over paths (shift.glsl).
#include "integrators/restir_pt/shift.glsl"
#include "core/reuse/spatial_shift.glsl"
