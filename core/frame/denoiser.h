// Denoisers: the step from shaded radiance to the frame that is shown. A denoiser is a folder under
// denoise/, a line in denoise/denoisers.list, kernels (or a filter on the host) and one .cpp that
// defines `const DenoiserInfo& <name>DenoiserInfo()`.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/frame/host_filter.h"
#include "core/frame/part.h"

namespace restlab {

// Reads FrameBuffers::radiance, and the surfaces or features that it needs (PartInfo), and sets
// FrameBuffers::shown (12 bytes per pixel); one that sets nothing shows the radiance unchanged.
// Reservoirs and changes are there only in some methods.
struct DenoiserInfo : PartInfo {
  // Bias that the denoiser adds to the integrator's, for a still and for a moving camera.
  BiasClass biasOfStillView = BiasClass::unbiased;
  BiasClass biasOfMovingView = BiasClass::unbiased;
  std::string why;
  // Number of frames that a shown pixel averages once its history is old, if the integrator's
  // radiance averages `radianceFrames`; empty: the same number.
  std::function<double(const ParameterMap&, double radianceFrames)> shownFrames;
  // The image scales with the radiance only in a smaller range (core/base/radiance_range.h).
  bool comparesSquares = false;
  // For a denoiser without passes and buffers: makes the filter that runs on the host, with
  // `threads` threads (0: all cores) and resolved parameters. The filter's inputs are "radiance"
  // and the features, and it has no history.
  std::function<HostFilter(int threads, const ParameterMap&)> onHost;
};

// A denoiser of denoisers.list that this program was built without.
struct MissingDenoiser {
  std::string name;
  std::string summary;  // one line
  std::string whyNot;
};

// All denoisers of denoisers.list in this build, in its order.
const std::vector<const DenoiserInfo*>& denoiserRegistry();
// Denoisers of denoisers.list that this build lacks.
const std::vector<MissingDenoiser>& missingDenoisers();
// Throws Error (badUsage) with the nearest name if the denoiser is unknown, or with the reason if
// it is missing.
const DenoiserInfo& findDenoiser(const std::string& name);

}  // namespace restlab
