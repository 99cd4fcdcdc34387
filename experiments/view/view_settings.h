// What a page can set in a viewer, apart from who renders it: a value to keep, to go back to and to
// write down.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/session.h"
#include "experiments/view/command.h"

namespace restlab {

struct PaneSettings {
  SessionConfig config;  // mode and cache by their names; parameters that were given, and no others
  std::string layer;     // over its image; "": none
  // What it shows: kMethodSource, kReferenceSource or the name of an image (view_images.h).
  std::string source = {};
};

// In the order of their setting. That of `all` is a factor on those of every light.
using LightFactors = std::vector<std::pair<std::string, double>>;

struct ViewSettings {
  std::vector<PaneSettings> panes;  // of one size
  LightFactors lights;              // those that were set
  SceneCamera camera;
};

// What a command changes.
struct ViewChange {
  ViewSettings settings;  // afterwards
  std::string target;     // what it is about: changes of one target in a row are one step
  std::string text;       // for people, short
};

// What commands may name.
struct ViewChoices {
  const Scene* scene = nullptr;      // as it was loaded; null: images alone are shown
  std::vector<std::string> sources;  // of panes
};

// Of commands that set something: all but Probe, Pause, Restart, Undo, Redo and SaveSession. Throws
// Error (badUsage) in one line where the command names what is not there; what a session finds out
// is not looked at.
ViewChange changedBy(const ViewCommand& command, const ViewSettings& settings,
                     const ViewChoices& choices);

// With the names that are there where none was given. Throws Error (badUsage) as findMethod() does.
SessionConfig withNames(SessionConfig config);

// Needs a session of its own to go from one to the other: all but parameters, size and seed.
bool isSameMethod(const SessionConfig& a, const SessionConfig& b);
bool isSameSize(const SessionConfig& a, const SessionConfig& b);
bool isSameCamera(const SceneCamera& a, const SceneCamera& b);
// Apart from seeds.
bool isSame(const ViewSettings& a, const ViewSettings& b);
// The same picture, whatever methods make it.
bool isSamePicture(const ViewSettings& a, const ViewSettings& b);

// The last factor of a light counts; a 1 that changes nothing is left out.
void setLight(LightFactors& lights, const std::string& name, double factor);
// As the events of suites have them, one after the other: the last factor of a light counts, and
// `all` is one for every light.
LightFactors absoluteLights(const LightFactors& lights);
// The other way round, of lights that set what absoluteLights() would.
LightFactors ownLights(const LightFactors& absolute, const Scene& scene);

// "" for what may not be left out where more of the same follows. Of Probe and so on, too.
std::string targetOf(const ViewCommand& command);

}  // namespace restlab
