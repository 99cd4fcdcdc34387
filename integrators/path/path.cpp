// Host side of `path`, the yardstick that every ratio is measured against.
#include "integrators/path/path.h"

#include "core/frame/integrator.h"
#include "core/radiance_cache/settings.h"

namespace restlab {

const IntegratorInfo& pathIntegratorInfo() {
  static const IntegratorInfo info = [] {
    IntegratorInfo i;
    i.name = "path";
    i.summary =
        "1 path per pixel and frame; light and BSDF sampling with multiple importance sampling";
    i.modes = {{"unbiased", BiasClass::unbiased,
                "every path up to max_bounces scattering events has positive density in one "
                "technique, and the "
                "power-heuristic weights sum to one"}};
    i.endsPaths = true;
    i.optionalInputs = radianceInputs();
    i.buffers = {{"radiance", sizeof(glm::vec3), 0, -1}};
    i.passes = {{"path", "path"}};
    i.packParameters = [](const std::string&, const ParameterMap& p) {
      return bytesOf(rl::PathKernelParams{packRadiance(p)});
    };
    return i;
  }();
  return info;
}

}  // namespace restlab
