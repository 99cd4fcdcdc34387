// Host side of `path`, the baseline of every ratio.
#include "integrators/path/path.h"

#include "core/frame/frame_graph.h"
#include "core/frame/integrator.h"
#include "core/radiance_cache/settings.h"

namespace restlab {

namespace {

void recordPath(FrameGraph& g, const FrameInfo& f) {
  const FrameBuffers& s = g.shared;
  const Buffer radiance = g.buffer("radiance", f.pixels, sizeof(glm::vec3));
  g.kernels<rl::PathBuffers>(rl::PathKernelParams{packRadiance(f.parameters)},
                             {s.cellKeys, s.cellPlaces, s.cellLight, s.cellRays, radiance})
      .pass("path", "path")
      .reads({s.cellKeys, s.cellPlaces, s.cellLight})
      .writes({radiance})
      .updates({s.cellRays});
  g.shared.radiance = radiance;
}

}  // namespace

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
    i.record = recordPath;
    return i;
  }();
  return info;
}

}  // namespace restlab
