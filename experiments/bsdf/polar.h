// Drawings of a BSDF.
#pragma once

#include <string>

#include "core/backend/bsdf_probe.h"
#include "core/image/image.h"
#include "core/scene/scene.h"

namespace restlab {

// f |cos_i| in the plane of incidence for light from five angles, each curve scaled to its own
// maximum, as a complete SVG document.
std::string polarSvg(const BsdfProbe& bsdf, const std::string& title);

// A ball of the material on a grey floor under a large lamp, a small one and a dim sky, rendered
// with `path`.
Image renderBall(const SceneMaterial& material, const Scene& images, uint32_t size, uint32_t spp);

}  // namespace restlab
