// Repeatable pseudo-random numbers for scenes: identical on every compiler and library, unlike the
// distributions of <random>.
#pragma once

#include <cstdint>

namespace restlab::builtin {

class SceneRandom {
 public:
  explicit SceneRandom(uint64_t seed) : state_(seed) {}

  // Uniform in [0, 1).
  double uniform() {
    // splitmix64 (Steele, Lea and Flood 2014).
    state_ += 0x9e3779b97f4a7c15ull;
    uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return double((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }

 private:
  uint64_t state_;
};

}  // namespace restlab::builtin
