// Settings of a viewer that a page can change, independent of rendering: they can be stored, undone
// and written to a file.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/frame/session.h"
#include "core/scene/scene_file/scene_settings.h"
#include "experiments/view/command.h"

namespace restlab {

struct PreparedScene;  // experiments/runner/suite/prepare.h

struct PaneSettings {
  SessionConfig config;  // mode and cache by name; only parameters that were given
  std::string layer;     // layer over the image; "": none
  // kMethodSource, kReferenceSource or the name of an image (view_images.h).
  std::string source = {};
  // Grows with each seed that is set: undo gives such a seed back, but none of a restart.
  uint32_t seedsSet = 0;
};

// Factors in the order they were set. The factor of `all` multiplies those of every light.
using LightFactors = std::vector<std::pair<std::string, double>>;

// Settings behind the name of a scene file, such as "material.wall.alpha" and "0.3", in the order
// they were set.
using MaterialEdits = std::vector<std::pair<std::string, std::string>>;

struct ViewSettings {
  std::vector<PaneSettings> panes;  // all of one size
  LightFactors lights;              // lights that were set
  MaterialEdits materials;          // parameters that were set
  SceneCamera camera;
  // Seed of the references; none: that of the first pane at the begin.
  std::optional<uint32_t> firstSeed = {};
};

// Result of a command.
struct ViewChange {
  ViewSettings settings;  // after the change
  std::string target;     // consecutive changes of one target are one step
  std::string text;       // short description
};

// Names that commands may use.
struct ViewChoices {
  const Scene* scene = nullptr;      // as loaded; null: only images are shown
  std::vector<std::string> sources;  // sources of panes
  uint32_t firstSeed = 1;            // default of the panes' seeds
};

// Applies a command that sets something, such as SetSetting or CopyMethod. Throws Error (badUsage)
// with one line if the command names something unknown; mistakes that only a session finds are not
// checked.
ViewChange changedBy(const ViewCommand& command, const ViewSettings& settings,
                     const ViewChoices& choices);

// Fills in default names of mode and cache. Throws Error (badUsage) as findMethod() does.
SessionConfig withNames(SessionConfig config);

// False if a change from one to the other needs a new session. Ignores parameters, size and seed.
bool isSameMethod(const SessionConfig& a, const SessionConfig& b);
bool isSameSize(const SessionConfig& a, const SessionConfig& b);
bool isSameCamera(const SceneCamera& a, const SceneCamera& b);
// Ignores seeds.
bool isSame(const ViewSettings& a, const ViewSettings& b);
// Compares the picture only, not the methods.
bool isSamePicture(const ViewSettings& a, const ViewSettings& b);

// The [[material]] tables of a scene file with the kinds that are set; none of other scenes. Throws
// Error as loadSceneFile() does.
std::vector<ListedMaterial> materialsOf(const PreparedScene& loaded, const MaterialEdits& edits);

// The edits as they stand behind the name: "material.wall.alpha=0.3&...".
std::string settingsText(const MaterialEdits& edits);

// Replaces an earlier factor of the light; drops a factor of 1 that has no effect.
void setLight(LightFactors& lights, const std::string& name, double factor);
// Converts to factors as events of a suite use them, applied in order: the last factor of a light
// counts, and `all` sets every light.
LightFactors absoluteLights(const LightFactors& lights);
// Inverse of absoluteLights().
LightFactors ownLights(const LightFactors& absolute, const Scene& scene);

// Target of the command; "" if the command must not be skipped when another one follows.
std::string targetOf(const ViewCommand& command);

}  // namespace restlab
