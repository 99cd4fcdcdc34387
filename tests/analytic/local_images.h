// Images of `local`, and the points of a floor that their pixels show.
#pragma once

#include <memory>
#include <optional>

#include "core/frame/session.h"
#include "core/scene/compiled/compiled_scene.h"

namespace restlab::analytic {

// The mean of frames through pixel centres.
Image imageOfLocal(const std::shared_ptr<const CompiledScene>& scene, ParameterMap parameters,
                   uint32_t width, uint32_t height, int frames = 1);

// Where the centre of a pixel shows the plane y = 0, looking down; none beyond `halfWidth` metres
// along x or z.
std::optional<glm::dvec3> floorPoint(const SceneCamera& camera, uint32_t x, uint32_t y,
                                     uint32_t width, uint32_t height, double halfWidth);

}  // namespace restlab::analytic
