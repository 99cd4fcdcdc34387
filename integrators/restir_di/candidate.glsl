// The initial candidate of restir_di: light samples at x1 and the light that its BSDF sample met.
// The path goes on as `path` does. Its light by x2 is unresampled, as that of mirrors is.
#include "integrators/restir_di/sample.glsl"
#include "core/radiance_cache/termination.glsl"
#include "core/path_sample/path_record.glsl"
#include "core/path_sample/path_resample.glsl"
#include "core/path_sample/sample_initial.glsl"
