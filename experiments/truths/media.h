// Exact image of "media": absorption along lengths through bodies.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "core/scene/scene.h"
#include "experiments/truths/truths.h"

namespace restlab::analytic {

// Implement whyNotExact() and exactImage() for this scene.
std::string whyNotMedia(const Scene& media, const ExactView& view);
std::vector<glm::dvec3> mediaImage(const Scene& media, const ExactView& view);

}  // namespace restlab::analytic
