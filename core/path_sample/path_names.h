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

// kind: RL_PATH_*, of the vertex that reconnects.
inline const char* nameOfPathKind(uint32_t kind) {
  static constexpr std::array<const char*, 7> names = {"light",
                                                       "Lambert vertex",
                                                       "glossy vertex, light sample",
                                                       "glossy vertex, emitter behind it",
                                                       "glossy vertex, continued",
                                                       "light sample of a smooth vertex",
                                                       "replayed as a whole"};
  return names.at(kind);
}

}  // namespace restlab
