// Renders the samples of a reference one by one, alternating between its two independent halves.
#pragma once

#include <functional>

#include "core/frame/session.h"
#include "experiments/runner/reference/reference.h"
#include "experiments/runner/reference/reference_state.h"

namespace restlab {

// Returns the session that renders a half of a reference, apart from its seed.
SessionConfig referenceSession(const PreparedScene& prepared, const ReferenceConfig& config);

// Estimates relmse_e1e-2 of the mean of both halves against the truth from their difference.
double estimateRelmse(const BlockSum& a, const BlockSum& b);

// Adds the check of the error that is due at the samples that the state has, if one is.
void addDueCheck(ReferenceState& state);

// One session per half. Each continues after the frames that its half has already.
class ReferenceHalves {
 public:
  // `state`: holds the samples so far and receives new ones; must outlive this object.
  // `hostBytesPerPixel`: see Session. `firstSpp`: number of the first sample of the state, an even
  // one: 0 unless the state is of a block in the middle. Throws Error as Session does; badUsage
  // for a method with a history that is to begin in its middle.
  ReferenceHalves(const PreparedScene& prepared, const ReferenceConfig& config,
                  ReferenceState& state, size_t hostBytesPerPixel = 0, uint64_t firstSpp = 0);

  // Renders the next sample of every pixel for the half whose turn it is, and updates time and
  // error estimates. An exception leaves the state as it was. If `isStopped` returns true before
  // the frame ends (Session::frameUnless), returns false without a sample; the next call renders
  // the same one.
  bool addSample(const std::function<bool()>& isStopped = {});
  // Does the same without error estimates, which blocks after the first one do not have alone.
  bool addUnchecked(const std::function<bool()>& isStopped = {});

 private:
  Session first_, second_;
  ReferenceState& state_;
};

}  // namespace restlab
