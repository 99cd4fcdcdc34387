// Bounds of a grid of samples and of its derivatives over a box.
//
// Within a cell the value is linear along each axis, so that its bounds over a box are those of the
// box's corners, and so are those of its derivatives. Over many cells the bounds of blocks are
// kept.

RL_FN vec2 fieldJoin(RL_IN(vec2) a, float x) { return vec2(min(a.x, x), max(a.y, x)); }

// Bounds over a box in a cell.
RL_FN FieldBounds fieldBoundsInCell(RL_IN(FieldCell) c, RL_IN(vec3) from, RL_IN(vec3) to) {
  vec2 none = vec2(3.0e38f, -3.0e38f);
  vec2 value = none;
  vec2 dx = none;
  vec2 dy = none;
  vec2 dz = none;
  vec4 rise = c.high - c.low;
  for (uint i = 0u; i < 2u; i = i + 1u) {
    vec4 v = c.low + rise * (i == 0u ? from.z : to.z);
    vec2 slopes = vec2(v.y - v.x, v.w - v.z);  // along x, at the low y and the high one
    dx = fieldJoin(dx, slopes.x + (slopes.y - slopes.x) * from.y);
    dx = fieldJoin(dx, slopes.x + (slopes.y - slopes.x) * to.y);
    for (uint j = 0u; j < 2u; j = j + 1u) {
      float x = j == 0u ? from.x : to.x;
      float low = v.x + slopes.x * x;
      float slope = v.z + slopes.y * x - low;
      dy = fieldJoin(dy, slope);
      value = fieldJoin(value, low + slope * from.y);
      value = fieldJoin(value, low + slope * to.y);
    }
    float atX = i == 0u ? from.x : to.x;
    float rise0 = rise.x + (rise.y - rise.x) * atX;
    float rise1 = rise.z + (rise.w - rise.z) * atX;
    dz = fieldJoin(dz, rise0 + (rise1 - rise0) * from.y);
    dz = fieldJoin(dz, rise0 + (rise1 - rise0) * to.y);
  }
  vec4 most = max(abs(c.low), abs(c.high));
  float error = RL_FIELD_GRID_ERROR * max(max(most.x, most.y), max(most.z, most.w));
  FieldBounds b;
  b.valueX = vec4(value.x - error, value.y + error, dx.x - error, dx.y + error);
  b.rest = vec4(dy.x - error, dy.y + error, dz.x - error, dz.y + error);
  return b;
}

// Bounds of a block that is kept.
RL_FN FieldBounds fieldBlock(uint at) {
  uvec4 q0 = RL_SCENE_UVEC4(gScene.shapeWords, at);
  uvec4 q1 = RL_SCENE_UVEC4(gScene.shapeWords, at + 1u);
  FieldBounds b;
  b.valueX = vec4(uintBitsToFloat(q0.x), uintBitsToFloat(q0.y), uintBitsToFloat(q0.z),
                  uintBitsToFloat(q0.w));
  b.rest = vec4(uintBitsToFloat(q1.x), uintBitsToFloat(q1.y), uintBitsToFloat(q1.z),
                uintBitsToFloat(q1.w));
  return b;
}

RL_FN FieldBounds fieldBoth(RL_IN(FieldBounds) a, RL_IN(FieldBounds) b) {
  FieldBounds all;
  all.valueX = vec4(min(a.valueX.x, b.valueX.x), max(a.valueX.y, b.valueX.y),
                    min(a.valueX.z, b.valueX.z), max(a.valueX.w, b.valueX.w));
  all.rest = vec4(min(a.rest.x, b.rest.x), max(a.rest.y, b.rest.y), min(a.rest.z, b.rest.z),
                  max(a.rest.w, b.rest.w));
  return all;
}

