// What a reference is made of, exactly: sums in double precision, to which further samples can be
// added as if the rendering had never stopped; and the file that keeps them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/runner/summary/accumulate.h"
#include "experiments/runner/reference/relmse_checks.h"

namespace restlab {

// Which samples: those of one key, seed and backend make one sequence.
struct ReferenceId {
  std::string key;  // referenceKey(): the scene, the settings and the sources
  uint32_t seed = 1;
  std::string backend = "cpu";
  bool operator==(const ReferenceId&) const = default;
};

struct ReferenceState {
  ReferenceId id;
  // Samples go by turns, half0 first. What a half has summed is also the number of its next frame.
  ImageSum half0, half1;
  ImageSum squares;  // of the samples of both
  RelmseChecks checks;
  HealthSum health;
  double timeS = 0.0;  // spent rendering
  // What rendered it, in the order in which they came, each named once.
  std::vector<std::string> devices, rayTracing;

  uint64_t spp() const { return half0.count() + half1.count(); }
};

// Bytes of a state, in memory and in its file.
constexpr size_t kStateBytesPerPixel = 3 * sizeof(glm::dvec3);

// Writes a state of at least two samples, whole or not at all. Throws Error (badInput) naming the
// file.
void writeReferenceState(const std::filesystem::path& file, const ReferenceState& state);

// Reads it back, bit for bit. Sizes are checked before anything is allocated, everything against
// checksums. Throws Error (badInput): the file, and what is wrong with it.
ReferenceState readReferenceState(const std::filesystem::path& file);

// Samples per pixel of the state in a file, from its header alone; 0 where there is no file, or one
// of other samples.
uint64_t storedSamples(const std::filesystem::path& file, const ReferenceId& id);

}  // namespace restlab
