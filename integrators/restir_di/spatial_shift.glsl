// The pass core/reuse/spatial_shift.glsl over points of lights (sample.glsl).
#include "integrators/restir_di/sample.glsl"
#include "core/reuse/spatial_shift.glsl"
