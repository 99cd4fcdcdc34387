// Renders the samples of a reference, one after the other, to its two independent halves.
#pragma once

#include <functional>

#include "core/session.h"
#include "experiments/runner/reference/reference.h"
#include "experiments/runner/reference/reference_state.h"

namespace restlab {

// What a half of a reference is rendered with, but for its seed.
SessionConfig referenceSession(const PreparedScene& prepared, const ReferenceConfig& config);

// relmse_e1e-2 of the mean of both halves against the truth, estimated from what they differ in.
double estimateRelmse(const ImageSum& a, const ImageSum& b);

// One session a half. Each starts at the frame after those that its half has.
class ReferenceHalves {
 public:
  // `state` is what there is, and gets what is added; it must live as long. `hostBytesPerPixel`: as
  // of a session.
  ReferenceHalves(const PreparedScene& prepared, const ReferenceConfig& config,
                  ReferenceState& state, size_t hostBytesPerPixel = 0);

  // The next sample of every pixel, of the half whose turn it is, with its time and the checks that
  // are due. What ends it early leaves the state as it was. Where `isStopped` holds before it ends
  // (Session::frameUnless) there is none, and the same one is next: false then.
  bool addSample(const std::function<bool()>& isStopped = {});

 private:
  Session first_, second_;
  ReferenceState& state_;
};

}  // namespace restlab
