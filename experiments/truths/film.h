// Geometry of camera pixels on the plane y = 0, for images that are known in closed form.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "core/scene/scene.h"
#include "experiments/truths/truths.h"

namespace restlab::analytic {

// Returns the camera of a view: `moved` if set, else the scene's.
const SceneCamera& cameraOf(const Scene& scene, const ExactView& view);

// Returns the direction, not normalised, in which the camera sees a film position; x, y in pixels.
glm::dvec3 directionThrough(const SceneCamera& camera, double x, double y, const ExactView& view);

// Returns where a ray from the camera meets the plane y = 0; dir.y must not be 0.
glm::dvec3 floorPoint(const SceneCamera& camera, const glm::dvec3& dir);

// Returns whether all pixels show the rectangle from `low` to `high` of that plane, from above.
bool seesOnly(const glm::dvec3& low, const glm::dvec3& high, const SceneCamera& camera,
              const ExactView& view);

// Gauss-Legendre points per pixel: 8 x 8, or 2 x 2 for slow integrands.
enum class FilmPoints { many, few };

// Averages the radiance of the plane's points over every pixel; row 0 on top.
std::vector<glm::dvec3> filmOf(const SceneCamera& camera, const ExactView& view, FilmPoints points,
                               const std::function<glm::dvec3(const glm::dvec3& posW)>& radiance);

// Throws std::invalid_argument if no instance has that name.
const MeshInstance& instanceNamed(const Scene& scene, const std::string& name);

}  // namespace restlab::analytic
