// Independent runs of a certificate, one EXR each, in a folder named by all inputs of the runs:
// existing runs are not rendered again.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "experiments/certificate/question.h"
#include "experiments/runner/base/health_sum.h"

namespace restlab::certificate {

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
