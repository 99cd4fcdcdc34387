// Exact state of a reference: sums in double precision that further samples can be added to as if
// the rendering had never stopped, and the file that stores them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/runner/base/health_sum.h"
#include "experiments/runner/reference/reference_blocks.h"
#include "experiments/runner/reference/relmse_checks.h"
#include "experiments/statistics/block_sum.h"

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
  BlockSum half0{kBlockSpp / 2}, half1{kBlockSpp / 2};
  BlockSum squares{kBlockSpp};  // over both halves
  RelmseChecks checks;
  HealthSum health;
  double timeS = 0.0;  // spent rendering
  // Devices and ray tracing backends in order of use, each named once.
  std::vector<std::string> devices, rayTracing;

  uint64_t spp() const { return half0.count() + half1.count(); }
  // Memory of the sums, which is also what they take in the file.
  size_t bytesPerPixel() const {
    return half0.bytesPerPixel() + half1.bytesPerPixel() + squares.bytesPerPixel();
  }
};

// Most bytes of a state, in memory and in its file: the sums of complete blocks and of the open
// one.
constexpr size_t kStateBytesPerPixel = 2 * kBlockBytesPerPixel;

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
