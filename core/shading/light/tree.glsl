// The choice of a lamp that knows the receiver: at each node of a hierarchy, a part with the
// probability of its importance, a bound on what its lamps can send (Conty Estevez and Kulla 2018,
// section 4). The probability of a lamp is that of the parts that lead to it.

RL_FN Lanes lightNodeFloats(uint node, uint row) {
  return lanesOfBits(RL_SCENE_UVEC4(gScene.lightTree, node * RL_LIGHT_NODE_UVEC4S + row));
}

RL_FN Lanes lightSine(Lanes cosine) {
  return lanesSqrt(lanesMax(lanesAll(1.0f) - cosine * cosine, lanesAll(0.0f)));
}

// cos(max(a - b, 0)) for angles in [0, pi].
RL_FN Lanes lightCosineBeyond(Lanes cosA, Lanes sinA, Lanes cosB, Lanes sinB) {
  return lanesIfLess(cosA, cosB, cosA * cosB + sinA * sinB, lanesAll(1.0f));
}

RL_FN Lanes lightClampCosine(Lanes cosine) {
  return lanesMin(lanesMax(cosine, lanesAll(-1.0f)), lanesAll(1.0f));
}

RL_FN Lanes lightUnpackCosines(RL_IN(uvec4) words, uint shift) {
  uvec4 halves = uvec4((words.x >> shift) & 0xffffu, (words.y >> shift) & 0xffffu,
                       (words.z >> shift) & 0xffffu, (words.w >> shift) & 0xffffu);
  return lanesOfWords(halves) * lanesAll(1.0f / 32767.0f) - lanesAll(1.0f);
}

// Importance of a node's four parts for a receiver: 0 only where none of their lamps can send light
// there. Cosines have slack, so that rounding loses no lamp. Without branches: machines compute the
// four at once.
RL_FN Lanes lightNodeImportance(uint node, RL_IN(LightReceiver) receiver) {
  Lanes lowX = lightNodeFloats(node, 0u);
  Lanes lowY = lightNodeFloats(node, 1u);
  Lanes lowZ = lightNodeFloats(node, 2u);
  Lanes highX = lightNodeFloats(node, 3u);
  Lanes highY = lightNodeFloats(node, 4u);
  Lanes highZ = lightNodeFloats(node, 5u);
  Lanes one = lanesAll(1.0f);
  Lanes halved = lanesAll(0.5f);
  Lanes extentX = halved * (highX - lowX);
  Lanes extentY = halved * (highY - lowY);
  Lanes extentZ = halved * (highZ - lowZ);
  Lanes dx = halved * (lowX + highX) - lanesAll(receiver.posW.x);
  Lanes dy = halved * (lowY + highY) - lanesAll(receiver.posW.y);
  Lanes dz = halved * (lowZ + highZ) - lanesAll(receiver.posW.z);
  Lanes r2 = extentX * extentX + extentY * extentY + extentZ * extentZ;
  Lanes d2 = dx * dx + dy * dy + dz * dz;
  Lanes tiny = lanesAll(1.0e-30f);
  Lanes inverse = one / lanesSqrt(lanesMax(d2, tiny));
  // Half the angle under which the receiver sees the box, at most.
  Lanes sinBox = lanesMin(lanesSqrt(r2) * inverse, one);
  Lanes cosBox = lightSine(sinBox);
  uvec4 cones = RL_SCENE_UVEC4(gScene.lightTree, node * RL_LIGHT_NODE_UVEC4S + 10u);
  Lanes cosSpread = lightUnpackCosines(cones, 0u);
  Lanes cosLeaves = (lightNodeFloats(node, 7u) * dx + lightNodeFloats(node, 8u) * dy +
                     lightNodeFloats(node, 9u) * dz) *
                    -inverse;
  cosLeaves = lightClampCosine(cosLeaves);
  cosLeaves = lightCosineBeyond(cosLeaves, lightSine(cosLeaves), cosSpread, lightSine(cosSpread));
  cosLeaves = lightCosineBeyond(cosLeaves, lightSine(cosLeaves), cosBox, sinBox);
  Lanes slack = lanesAll(1.0e-3f);
  Lanes none = lanesAll(0.0f);
  Lanes leaves = lanesIfLess(cosLeaves, lightUnpackCosines(cones, 16u) - slack, none,
                             lanesMax(cosLeaves, slack));
  Lanes cosArrives = (lanesAll(receiver.normalW.x) * dx + lanesAll(receiver.normalW.y) * dy +
                      lanesAll(receiver.normalW.z) * dz) *
                     inverse;
  if (receiver.isTwoSided != 0u) cosArrives = lanesMax(cosArrives, -cosArrives);
  cosArrives = lightClampCosine(cosArrives);
  cosArrives = lightCosineBeyond(cosArrives, lightSine(cosArrives), cosBox, sinBox);
  Lanes arrives = lanesIfLess(cosArrives, -slack, none, lanesMax(cosArrives, slack));
  // Inside of the sphere around a box nothing is known.
  Lanes factor = lanesIfLess(r2, d2, leaves * arrives, one);
  return lightNodeFloats(node, 6u) * factor / lanesMax(lanesMax(d2, r2), tiny);
}

