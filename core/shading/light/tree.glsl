// The choice of a lamp that knows the receiver: at each node of a hierarchy, a part with the
// probability of its importance, a bound on what its lamps can send (Conty Estevez and Kulla 2018,
// section 4). The probability of a lamp is that of the parts that lead to it, and exact.

RL_FN vec4 lightNodeFloats(uint node, uint row) {
  return recordVec4(RL_SCENE_UVEC4(gScene.lightTree, node * RL_LIGHT_NODE_UVEC4S + row));
}

RL_FN vec4 lightSine(RL_IN(vec4) cosine) {
  vec4 one = vec4(1.0f, 1.0f, 1.0f, 1.0f);
  return sqrt(max(one - cosine * cosine, vec4(0.0f, 0.0f, 0.0f, 0.0f)));
}

// cos(max(a - b, 0)) for angles in [0, pi].
RL_FN vec4 lightCosineBeyond(RL_IN(vec4) cosA, RL_IN(vec4) sinA, RL_IN(vec4) cosB,
                             RL_IN(vec4) sinB) {
  vec4 one = vec4(1.0f, 1.0f, 1.0f, 1.0f);
  return mix(cosA * cosB + sinA * sinB, one, step(cosB, cosA));
}

RL_FN vec4 lightUnpackCosines(RL_IN(uvec4) words, uint shift) {
  vec4 one = vec4(1.0f, 1.0f, 1.0f, 1.0f);
  vec4 values = vec4(float((words.x >> shift) & 0xffffu), float((words.y >> shift) & 0xffffu),
                     float((words.z >> shift) & 0xffffu), float((words.w >> shift) & 0xffffu));
  return values * (1.0f / 32767.0f) - one;
}

// Importance of a node's four parts for a receiver: 0 only where none of their lamps can send light
// there. Cosines have slack, so that rounding loses no lamp. Without branches: machines compute the
// four at once.
RL_FN vec4 lightNodeImportance(uint node, RL_IN(LightReceiver) receiver) {
  vec4 lowX = lightNodeFloats(node, 0u);
  vec4 lowY = lightNodeFloats(node, 1u);
  vec4 lowZ = lightNodeFloats(node, 2u);
  vec4 highX = lightNodeFloats(node, 3u);
  vec4 highY = lightNodeFloats(node, 4u);
  vec4 highZ = lightNodeFloats(node, 5u);
  vec4 extentX = 0.5f * (highX - lowX);
  vec4 extentY = 0.5f * (highY - lowY);
  vec4 extentZ = 0.5f * (highZ - lowZ);
  vec4 one = vec4(1.0f, 1.0f, 1.0f, 1.0f);
  vec4 dx = 0.5f * (lowX + highX) - receiver.posW.x * one;
  vec4 dy = 0.5f * (lowY + highY) - receiver.posW.y * one;
  vec4 dz = 0.5f * (lowZ + highZ) - receiver.posW.z * one;
  vec4 r2 = extentX * extentX + extentY * extentY + extentZ * extentZ;
  vec4 d2 = dx * dx + dy * dy + dz * dz;
  vec4 tiny = 1.0e-30f * one;
  vec4 inverse = one / sqrt(max(d2, tiny));
  // Half the angle under which the receiver sees the box, at most.
  vec4 sinBox = min(sqrt(r2) * inverse, one);
  vec4 cosBox = lightSine(sinBox);
  uvec4 cones = RL_SCENE_UVEC4(gScene.lightTree, node * RL_LIGHT_NODE_UVEC4S + 10u);
  vec4 cosSpread = lightUnpackCosines(cones, 0u);
  vec4 cosLeaves = -(lightNodeFloats(node, 7u) * dx + lightNodeFloats(node, 8u) * dy +
                     lightNodeFloats(node, 9u) * dz) *
                   inverse;
  cosLeaves = clamp(cosLeaves, -one, one);
  cosLeaves = lightCosineBeyond(cosLeaves, lightSine(cosLeaves), cosSpread, lightSine(cosSpread));
  cosLeaves = lightCosineBeyond(cosLeaves, lightSine(cosLeaves), cosBox, sinBox);
  vec4 slack = 1.0e-3f * one;
  vec4 leaves = step(lightUnpackCosines(cones, 16u) - slack, cosLeaves) * max(cosLeaves, slack);
  vec4 cosArrives =
      (receiver.normalW.x * dx + receiver.normalW.y * dy + receiver.normalW.z * dz) * inverse;
  if (receiver.isTwoSided != 0u) cosArrives = abs(cosArrives);
  cosArrives = clamp(cosArrives, -one, one);
  cosArrives = lightCosineBeyond(cosArrives, lightSine(cosArrives), cosBox, sinBox);
  vec4 arrives = step(-slack, cosArrives) * max(cosArrives, slack);
  // Inside of the sphere around a box nothing is known.
  vec4 factor = mix(leaves * arrives, one, step(d2, r2));
  return lightNodeFloats(node, 6u) * factor / max(max(d2, r2), tiny);
}

