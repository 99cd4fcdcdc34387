// none: the frame as it was shaded. The session shows the radiance buffer itself, without a copy,
// so that a row of the table without a denoiser pays for none.
#include "core/frame/denoiser.h"

namespace restlab {

const DenoiserInfo& noneDenoiserInfo();

const DenoiserInfo& noneDenoiserInfo() {
  static const DenoiserInfo info = [] {
    DenoiserInfo i;
    i.name = "none";
    i.summary = "the frame as it was shaded";
    i.why = "nothing is changed";
    return i;
  }();
  return info;
}

}  // namespace restlab
