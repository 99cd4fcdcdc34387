#include "core/caches/voxel/cell.glsl"
#include "core/caches/entries/insertions.glsl"
