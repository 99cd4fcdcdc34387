// none: the frame as it was shaded. The session shows the radiance buffer itself, without a copy,
// so that a row of the table without a denoiser pays for none.
#include "denoise/denoiser.h"

namespace restlab {

const DenoiserInfo& noneDenoiserInfo();

const DenoiserInfo& noneDenoiserInfo() {
  static const DenoiserInfo info{"none", "the frame as it was shaded"};
  return info;
}

}  // namespace restlab