// Bounds over a box, in cells from the grid's corner: of the cells that it touches where they are
// two along each axis at most, else of two blocks along each axis.
RL_FN FieldBounds fieldGridBounds(RL_IN(FieldGrid) g, RL_IN(vec3) from, RL_IN(vec3) to) {
  uvec3 low = fieldCellAt(g, from);
  uvec3 high = fieldCellAt(g, to);
  uvec3 count = g.cells;
  uint blocks = g.blocks;
  uint level = 0u;
  while (max(high.x - low.x, max(high.y - low.y, high.z - low.z)) > 1u) {
    if (level > 0u) blocks = blocks + 2u * count.x * count.y * count.z;
    level = level + 1u;
    count = (count + uvec3(1u, 1u, 1u)) / uvec3(2u, 2u, 2u);
    low = low / uvec3(2u, 2u, 2u);
    high = high / uvec3(2u, 2u, 2u);
  }
  FieldBounds all;
  all.valueX = vec4(3.0e38f, -3.0e38f, 3.0e38f, -3.0e38f);
  all.rest = all.valueX;
  for (uint z = low.z; z <= high.z; z = z + 1u) {
    for (uint y = low.y; y <= high.y; y = y + 1u) {
      for (uint x = low.x; x <= high.x; x = x + 1u) {
        if (level > 0u) {
          all = fieldBoth(all, fieldBlock(blocks + 2u * ((z * count.y + y) * count.x + x)));
        } else {
          uvec3 cell = uvec3(x, y, z);
          vec3 corner = vec3(cell);
          vec3 one = vec3(1.0f, 1.0f, 1.0f);
          vec3 zero = vec3(0.0f, 0.0f, 0.0f);
          all = fieldBoth(all,
                          fieldBoundsInCell(fieldCellOf(g, cell), clamp(from - corner, zero, one),
                                            clamp(to - corner, zero, one)));
        }
      }
    }
  }
  return all;
}

// A derivative along an axis, with 0 where the place lies beyond the box: below is < 0 or above is
// > 0.
RL_FN vec2 fieldUnlessBeyond(RL_IN(vec2) slope, float below, float above) {
  if (above < 0.0f || below > 0.0f) return vec2(0.0f, 0.0f);
  if (below < 0.0f || above > 0.0f) return vec2(min(slope.x, 0.0f), max(slope.y, 0.0f));
  return slope;
}

// The shorter and the longer way from 0 to [a, b], squared.
RL_FN vec2 fieldWays(float a, float b) {
  float least = a > 0.0f ? a : b < 0.0f ? b : 0.0f;
  float most = max(abs(a), abs(b));
  return vec2(least * least, most * most);
}

// Bounds of fieldGridSlope() for places x, y, z, each (least, largest, of the derivative).
RL_FN_OUTLINE vec4 fieldGridRange(uint first, RL_IN(vec4) x, RL_IN(vec4) y, RL_IN(vec4) z) {
  FieldGrid g = fieldGridOf(first);
  vec3 low = vec3(x.x, y.x, z.x);
  vec3 high = vec3(x.y, y.y, z.y);
  vec3 below = low - clamp(low, g.low, g.high);
  vec3 above = high - clamp(high, g.low, g.high);
  low = (low - g.low) * g.scale;
  high = (high - g.low) * g.scale;
  // Places in the grid are rounded.
  vec3 zero = vec3(0.0f, 0.0f, 0.0f);
  vec3 least = vec3(1.0e-7f, 1.0e-7f, 1.0e-7f);
  low = clamp(low - abs(low) * RL_FIELD_ROUNDING - least, zero, vec3(g.cells));
  high = clamp(high + abs(high) * RL_FIELD_ROUNDING + least, zero, vec3(g.cells));
  FieldBounds b = fieldGridBounds(g, low, high);
  vec2 dx = fieldUnlessBeyond(vec2(b.valueX.z, b.valueX.w), below.x, above.x);
  vec2 dy = fieldUnlessBeyond(vec2(b.rest.x, b.rest.y), below.y, above.y);
  vec2 dz = fieldUnlessBeyond(vec2(b.rest.z, b.rest.w), below.z, above.z);
  vec2 v = vec2(b.valueX.x, b.valueX.y);
  vec2 d = fieldProduct(dx * g.scale.x, vec2(x.z, x.w));
  d = fieldSum(d, fieldProduct(dy * g.scale.y, vec2(y.z, y.w)));
  d = fieldSum(d, fieldProduct(dz * g.scale.z, vec2(z.z, z.w)));
  if (below == zero && above == zero) return vec4(v.x, v.y, d.x, d.y);
  vec2 ways =
      fieldWays(below.x, above.x) + fieldWays(below.y, above.y) + fieldWays(below.z, above.z);
  v = fieldSum(v, fieldWidenCoarsely(sqrt(ways)));
  // The distance changes at most by the way.
  vec3 way = max(abs(vec3(x.z, y.z, z.z)), abs(vec3(x.w, y.w, z.w)));
  float steepest = sqrt(dot(way, way)) * 1.000001f;
  d = fieldSum(d, vec2(-steepest, steepest));
  return vec4(v.x, v.y, d.x, d.y);
}
