// svgf_restir: `svgf` for radiance whose frames share samples. Moments of such frames underestimate
// their variance several times, and averaging the frames again brings little.
#include "denoise/svgf/svgf_info.h"

namespace restlab {

const DenoiserInfo& svgf_restirDenoiserInfo();

const DenoiserInfo& svgf_restirDenoiserInfo() {
  static const DenoiserInfo info = makeSvgf(
      {"svgf_restir", "svgf that knows that resampled frames share samples", "differences", true});
  return info;
}

}  // namespace restlab
