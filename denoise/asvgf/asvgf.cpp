// asvgf: `svgf` whose histories forget light that has changed (Schied, Peters and Dachsbacher,
// "Gradient Estimation for Real-Time Adaptive Temporal Filtering", 2018). The paper estimates
// gradients for one pixel of nine and spreads them by wavelets; here core/temporal_gradients does
// both.
#include "denoise/svgf/svgf_info.h"

namespace restlab {

const DenoiserInfo& asvgfDenoiserInfo();

const DenoiserInfo& asvgfDenoiserInfo() {
  static const DenoiserInfo info =
      makeSvgf({"asvgf", "svgf that forgets light that has changed", "moments", false, 32});
  return info;
}

}  // namespace restlab
