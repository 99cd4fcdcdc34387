// The initial candidate of restir_gi: the path of a film sample, as one reservoir.
#include "integrators/restir_gi/sample.glsl"
#include "core/radiance_cache/termination.glsl"
#include "core/path_sample/path_record.glsl"
#include "core/path_sample/path_resample.glsl"
#include "core/path_sample/sample_initial.glsl"
