// The independent runs of a certificate, an EXR each, in a folder that is named by all that they
// depend on: what is there already is not rendered again.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "experiments/runner/reference/reference.h"
#include "experiments/runner/run/prepare.h"
#include "experiments/runner/summary/accumulate.h"

namespace restlab::certificate {

// What is certified. A run is a history of its own: the mean of its frames warmup ..
// warmup + frames - 1. Every frame of an unbiased method has the right mean, so that their mean is
// as good an observation as one of them, and a quieter one; consecutive frames are correlated and
// are no observations of their own (docs/laboratory.md).
struct Question {
  SceneRequest request;  // of `prepared`
  PreparedScene prepared;
  SessionConfig config;  // complete; its seed is the first one
  uint32_t warmup = 0, frames = 1;
  std::string name;                // of the scene, in tables and file names; "": as it calls itself
  std::optional<Reference> exact;  // where the image is known without rendering
};

class RunFolder {
 public:
  enum class Batch { first, fresh };  // of seeds of their own

  // `jobs` runs are made side by side; 0: one a core. On a Vulkan device one after the other.
  RunFolder(const Question& question, const std::filesystem::path& folder, uint32_t jobs);

  // Renders those of runs 0 .. count - 1 that are not there. Throws Error (interrupted) on SIGINT;
  // finished runs stay.
  void make(Batch batch, uint64_t count);
  // Those runs in their order, each once it is made.
  void forEach(Batch batch, uint64_t count, const std::function<void(const Image&)>& take) const;
  // Of the frames of those runs, warm-up included.
  const HealthSum& health() const { return health_; }

  std::filesystem::path file(Batch batch, uint64_t run) const;
  uint32_t seedOf(Batch batch, uint64_t run) const;

 private:
  void render(Session& session, Batch batch, uint64_t run);

  const Question& question_;
  std::filesystem::path folder_;  // with the key
  std::map<std::string, std::string> words_;
  uint32_t jobs_;
  mutable HealthSum health_;
};

}  // namespace restlab::certificate
