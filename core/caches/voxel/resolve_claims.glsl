#include "core/caches/voxel/cell.glsl"
#include "core/caches/entries/resolve_claims.glsl"
