// Independent runs of a certificate, one EXR each, in a folder named by all inputs of the runs:
// existing runs are not rendered again.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "experiments/runner/base/health_sum.h"
#include "experiments/runner/reference/reference.h"
#include "experiments/runner/suite/prepare.h"

namespace restlab::certificate {

// Subject of a certificate. A run has its own history and is the mean of the frames warmup ..
// warmup + frames - 1. Every frame of an unbiased method has the right mean, so the mean of frames
// is as good an observation as a single one, and less noisy. Consecutive frames are correlated and
// are no separate observations (docs/laboratory.md).
struct Question {
  SceneRequest request;  // that `prepared` was made from
  PreparedScene prepared;
  SessionConfig config;  // complete; its seed is the base of all seeds
  uint32_t warmup = 0, frames = 1;
  std::string name;                // of the scene, in tables and file names; "": its own name
  std::optional<Reference> exact;  // if the image is known without rendering
};

class RunFolder {
 public:
  enum class Batch { first, fresh };  // each with its own seeds

  // Renders `jobs` runs in parallel; 0: one per core. On a Vulkan device always one at a time.
  RunFolder(const Question& question, const std::filesystem::path& folder, uint32_t jobs);

  // Renders the missing ones of runs 0 .. count - 1. Throws Error (interrupted) on SIGINT; finished
  // runs stay.
  void make(Batch batch, uint64_t count);
  // Passes these runs in order to `take`; all of them must exist.
  void forEach(Batch batch, uint64_t count, const std::function<void(const Image&)>& take) const;
  // Returns the counters over all frames of the runs passed by forEach(), warm-up included.
  const HealthSum& health() const { return health_; }

  std::filesystem::path file(Batch batch, uint64_t run) const;
  uint32_t seedOf(Batch batch, uint64_t run) const;

 private:
  void render(Session& session, Batch batch, uint64_t run);

  const Question& question_;
  std::filesystem::path folder_;  // including the key
  std::map<std::string, std::string> words_;
  uint32_t jobs_;
  mutable HealthSum health_;
};

}  // namespace restlab::certificate
