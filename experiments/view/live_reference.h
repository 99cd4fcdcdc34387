// The reference of what a viewer shows. It converges while nothing else is to do, goes on from the
// progress that other programs have kept of it, and is kept for them.
#pragma once

#include <functional>
#include <optional>

#include "experiments/runner/reference/reference_halves.h"
#include "experiments/runner/reference/reference_progress.h"

namespace restlab {

class LiveReference {
 public:
  explicit LiveReference(const ReferenceStore& store) : store_(store) {}
  // Keeps what there is.
  ~LiveReference();
  LiveReference(const LiveReference&) = delete;
  LiveReference& operator=(const LiveReference&) = delete;

  // From here on of this picture; nothing is rendered yet. `prepared` must live until the next.
  void begin(const PreparedScene& prepared, const ReferenceConfig& config);
  // The next sample of every pixel, for one half and then for the other.
  // Where `isStopped` holds before it ends there is none, and the same one is next: false then.
  bool addSample(const std::function<bool()>& isStopped = {});
  // One that was read, instead: nothing is rendered. Without halves its own noise is in every
  // error.
  void show(const Reference& reference);
  // Where others find it; nothing where it is none of the scene's own cameras.
  void keep();
  // With the metadata of a file. It is there, and was not given.
  Reference whole() const { return referenceOf(*prepared_, config_, state_); }

  // Bytes that the rendered samples hold in the host's memory.
  uint64_t heldBytes() const {
    const bool isRendered = halves_.has_value() || state_.spp() > 0;
    return isRendered ? uint64_t(config_.width) * config_.height * kStateBytesPerPixel : 0;
  }
  uint64_t spp() const { return isGiven_ ? pictures_.spp : state_.spp(); }
  // Both halves have a sample, as the rest needs.
  bool isThere() const { return isGiven_ || state_.half1.count() > 0; }
  // Made once after each sample.
  const Image& mean() const { return pictures().mean; }
  const Image& half0() const { return pictures().half0; }
  const Image& half1() const { return pictures().half1; }
  double relmse() const { return pictures().relmse; }
  // Of the last sample; 0 before there was one of this picture.
  double sampleMs() const { return sampleMs_; }

 private:
  struct Pictures {
    uint64_t spp = 0;
    Image mean, half0, half1;
    double relmse = 0.0;
  };
  const Pictures& pictures() const;

  const ReferenceStore store_;
  const PreparedScene* prepared_ = nullptr;
  ReferenceConfig config_;
  ReferenceState state_;
  // Of the scene's own cameras: those of a camera that somebody moves are seen once.
  std::optional<ReferenceProgress> progress_;
  std::optional<ReferenceHalves> halves_;  // from the first sample on
  mutable Pictures pictures_;
  bool isGiven_ = false;
  double sampleMs_ = 0.0;
};

}  // namespace restlab
