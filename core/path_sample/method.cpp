#include "core/path_sample/method.h"

#include "core/caches/entries/settings.h"
#include "core/frame/schema.h"
#include "core/path_sample/path_reuse.h"
#include "core/path_sample/settings.h"
#include "core/radiance_cache/settings.h"
#include "core/resampling/pair_settings.h"
#include "core/reuse/layers.h"
#include "core/reuse/passes.h"
#include "core/reuse/settings.h"
#include "core/temporal_gradients/settings.h"

namespace restlab {

IntegratorInfo pathReuseMethod(const std::string& name, uint32_t reservoirUvec4s,
                               std::vector<ParameterInfo> ofPaths, const std::string& ofShift) {
  IntegratorInfo i;
  i.name = name;
  i.parameters = reuseParameters();
  append(i.parameters, std::move(ofPaths));
  i.modes = {
      {"unbiased", BiasClass::unbiased,
       "targets include visibility at every shading point, MIS weights sum to one over those who "
       "can produce a sample, " +
           ofShift +
           "confidences depend on shading points alone (near light that changed, with "
           "validate_every, on the change)"},
      {"biased", BiasClass::biased,
       "the last frame's sample is taken as visible here, and the pixel's own as visible from "
       "there: fewer rays, a little energy moved at shadow edges"},
  };
  i.usesCache = true;
  i.hasHistory = true;
  i.needsSurfaces = true;
  i.followsChanges = true;
  i.endsPaths = true;
  i.record = [sample = ReusedSample{name, reservoirUvec4s}](FrameGraph& g, const FrameInfo& f) {
    const ParameterMap& p = f.parameters;
    rl::PathReuseParams params{};
    params.reuse = packReuse(p, f.mode == "biased");
    params.reuse.writesRadianceFrames = f.wantsRadianceFrames ? 1u : 0u;
    params.path = packPath(p);
    params.pairs = packPairs(p);
    params.entries = packEntries(p);
    params.cells = packRadiance(p);
    params.changes = packChanges(p);
    recordReuse(g, f, sample, params.reuse, params.entries, bytesOf(params));
  };
  i.reasonUnused = reuseReasonUnused;
  i.radianceFrames = reuseRadianceFrames;
  i.layers = reuseLayers(reservoirUvec4s);
  i.biasOfParameters = [](const std::string& mode, const ParameterMap& p) {
    return mode == "biased" || reuseIsBiased(p) ? BiasClass::biased : BiasClass::unbiased;
  };
  return i;
}

}  // namespace restlab