// At least 256 of 2^32 for a part that can send light: every lamp in reach has a probability.
RL_FN uint lightShareBits(float importance, float scale) {
  return importance > 0.0f ? uint(importance * scale) + 256u : 0u;
}

RL_FN LightTurn lightTurn(uint node, RL_IN(LightReceiver) receiver) {
  vec4 importance = lightNodeImportance(node, receiver);
  LightTurn turn;
  turn.last = RL_INVALID;
  if (importance.x > 0.0f) turn.last = 0u;
  if (importance.y > 0.0f) turn.last = 1u;
  if (importance.z > 0.0f) turn.last = 2u;
  if (importance.w > 0.0f) turn.last = 3u;
  // Leaves room for the shares of 256 and for rounding.
  float total = importance.x + importance.y + importance.z + importance.w;
  float scale = rlSafeDivide(4294963200.0f, total);
  uint x = lightShareBits(importance.x, scale);
  uint y = lightShareBits(importance.y, scale);
  uint z = lightShareBits(importance.z, scale);
  turn.bounds.x = turn.last == 0u ? 0u : x;
  turn.bounds.y = turn.bounds.x + (turn.last == 1u ? 0u : y);
  turn.bounds.z = turn.bounds.y + (turn.last == 2u ? 0u : z);
  return turn;
}

RL_FN uint lightTurnPart(RL_IN(LightTurn) turn, uint bits) {
  if (bits < turn.bounds.x) return 0u;
  if (bits < turn.bounds.y) return 1u;
  if (bits < turn.bounds.z) return 2u;
  return turn.last;
}

// Probability of a part: exactly that of the draw.
RL_FN float lightTurnProbability(RL_IN(LightTurn) turn, uint part) {
  if (turn.last == RL_INVALID || part > turn.last) return 0.0f;
  uint begin = 0u;
  if (part == 1u) begin = turn.bounds.x;
  if (part == 2u) begin = turn.bounds.y;
  if (part == 3u) begin = turn.bounds.z;
  if (part == turn.last) return begin == 0u ? 1.0f : float(0u - begin) * 2.3283064365386963e-10f;
  uint end = turn.bounds.x;
  if (part == 1u) end = turn.bounds.y;
  if (part == 2u) end = turn.bounds.z;
  return float(end - begin) * 2.3283064365386963e-10f;
}

// Node of a part, or its lamp with RL_LIGHT_NODE_LEAF.
RL_FN uint lightNodeLink(uint node, uint part) {
  uvec4 links = RL_SCENE_UVEC4(gScene.lightTree, node * RL_LIGHT_NODE_UVEC4S + 11u);
  if (part == 0u) return links.x;
  if (part == 1u) return links.y;
  return part == 2u ? links.z : links.w;
}

// Draws a lamp for a receiver; RL_INVALID if none can send light there, or a bound was too wide.
RL_FN uint lightTreeDraw(RL_IN(Rng) rng, RL_IN(LightReceiver) receiver, RL_OUT(float) probability) {
  probability = 1.0f;
  uint link = 0u;
  for (uint level = 0u; level < RL_LIGHT_TREE_DEPTH; level = level + 1u) {
    LightTurn turn = lightTurn(link, receiver);
    Rng at = rng;
    at.vertex = rng.vertex + RL_VERTEX_TURN * level;
    uint part = lightTurnPart(turn, rngBits(at, RL_DIM_LIGHT_TURN));
    probability *= lightTurnProbability(turn, part);
    if (turn.last == RL_INVALID) return RL_INVALID;
    link = lightNodeLink(link, part);
    if ((link & RL_LIGHT_NODE_LEAF) != 0u) break;
  }
  return link & ~RL_LIGHT_NODE_LEAF;
}

// Probability with which lightTreeDraw() gives the lamp that these parts lead to.
RL_FN float lightTreeProbability(uint trail, RL_IN(LightReceiver) receiver) {
  float probability = 1.0f;
  uint link = 0u;
  for (uint level = 0u; level < RL_LIGHT_TREE_DEPTH; level = level + 1u) {
    uint part = (trail >> (2u * level)) & 3u;
    probability *= lightTurnProbability(lightTurn(link, receiver), part);
    link = lightNodeLink(link, part);
    if ((link & RL_LIGHT_NODE_LEAF) != 0u || !(probability > 0.0f)) break;
  }
  return probability;
}

RL_FN bool lightIsLamp(uint kind) {
  return kind == RL_LIGHT_TRIANGLE || kind == RL_LIGHT_POINT || kind == RL_LIGHT_SPOT;
}

// Probability with which lightSample() selects a light for a receiver.
RL_FN float lightProbability(RL_IN(Light) light, RL_IN(LightReceiver) receiver) {
  if (RL_HAS(RL_FEATURE_LIGHT_TREE) && gFrame.lightTree != 0u && lightIsLamp(light.kind) &&
      light.pmf > 0.0f)
    return gScene.lampShare * lightTreeProbability(light.trail, receiver);
  return light.pmf;
}
