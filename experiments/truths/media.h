// The exact image of "media": lengths through bodies.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "core/scene/scene.h"
#include "experiments/truths/truths.h"

namespace restlab::analytic {

// The scene's part of whyNotExact() and exactImage().
std::string whyNotMedia(const Scene& media, const ExactView& view);
std::vector<glm::dvec3> mediaImage(const Scene& media, const ExactView& view);

}  // namespace restlab::analytic
