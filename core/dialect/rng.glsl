// Counter-based random numbers: the same (seed, pixel, frame, vertex, dimension) gives the same
// draw on every machine and for any thread count.

#ifndef RL_RNG_AUDIT
#define RL_RNG_AUDIT(rng, dimension)
#endif

// Integer finaliser with low avalanche bias (constants: C. Wellons, "hash prospector", 2018).
RL_FN uint rngHash(uint bits) {
  uint x = bits;
  x ^= x >> 16u;
  x *= 0x7feb352du;
  x ^= x >> 15u;
  x *= 0x846ca68bu;
  x ^= x >> 16u;
  return x;
}

RL_FN Rng rngInit(uint seed, uint pixel, uint frame) {
  Rng rng;
  uint h = rngHash(seed + 0x9e3779b9u);
  h = rngHash(h ^ frame);
  rng.key.x = rngHash(h + pixel);
  rng.key.y = rngHash((h ^ 0x85ebca6bu) + pixel * 0x9e3779b9u);
  rng.vertex = RL_VERTEX_PIXEL;
  return rng;
}

// The generator of a path that is replayed: from a word that its reservoir keeps.
RL_FN Rng rngOfKey(uint key) {
  Rng rng;
  rng.key = uvec2(key, rngHash(key ^ 0x85ebca6bu));
  rng.vertex = RL_VERTEX_PIXEL;
  return rng;
}

// 32 random bits of one dimension at the generator's vertex.
RL_FN uint rngBits(RL_IN(Rng) rng, uint dimension) {
  RL_RNG_AUDIT(rng, dimension);
  uint counter = rng.vertex * RL_DIMENSIONS + dimension;
  return rngHash(rngHash(counter ^ rng.key.x) + rng.key.y);
}

// Maps the upper 24 bits to [0, 1), so that 1 is never reached. Events with a probability below
// 2^-24 must be decided by comparing the bits themselves.
RL_FN float rngUnit(uint bits) { return float(bits >> 8u) * 5.9604644775390625e-8f; }

RL_FN float rngDraw(RL_IN(Rng) rng, uint dimension) { return rngUnit(rngBits(rng, dimension)); }

// 32 random bits that many pixels share on purpose, such as the position of a frame's tiles. Not
// audited for repeated draws: every pixel must get the same number.
RL_FN uint rngSharedBits(uint group, uint dimension) {
  Rng rng = rngInit(gFrame.seed ^ 0x3c6ef372u, group, gFrame.frame);
  return rngHash(rngHash(dimension ^ rng.key.x) + rng.key.y);
}

// Start of a pixel's sequence of film samples: the same in every frame and for every caller.
RL_FN uint rngFilmStart(uint pixel, uint dimension) {
  Rng rng = rngInit(gFrame.seed ^ 0x5bd1e995u, pixel, 0u);
  return rngHash(rngHash(dimension ^ rng.key.x) + rng.key.y);
}
