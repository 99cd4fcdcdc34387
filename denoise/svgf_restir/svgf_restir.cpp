// svgf_restir: `svgf` for radiance whose frames share samples. Moments of such frames say that they
// vary several times less than they do, and averaging them again brings little.
#include "denoise/svgf/svgf_info.h"

namespace restlab {

const DenoiserInfo& svgf_restirDenoiserInfo();

const DenoiserInfo& svgf_restirDenoiserInfo() {
  static const DenoiserInfo info = makeSvgf(
      {"svgf_restir", "svgf that knows that resampled frames share samples", "differences", true});
  return info;
}

}  // namespace restlab
