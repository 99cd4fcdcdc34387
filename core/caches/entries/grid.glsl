// Hash grid in space: cubes whose side is a power of two of metres, near a number of pixels where
// they are seen. A cell's entry lies in one of `probes` hash slots from its hash on. A whole key of
// 63 bits identifies the cell, so that no cell is taken for another.

// Level of the largest cell whose side is at most `side`: exponent of the cell's side, with the
// bias of floats.
RL_FN uint gridLevel(float side) { return (floatBitsToUint(side) >> 23u) & 0xffu; }
RL_FN float gridSide(uint level) { return uintBitsToFloat(level << 23u); }

// Width of a pixel where a point is seen, in metres.
RL_FN float gridPixel(RL_IN(vec3) posW) {
  bool isParallel = gFrame.camera.kind == RL_CAMERA_ORTHOGRAPHIC;
  float away = isParallel ? 1.0f : distance(posW, gFrame.camera.posW);
  return away * (2.0f * gFrame.camera.halfWidth / float(gFrame.width));
}

RL_FN uint gridOctant(RL_IN(vec3) normalW) {
  float least = -RL_GRID_OFF_NORMAL;
  return (normalW.x < least ? 1u : 0u) | (normalW.y < least ? 2u : 0u) |
         (normalW.z < least ? 4u : 0u);
}

// Key of a cell. `kind`: 3 bits that the cache chooses. Zero, which is never a cell's key, if the
// position is NaN or beyond 2^16 cells from the origin. No branch: a condition must not depend on
// many numbers of the frame and of parameters alone (docs/dialect.md).
RL_FN uvec2 gridKey(RL_IN(vec3) posW, uint level, uint kind) {
  float inverse = 1.0f / gridSide(level);
  vec3 at = posW * inverse + vec3(RL_GRID_OFF, RL_GRID_OFF, RL_GRID_OFF);
  vec3 cell = vec3(floor(at.x), floor(at.y), floor(at.z));
  float most = max(abs(cell.x), max(abs(cell.y), abs(cell.z)));
  bool isNear = rlIsFinite3(cell) && most < 65535.0f && level != 0u && level < 254u;
  vec3 inside = isNear ? cell : vec3(0.0f, 0.0f, 0.0f);
  uint x = uint(int(inside.x) + 65536);
  uint y = uint(int(inside.y) + 65536);
  uint z = uint(int(inside.z) + 65536);
  uint low = RL_GRID_TAKEN | (kind << 28u) | (level << 20u) | (x << 3u) | (y & 7u);
  return isNear ? uvec2(low, ((y >> 3u) << 17u) | z) : uvec2(0u, 0u);
}

RL_FN void gridTake(RL_IN(UintRef) keys, uint entry, RL_IN(uvec2) key) {
  keys.data[2u * entry] = key.x;
  keys.data[2u * entry + 1u] = key.y;
}

RL_FN uint gridPlace(RL_IN(GridParams) grid, RL_IN(uvec2) key, uint probe) {
  return (rngHash(rngHash(key.x) ^ key.y) + probe) % grid.places;
}

// Finds the entry of a cell; RL_INVALID if there is none, and for the key zero. Hash slots are
// filled in the order of probes and never freed: the search ends at the first empty one.
RL_FN uint gridFind(RL_IN(GridParams) grid, RL_IN(UintRef) keys, RL_IN(uvec2) key) {
  for (uint i = 0u; i < grid.probes; i = i + 1u) {
    uint entry = gridPlace(grid, key, i);
    uint first = keys.data[2u * entry];
    if (first == 0u) return RL_INVALID;
    if (first == key.x && keys.data[2u * entry + 1u] == key.y) return entry;
  }
  return RL_INVALID;
}
