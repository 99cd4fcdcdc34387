// Four numbers that a machine computes at once. Compilers for CPUs find such code by themselves
// only where it has no choice in it.
#ifndef RL_LANES_H
#define RL_LANES_H

#ifdef __cplusplus
#ifdef __SSE__
#include <xmmintrin.h>
#endif

#include <bit>
#include <cmath>

#include "core/dialect/dialect.h"

namespace rl {

using Lanes __attribute__((vector_size(16u))) = float;

inline Lanes lanesOfBits(const uvec4& bits) { return std::bit_cast<Lanes>(bits); }
inline Lanes lanesAll(float v) { return Lanes{v, v, v, v}; }
inline Lanes lanesOfWords(const uvec4& words) {
  return Lanes{float(words.x), float(words.y), float(words.z), float(words.w)};
}
inline float lanesAt(Lanes v, uint i) { return v[i]; }
inline Lanes lanesSqrt(Lanes v) {
#ifdef __SSE__
  return _mm_sqrt_ps(v);
#else
  return Lanes{std::sqrt(v[0u]), std::sqrt(v[1u]), std::sqrt(v[2u]), std::sqrt(v[3u])};
#endif
}
// Where a < b: x, else y.
inline Lanes lanesIfLess(Lanes a, Lanes b, Lanes x, Lanes y) { return a < b ? x : y; }
inline Lanes lanesMin(Lanes a, Lanes b) { return a < b ? a : b; }
inline Lanes lanesMax(Lanes a, Lanes b) { return a < b ? b : a; }

}  // namespace rl
#endif

#endif
