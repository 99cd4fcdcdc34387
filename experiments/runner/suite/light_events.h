// Lamps that are switched while a history goes on: [[event]] of a suite.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/config.h"
#include "experiments/runner/run/prepare.h"

namespace restlab {

struct Suite;
struct SuitePath;

struct LightEvent {
  uint32_t frame = 0;             // of the history, from 0: the first one that it holds in
  std::string light;              // as withLightFactor() knows it
  double factor = 1.0;            // of the light that was loaded; until another event of the light
  std::string place, framePlace;  // of the name and of the frame in the suite, for errors
};

// Gives every path its events, by frame and then in the order of the file. Throws Error (badUsage)
// with the place of what is wrong.
void readLightEvents(const ConfigTable& root, std::vector<SuitePath>& paths);
// Do the events of the suite's path come before what it measures, and go with its settings? Else
// throws likewise.
void checkLightEvents(const ConfigTable& settings, const Suite& suite);

// "panel x0 from frame 8, lamp x0.5 from frame 16": those that came until a frame; "" without one.
std::string eventsText(const std::vector<LightEvent>& events, uint32_t frame);

// The scene as it is from a frame on.
struct LightPhase {
  uint32_t firstFrame = 0;
  PreparedScene prepared;
};

// Of the suite's events in the scene, the first of them from frame 0; nothing where there are no
// events. Throws Error (badUsage) at the place of a light that the scene does not have. Phases with
// the same light share one compiled scene.
std::vector<LightPhase> lightPhases(const Suite& suite, const PreparedScene& prepared);

// What a frame shows; `prepared` where there are no phases.
const PreparedScene& sceneAt(const std::vector<LightPhase>& phases, const PreparedScene& prepared,
                             uint32_t frame);

}  // namespace restlab
