// Names for people: of kinds of paths, and of reasons why a shift has no result.
#pragma once

#include <array>
#include <cstdint>

#include "core/path_sample/path_shift.h"

namespace restlab {

// failed: RL_FAILED_*.
inline const char* nameOfFailedShift(uint32_t failed) {
  static constexpr std::array<const char*, 12> names = {
      "accepted",         "empty", "absorbed", "background", "smooth", "replay",
      "connects earlier", "pair",  "entry",    "jacobian",   "dark",   "occluded"};
  return names.at(failed);
}

// kind: RL_PATH_*.
inline const char* nameOfPathKind(uint32_t kind) {
  static constexpr std::array<const char*, 7> names = {"light at x1",
                                                       "Lambert x2",
                                                       "glossy x2, light sample",
                                                       "glossy x2, emitter behind it",
                                                       "glossy x2, continued",
                                                       "light sample of a smooth x1",
                                                       "replayed as a whole"};
  return names.at(kind);
}

}  // namespace restlab
