// Random inputs of the tests, from a generator independent of the one under test.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>
#include <random>

namespace restlab::unit {

class Inputs {
 public:
  explicit Inputs(uint64_t seed) : engine_(seed) {}

  // Uniform in [0, 1), with as many bits as the dialect's draws.
  float uniform() { return static_cast<float>(engine_() >> 40) * 0x1p-24f; }
  float uniform(float low, float high) { return low + (high - low) * uniform(); }
  glm::vec2 square() {
    const float x = uniform();
    return {x, uniform()};
  }
  uint32_t bits() { return static_cast<uint32_t>(engine_() >> 32); }
  uint32_t below(uint32_t n) { return static_cast<uint32_t>((engine_() >> 32) * n >> 32); }

  // Uniform on the unit sphere, rounded once.
  glm::vec3 direction() {
    const double z = 2.0 * uniform() - 1.0, phi = 2.0 * std::numbers::pi * uniform();
    const double r = std::sqrt(1.0 - z * z);
    return glm::vec3(glm::normalize(glm::dvec3(r * std::cos(phi), r * std::sin(phi), z)));
  }
  // Uniform on the hemisphere around n.
  glm::vec3 directionAbove(const glm::vec3& n) {
    const glm::vec3 d = direction();
    return glm::dot(d, n) < 0.0f ? -d : d;
  }
  // Log-uniform between low and high.
  float scale(float low, float high) { return low * std::pow(high / low, uniform()); }

 private:
  std::mt19937_64 engine_;
};

}  // namespace restlab::unit
