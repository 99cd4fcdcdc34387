// Exact state of a reference: sums in double precision that further samples can be added to as if
// the rendering had never stopped, and the file that stores them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/runner/base/health_sum.h"
#include "experiments/runner/reference/relmse_checks.h"
#include "experiments/statistics/image_sum.h"

namespace restlab {

// Identifies a sequence of samples: one key, seed and backend.
struct ReferenceId {
  std::string key;  // referenceKey(): the scene, the settings and the sources
  uint32_t seed = 1;
  std::string backend = "cpu";
  bool operator==(const ReferenceId&) const = default;
};

struct ReferenceState {
  ReferenceId id;
  // Samples alternate between the halves, half0 first. A half's count is the number of its next
  // frame.
  ImageSum half0, half1;
  ImageSum squares;  // over both halves
  RelmseChecks checks;
  HealthSum health;
  double timeS = 0.0;  // spent rendering
  // Devices and ray tracing backends in order of use, each named once.
  std::vector<std::string> devices, rayTracing;

  uint64_t spp() const { return half0.count() + half1.count(); }
};

// Samples are summed by blocks of this many per pixel, half of them of each half; sums of complete
// blocks are added up in the order of the blocks. Blocks rendered elsewhere thus give the same bits
// (reference_chunk.h).
constexpr uint64_t kBlockSpp = 1024;
// Bytes of the sums of a block.
constexpr size_t kBlockBytesPerPixel = 3 * sizeof(glm::dvec3);

// Bytes of a state, in memory and in its file.
constexpr size_t kStateBytesPerPixel = 3 * sizeof(glm::dvec3);

// Writes a state of at least two samples, completely or not at all. Throws Error (badInput) naming
// the file.
void writeReferenceState(const std::filesystem::path& file, const ReferenceState& state);

// Reads a state, bit for bit. Checks sizes before it allocates, and everything against checksums.
// Throws Error (badInput): the file, and what is wrong with it.
ReferenceState readReferenceState(const std::filesystem::path& file);

// Returns samples per pixel of the state in a file, from its header alone; 0 if there is no file,
// or its samples are of another id.
uint64_t storedSamples(const std::filesystem::path& file, const ReferenceId& id);

}  // namespace restlab
