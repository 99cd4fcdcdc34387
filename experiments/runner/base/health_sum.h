// Sums of the counters that frames bring.
#pragma once

#include <cstdint>
#include <string>

#include "core/frame/session.h"

namespace restlab {

// Returns whether the health counter of this index counts faults: lost values or weights. The
// others describe what a method does.
bool isFault(size_t count);

// Sums the counters of several frames.
struct HealthSum {
  Health health;
  uint64_t raysPath = 0, raysShadow = 0;
  void add(const FrameStats& frame);
  void add(const HealthSum& sum);
  // Returns "nonfinite=0 rejected_jacobian=12 ...".
  std::string text() const;
};

}  // namespace restlab
