// The initial candidate of restir_pt. Every vertex up to the pair that connects gives its light
// samples and the emitters that it found, each a path of its own; light beyond x3 is one candidate.
// The light in view is left out.
#include "integrators/restir_pt/sample.glsl"
#include "core/radiance_cache/termination.glsl"
#include "core/path_sample/path_record.glsl"
#include "core/path_sample/path_resample.glsl"
#include "core/path_sample/sample_initial.glsl"
