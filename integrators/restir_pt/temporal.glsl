// The pass core/reuse/temporal.glsl over paths (shift.glsl).
#include "integrators/restir_pt/shift.glsl"
#include "core/reuse/temporal.glsl"
