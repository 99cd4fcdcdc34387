// What a camera's pixels show of the plane y = 0, for images that are known in closed form.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "core/scene/scene.h"
#include "experiments/truths/truths.h"

namespace restlab::analytic {

// The camera of a view: the one that it gives, else the scene's.
const SceneCamera& cameraOf(const Scene& scene, const ExactView& view);

// A direction, not unit, in which the camera sees a place of its film; x, y in pixels.
glm::dvec3 directionThrough(const SceneCamera& camera, double x, double y, const ExactView& view);

// Where a ray from the camera meets the plane y = 0; dir.y is not 0.
glm::dvec3 floorPoint(const SceneCamera& camera, const glm::dvec3& dir);

// Do all pixels show the axis-aligned rectangle from `low` to `high` of that plane, from above?
bool seesOnly(const glm::dvec3& low, const glm::dvec3& high, const SceneCamera& camera,
              const ExactView& view);

// Points of a pixel in Gauss-Legendre quadrature: 8 x 8; 2 x 2 where a point takes long.
enum class FilmPoints { many, few };

// Mean over every pixel of a radiance of the plane's points; row 0 on top.
std::vector<glm::dvec3> filmOf(const SceneCamera& camera, const ExactView& view, FilmPoints points,
                               const std::function<glm::dvec3(const glm::dvec3& posW)>& radiance);

// Throws std::invalid_argument where there is none of that name.
const MeshInstance& instanceNamed(const Scene& scene, const std::string& name);

}  // namespace restlab::analytic
