// Lights that no light sample was drawn from: their light arrives only where rays hit them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace restlab {

class CompiledScene;

struct DrawnLights {
  size_t lights = 0;                 // emitting meshes, punctual lights and the sky, that shine
  std::vector<std::string> undrawn;  // names of those that no light sample was drawn from

  // "lights: 2 of 5 never drawn: lamp, spot 3"; names at most eight. "" if all were drawn.
  std::string text() const;
};

// `drawn`: SceneData::lights' words of FrameData::drawnLights. A mesh counts as drawn if one of its
// triangles was.
DrawnLights drawnLights(const CompiledScene& scene, const std::vector<uint32_t>& drawn);

}  // namespace restlab
