#include "integrators/restir_gi/sample.glsl"
#include "core/reuse/spatial_shift.glsl"
