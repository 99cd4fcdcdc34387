// What stands between the shaded radiance and the frame that is shown. A denoiser is a folder under
// denoise/, a line in denoise/denoisers.list, kernels and one .cpp that defines
// `const DenoiserInfo& <name>DenoiserInfo()`.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/part.h"

namespace restlab {

// Buffer 0 is the frame that is shown (12 bytes a pixel); without passes the radiance is shown as
// it is. Inputs are "radiance" and what core/visible_surfaces.h offers: position, normals and
// reflectance at the centres of pixels, in this view and in the last one. There are no layers of
// the film samples themselves, no motion and no confidence yet.
struct DenoiserInfo : PartInfo {
  // What it adds to the bias of the integrator, while the camera stands and when it moves.
  BiasClass biasOfStillView = BiasClass::unbiased;
  BiasClass biasOfMovingView = BiasClass::unbiased;
  std::string why;
  // How many frames a shown pixel averages, once its history is old, where the integrator's
  // radiance averages `radianceFrames`; empty: as many.
  std::function<double(const ParameterMap&, double radianceFrames)> shownFrames;
};

// All denoisers of denoisers.list, in its order.
const std::vector<const DenoiserInfo*>& denoiserRegistry();
// Throws Error (badUsage) with the nearest name.
const DenoiserInfo& findDenoiser(const std::string& name);

}  // namespace restlab
