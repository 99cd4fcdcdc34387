// Renders the samples of a reference one by one, alternating between its two independent halves.
#pragma once

#include <functional>

#include "core/frame/session.h"
#include "experiments/runner/reference/reference.h"
#include "experiments/runner/reference/reference_state.h"
#include "experiments/statistics/image_sum.h"

namespace restlab {

// Returns the session that renders a half of a reference, apart from its seed.
SessionConfig referenceSession(const PreparedScene& prepared, const ReferenceConfig& config);

// Estimates relmse_e1e-2 of the mean of both halves against the truth from their difference.
double estimateRelmse(const ImageSum& a, const ImageSum& b);

// One session per half. Each continues after the frames that its half has already.
class ReferenceHalves {
 public:
  // `state`: holds the samples so far and receives new ones; must outlive this object.
  // `hostBytesPerPixel`: see Session.
  ReferenceHalves(const PreparedScene& prepared, const ReferenceConfig& config,
                  ReferenceState& state, size_t hostBytesPerPixel = 0);

  // Renders the next sample of every pixel for the half whose turn it is, and updates time and
  // error estimates. An exception leaves the state as it was. If `isStopped` returns true before
  // the frame ends (Session::frameUnless), returns false without a sample; the next call renders
  // the same one.
  bool addSample(const std::function<bool()>& isStopped = {});

 private:
  Session first_, second_;
  ReferenceState& state_;
};

}  // namespace restlab
