// `svgf` and its kin: one filter under several names, with other defaults.
#pragma once

#include "core/frame/denoiser.h"

namespace restlab {

struct SvgfDefaults {
  std::string name;
  std::string summary;
  std::string variance;  // default of svgf_variance
  bool confidence = false;
  int64_t validateEvery = 0;  // default of the part that finds light that has changed
};
DenoiserInfo makeSvgf(const SvgfDefaults& defaults);

}  // namespace restlab
