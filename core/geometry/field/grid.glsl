// Grids of samples, between which a value is linear along each axis in turn.

RL_FN FieldGrid fieldGridOf(uint first) {
  uvec4 q0 = RL_SCENE_UVEC4(gScene.shapeWords, first);
  uvec4 q1 = RL_SCENE_UVEC4(gScene.shapeWords, first + 1u);
  uvec4 q2 = RL_SCENE_UVEC4(gScene.shapeWords, first + 2u);
  FieldGrid g;
  g.low = vec3(uintBitsToFloat(q0.x), uintBitsToFloat(q0.y), uintBitsToFloat(q0.z));
  g.scale = vec3(uintBitsToFloat(q1.x), uintBitsToFloat(q1.y), uintBitsToFloat(q1.z));
  g.high = vec3(uintBitsToFloat(q2.x), uintBitsToFloat(q2.y), uintBitsToFloat(q2.z));
  g.cells = uvec3(q0.w - 1u, q1.w - 1u, q2.w - 1u);
  g.samples = first + RL_FIELD_GRID_HEADER;
  g.blocks = g.samples + (q0.w * q1.w * q2.w + 3u) / 4u;
  return g;
}

RL_FN float fieldSample(RL_IN(FieldGrid) g, uint i) {
  uvec4 q = RL_SCENE_UVEC4(gScene.shapeWords, g.samples + (i >> 2u));
  uint lane = i & 3u;
  return uintBitsToFloat(lane == 0u ? q.x : lane == 1u ? q.y : lane == 2u ? q.z : q.w);
}

RL_FN FieldCell fieldCellOf(RL_IN(FieldGrid) g, RL_IN(uvec3) at) {
  uint row = g.cells.x + 1u;
  uint layer = row * (g.cells.y + 1u);
  uint i = at.z * layer + at.y * row + at.x;
  uint j = i + layer;
  FieldCell c;
  c.low = vec4(fieldSample(g, i), fieldSample(g, i + 1u), fieldSample(g, i + row),
               fieldSample(g, i + row + 1u));
  c.high = vec4(fieldSample(g, j), fieldSample(g, j + 1u), fieldSample(g, j + row),
                fieldSample(g, j + row + 1u));
  return c;
}

// (derivatives, value) at a place in a cell, its edges being 1.
RL_FN vec4 fieldInCell(RL_IN(FieldCell) c, RL_IN(vec3) at) {
  vec4 rise = c.high - c.low;
  vec4 v = c.low + rise * at.z;
  float low = v.x + (v.y - v.x) * at.x;
  float high = v.z + (v.w - v.z) * at.x;
  float dx = (v.y - v.x) + ((v.w - v.z) - (v.y - v.x)) * at.y;
  float dzLow = rise.x + (rise.y - rise.x) * at.x;
  float dzHigh = rise.z + (rise.w - rise.z) * at.x;
  return vec4(dx, high - low, dzLow + (dzHigh - dzLow) * at.y, low + (high - low) * at.y);
}

// The cell of a place that is given in cells from the grid's corner.
RL_FN uvec3 fieldCellAt(RL_IN(FieldGrid) g, RL_IN(vec3) at) {
  return min(uvec3(at), g.cells - uvec3(1u, 1u, 1u));
}

// Value and derivative along a direction. Beyond the box the value is that of the nearest place in
// it and the distance to that.
RL_FN_OUTLINE vec2 fieldGridSlope(uint first, RL_IN(vec3) at, RL_IN(vec3) dir) {
  FieldGrid g = fieldGridOf(first);
  vec3 inGrid = (at - g.low) * g.scale;
  vec3 nearest = clamp(inGrid, vec3(0.0f, 0.0f, 0.0f), vec3(g.cells));
  uvec3 cell = fieldCellAt(g, nearest);
  vec4 v = fieldInCell(fieldCellOf(g, cell), nearest - vec3(cell));
  vec3 along = dir * g.scale;
  vec3 beyond = at - clamp(at, g.low, g.high);
  if (beyond.x != 0.0f) along.x = 0.0f;
  if (beyond.y != 0.0f) along.y = 0.0f;
  if (beyond.z != 0.0f) along.z = 0.0f;
  float away = sqrt(dot(beyond, beyond));
  return vec2(v.w + away,
              v.x * along.x + v.y * along.y + v.z * along.z + rlSafeDivide(dot(beyond, dir), away));
}
