// What stands between the shaded radiance and the frame that is shown. A denoiser is a folder under
// denoise/, a line in denoise/denoisers.list, kernels (or a filter on the host) and one .cpp that
// defines `const DenoiserInfo& <name>DenoiserInfo()`.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/host_filter.h"
#include "core/part.h"

namespace restlab {

// Buffer 0 is the frame that is shown (12 bytes a pixel); without buffers the radiance is shown as
// it is. Inputs are "radiance" and the buffers of core/view_parts.h: guides and motion of the film
// samples, and what the centres of pixels show. Not every method has reservoirs
// ("reservoir_history") or looks for changed light (core/changes): these are optional inputs.
struct DenoiserInfo : PartInfo {
  // What it adds to the bias of the integrator, while the camera stands and when it moves.
  BiasClass biasOfStillView = BiasClass::unbiased;
  BiasClass biasOfMovingView = BiasClass::unbiased;
  std::string why;
  // How many frames a shown pixel averages, once its history is old, where the integrator's
  // radiance averages `radianceFrames`; empty: as many.
  std::function<double(const ParameterMap&, double radianceFrames)> shownFrames;
  // Its image scales with the radiance in a smaller range (core/radiance_range.h).
  bool comparesSquares = false;
  // Of a denoiser that has no passes and no buffers: what runs on the host instead, with so many
  // threads (0: all cores) and resolved parameters. Its inputs are "radiance" and "guide", and it
  // has no history.
  std::function<HostFilter(int threads, const ParameterMap&)> onHost;
};

// A denoiser of denoisers.list that this program was built without.
struct MissingDenoiser {
  std::string name;
  std::string summary;  // one line
  std::string whyNot;
};

// All denoisers of denoisers.list that are there, in its order.
const std::vector<const DenoiserInfo*>& denoiserRegistry();
// The others.
const std::vector<MissingDenoiser>& missingDenoisers();
// Throws Error (badUsage) with the nearest name, or with the reason why it is missing.
const DenoiserInfo& findDenoiser(const std::string& name);

}  // namespace restlab
