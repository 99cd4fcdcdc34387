// Lights that are switched during a history: [[event]] of a suite.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/config.h"
#include "experiments/runner/suite/prepare.h"

namespace restlab {

struct Suite;
struct SuitePath;

struct LightEvent {
  uint32_t frame = 0;             // of the history, from 0: the first one with the new factor
  std::string light;              // name, for withLightFactor()
  double factor = 1.0;            // relative to the loaded light; until the light's next event
  std::string place, framePlace;  // of the name and the frame in the suite, for errors
};

// Adds the events to their paths, sorted by frame and then by their order in the file. Throws Error
// (badUsage) with the place of the mistake.
void readLightEvents(const ConfigTable& root, std::vector<SuitePath>& paths);
// Throws Error (badUsage) if an event of the suite's path comes after the measured frame or
// conflicts with the settings.
void checkLightEvents(const ConfigTable& settings, const Suite& suite);

// Returns "panel x0 from frame 8, lamp x0.5 from frame 16": events up to `frame`; "" without
// events.
std::string eventsText(const std::vector<LightEvent>& events, uint32_t frame);

// Scene with the light from `firstFrame` on.
struct LightPhase {
  uint32_t firstFrame = 0;
  PreparedScene prepared;
};

// Applies the suite's events to the scene. The first phase starts at frame 0; returns an empty
// vector without events. Throws Error (badUsage) at the place of a light that the scene does not
// have. Phases with the same light share one compiled scene.
std::vector<LightPhase> lightPhases(const Suite& suite, const PreparedScene& prepared);

// Returns the scene in a frame; `prepared` if there are no phases.
const PreparedScene& sceneAt(const std::vector<LightPhase>& phases, const PreparedScene& prepared,
                             uint32_t frame);

}  // namespace restlab
