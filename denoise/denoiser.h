// What stands between the shaded radiance and the frame that is shown. The list is
// denoise/denoisers.list: a folder and a line add one.
#pragma once

#include <string>
#include <vector>

namespace restlab {

struct DenoiserInfo {
  std::string name;     // of its folder, as in SessionConfig::denoiser
  std::string summary;  // one line
};

// All denoisers of denoisers.list, in its order.
const std::vector<const DenoiserInfo*>& denoiserRegistry();

}  // namespace restlab
