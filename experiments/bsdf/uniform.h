// Random numbers for checks of a BSDF.
#pragma once

#include <cstdint>
#include <random>

namespace restlab {

// Uniform numbers of 24 bits: 0 or more, and below 1 also as float32.
class Uniform {
 public:
  explicit Uniform(uint64_t seed) : engine_(seed) {}
  double operator()() { return double(engine_() >> 40) * 0x1p-24; }

 private:
  std::mt19937_64 engine_;
};

}  // namespace restlab
