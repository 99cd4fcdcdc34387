// The pass core/reuse/spatial.glsl over paths (shift.glsl).
#include "integrators/restir_pt/shift.glsl"
#include "core/reuse/spatial.glsl"
