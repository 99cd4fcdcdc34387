// The pass core/reuse/light_edges.glsl over paths.
#include "integrators/restir_pt/sample.glsl"
#include "core/path_sample/path_in_view.glsl"
#include "core/reuse/light_edges.glsl"