// At least 256 of 2^32 for a part that can send light: every lamp in reach has a probability.
RL_FN uint lightShareBits(float importance, float scale) {
  return importance > 0.0f ? uint(importance * scale) + 256u : 0u;
}

RL_FN LightTurn lightTurn(uint node, RL_IN(LightReceiver) receiver) {
  Lanes parts = lightNodeImportance(node, receiver);
  vec4 importance =
      vec4(lanesAt(parts, 0u), lanesAt(parts, 1u), lanesAt(parts, 2u), lanesAt(parts, 3u));
  LightTurn turn;
  turn.last = RL_INVALID;
  if (importance.x > 0.0f) turn.last = 0u;
  if (importance.y > 0.0f) turn.last = 1u;
  if (importance.z > 0.0f) turn.last = 2u;
  if (importance.w > 0.0f) turn.last = 3u;
  // Leaves room for the shares of 256 and for rounding.
  float total = importance.x + importance.y + importance.z + importance.w;
  float scale = min(rlSafeDivide(4294963200.0f, total), 3.0e38f);
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

// Node of a part, its lamp with RL_LIGHT_NODE_LEAF, or its cluster with RL_LIGHT_NODE_CLUSTER.
RL_FN uint lightNodeLink(uint node, uint part) {
  uvec4 links = RL_SCENE_UVEC4(gScene.lightTree, node * RL_LIGHT_NODE_UVEC4S + 11u);
  if (part == 0u) return links.x;
  if (part == 1u) return links.y;
  return part == 2u ? links.z : links.w;
}

// Random bits of a level of the hierarchy.
RL_FN uint lightTurnBits(RL_IN(Rng) rng, uint level) {
  Rng at = rng;
  at.vertex = rng.vertex + RL_VERTEX_TURN * level;
  return rngBits(at, RL_DIM_LIGHT_TURN);
}

RL_FN float lightClusterProbability(uint lamp) {
  return uintBitsToFloat(RL_SCENE_UINT(gScene.lightTrails, 2u * lamp + 1u));
}

// A lamp of a cluster, by power.
RL_FN uint lightClusterDraw(uint cluster, uint columnBits, uint aliasBits) {
  uvec4 head = RL_SCENE_UVEC4(gScene.lightTree, cluster);
  uint column = rlMulHigh(columnBits, head.x);
  uvec4 entry = RL_SCENE_UVEC4(gScene.lightTree, cluster + 1u + column);
  return aliasBits < entry.x ? entry.y : entry.z;
}

// Draws a lamp for a receiver; RL_INVALID if none can send light there, or a bound was too wide.
RL_FN uint lightTreeDraw(RL_IN(Rng) rng, RL_IN(LightReceiver) receiver, RL_OUT(float) probability) {
  probability = 1.0f;
  uint link = 0u;
  uint level = 0u;
  for (; level < RL_LIGHT_TREE_DEPTH; level = level + 1u) {
    LightTurn turn = lightTurn(link, receiver);
    uint part = lightTurnPart(turn, lightTurnBits(rng, level));
    probability *= lightTurnProbability(turn, part);
    if (turn.last == RL_INVALID) return RL_INVALID;
    link = lightNodeLink(link, part);
    if ((link & RL_LIGHT_NODE_LEAF) != 0u) break;
  }
  if ((link & RL_LIGHT_NODE_CLUSTER) != RL_LIGHT_NODE_CLUSTER) return link & RL_LIGHT_NODE_WHERE;
  uint lamp = lightClusterDraw(link & RL_LIGHT_NODE_WHERE, lightTurnBits(rng, level + 1u),
                               lightTurnBits(rng, level + 2u));
  probability *= lightClusterProbability(lamp);
  return lamp;
}

// Probability with which lightTreeDraw() gives a lamp.
RL_FN float lightTreeProbability(uint lamp, RL_IN(LightReceiver) receiver) {
  uint trail = RL_SCENE_UINT(gScene.lightTrails, 2u * lamp);
  float probability = 1.0f;
  uint link = 0u;
  for (uint level = 0u; level < RL_LIGHT_TREE_DEPTH; level = level + 1u) {
    uint part = (trail >> (2u * level)) & 3u;
    probability *= lightTurnProbability(lightTurn(link, receiver), part);
    link = lightNodeLink(link, part);
    if ((link & RL_LIGHT_NODE_LEAF) != 0u || !(probability > 0.0f)) break;
  }
  if ((link & RL_LIGHT_NODE_CLUSTER) != RL_LIGHT_NODE_CLUSTER) return probability;
  return probability * lightClusterProbability(lamp);
}

RL_FN bool lightIsLamp(uint kind) {
  return kind == RL_LIGHT_AREA || kind == RL_LIGHT_POINT || kind == RL_LIGHT_SPOT;
}

RL_FN bool lightTreeIsUsed() {
  return RL_HAS(RL_FEATURE_LIGHT_TREE) && gFrame.lightTree != 0u && gScene.lampShare > 0.0f;
}

// Probability with which lightDraw() selects a light for a receiver.
RL_FN float lightProbability(uint record, RL_IN(Light) light, RL_IN(LightReceiver) receiver) {
  if (lightTreeIsUsed() && lightIsLamp(light.kind) && light.pmf > 0.0f)
    return gScene.lampShare * lightTreeProbability(record, receiver);
  return light.pmf;
}
