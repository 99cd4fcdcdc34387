#include "core/caches/voxel/cell.glsl"
#include "core/caches/entries/find.glsl"
