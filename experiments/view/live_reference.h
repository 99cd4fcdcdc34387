// Reference of the viewer's picture. Converges while nothing else is to do. Starts from the
// progress that other programs have stored and stores its own for them.
#pragma once

#include <functional>
#include <optional>

#include "experiments/runner/reference/reference_halves.h"
#include "experiments/runner/reference/reference_progress.h"

namespace restlab {

class LiveReference {
 public:
  explicit LiveReference(const ReferenceStore& store) : store_(store) {}
  // Stores the samples, as keep() does.
  ~LiveReference();
  LiveReference(const LiveReference&) = delete;
  LiveReference& operator=(const LiveReference&) = delete;

  // Begins a new picture; renders nothing yet. `prepared` must live until the next call.
  void begin(const PreparedScene& prepared, const ReferenceConfig& config);
  // Renders the next sample of every pixel, for one half and then for the other. If `isStopped`
  // becomes true before the end, the sample is dropped, stays the next one, and the result is
  // false.
  bool addSample(const std::function<bool()>& isStopped = {});
  // Takes the samples that another program has kept meanwhile, if they are more. Returns whether it
  // did.
  bool takeKept();
  // Shows a reference that was read instead of rendering one. If it has no halves, its noise is in
  // every error.
  void show(const Reference& reference);
  // Stores the samples for other programs; does nothing for a camera that is not one of the scene's
  // own.
  void keep();
  // Returns the reference with the metadata of a file. Requires hasImage() and a rendered
  // reference.
  Reference whole() const { return referenceOf(*prepared_, config_, state_); }

  // Bytes of host memory that hold the rendered samples.
  uint64_t heldBytes() const {
    return uint64_t(config_.width) * config_.height * state_.bytesPerPixel();
  }
  uint64_t spp() const { return isGiven_ ? pictures_.spp : state_.spp(); }
  // True if both halves have a sample; required by the functions below.
  bool hasImage() const { return isGiven_ || state_.half1.count() > 0; }
  // Pictures are computed once after each sample.
  const Image& mean() const { return pictures().mean; }
  const Image& half0() const { return pictures().half0; }
  const Image& half1() const { return pictures().half1; }
  double relmse() const { return pictures().relmse; }
  // Time of the last sample of this picture; 0 before the first one.
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
  // Only set for the scene's own cameras: the reference of a camera moved by hand is never needed
  // again.
  std::optional<ReferenceProgress> progress_;
  std::optional<ReferenceHalves> halves_;  // made at the first sample
  mutable Pictures pictures_;
  bool isGiven_ = false;
  double sampleMs_ = 0.0;
};

}  // namespace restlab
