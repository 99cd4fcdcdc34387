// Demands of a suite on its references.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace restlab {

// Integrators that may render a reference, the default first. They estimate the same image and
// share no choice of lights.
inline const std::vector<std::string>& referenceIntegrators() {
  static const std::vector<std::string> names = {"path", "bdpt"};
  return names;
}

// Source of the reference of a scene.
enum class Truth {
  rendered,  // from the scene itself, the default
  exact,     // in closed form (experiments/truths)
  same,      // from the scene without `scale`, `radiance` and `move`, times its radiance
};

// When to stop: at the first target that is reached; 0 is no target. At least one must be set.
// Samples of earlier calls count. `relmse` is reached when all estimates since half of the samples
// are at most `relmse`, and every light was drawn often enough (reference/light_draws.h).
struct ReferenceTarget {
  uint64_t spp = 0;         // samples per pixel of both halves together, at least 2
  double relmse = 0.0;      // mean d^2/(r^2+1e-2) of the mean, estimated from the halves
  double timeLimitS = 0.0;  // seconds of rendering
};

}  // namespace restlab
