// Decides, from a reference's state, when its target is reached: after one more sample of one
// rendering, or after one more block of a merge.
#pragma once

#include <string>
#include <vector>

#include "experiments/runner/reference/light_draws.h"
#include "experiments/runner/reference/reference.h"
#include "experiments/runner/reference/reference_state.h"

namespace restlab {

// Lists the lights that are sampled: none without a scattering event, or if they are not drawn as
// light_draws.h says.
std::vector<DrawnLight> sampledLights(const PreparedScene& prepared, const ReferenceConfig& config);

class ReferenceStop {
 public:
  ReferenceStop(const PreparedScene& prepared, const ReferenceConfig& config,
                const ReferenceTarget& target)
      : target_(target), lights_(sampledLights(prepared, config)) {}

  // A small enough error counts if every light was drawn often enough, or if nothing else would end
  // the wait. Both are judged at the last error check, so that an interruption changes nothing.
  bool isReached(const ReferenceState& state) const;
  // Returns the text beside the progress: the error, and the light that the target waits for.
  std::string note(const ReferenceState& state) const;

 private:
  ReferenceTarget target_;
  std::vector<DrawnLight> lights_;
};

}  // namespace restlab
