// The initial candidate of restir_pt: every light sample and every emitter that the pixel's path
// found beyond the light in view, each a path of its own.
#include "integrators/restir_pt/sample.glsl"
#include "core/radiance_cache/termination.glsl"
#include "core/path_sample/path_record.glsl"
#include "core/path_sample/path_resample.glsl"
#include "core/path_sample/sample_initial.glsl"
