// Registers `restir_di`: its parameters, its summary and its probe.
//
// One reservoir a pixel over film samples and points of lights (Bitterli et al. 2020): candidates
// by the light table and by the BSDF, visibility in the target, merged by generalised RIS with
// pairwise MIS (Lin et al. 2022). Light that comes by a second vertex is that of `path`.
#include "core/path_sample/method.h"
#include "core/path_sample/path_sample.h"
#include "core/path_sample/settings.h"

namespace restlab {

// Made by rl_add_path_probe (core/path_sample/pixel_donors.inl).
void restir_diSetsProbe(IntegratorInfo& info);

const IntegratorInfo& restir_diIntegratorInfo() {
  static const IntegratorInfo info = [] {
    IntegratorInfo i =
        pathReuseMethod("restir_di", rl::RL_DIRECT_RESERVOIR_UVEC4S, directParameters(), "");
    i.summary =
        "ReSTIR DI: one reservoir a pixel, of points of lights; other light as path has it, "
        "averaged in a still view";
    restir_diSetsProbe(i);
    i.reasonUnused = [ofPasses = i.reasonUnused](const std::string& name, const ParameterMap& p) {
      const bool isOfEstimates = name == "shading" || name == "max_reflectance_ratio";
      if (hasUnshadowedTarget(p) && (isOfEstimates || name == "mode"))
        return std::string("visibility is shading");
      return ofPasses(name, p);
    };
    return i;
  }();
  return info;
}

}  // namespace restlab
