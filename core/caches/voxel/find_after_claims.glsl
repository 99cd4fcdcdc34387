#include "core/caches/voxel/cell.glsl"
#include "core/caches/entries/find_after_claims.glsl"
