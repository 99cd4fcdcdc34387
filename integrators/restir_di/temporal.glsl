// The pass core/reuse/temporal.glsl over points of lights (sample.glsl).
#include "integrators/restir_di/sample.glsl"
#include "core/reuse/temporal.glsl"
