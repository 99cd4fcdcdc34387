// Registers `restir_gi`: its parameters, its summary and its probe.
//
// One reservoir a pixel over film samples and paths: light samples at x1 (Bitterli et al. 2020) and
// paths that reconnect at x2 (Ouyang et al. 2021), merged by generalised RIS with pairwise
// MIS (Lin et al. 2022). The film sample is part of the path, as in
// Area ReSTIR (Zhang et al. 2024): a shift traces x1 anew. Unlike the GI paper, x2 is re-evaluated
// for the new direction, BSDF and MIS weight, so that glossy x2 are unbiased too.
#include "core/path_sample/method.h"
#include "core/path_sample/settings.h"

namespace restlab {

// Made by rl_add_path_probe (core/path_sample/pixel_donors.inl).
void restir_giSetsProbe(IntegratorInfo& info);

const IntegratorInfo& restir_giIntegratorInfo() {
  static const IntegratorInfo info = [] {
    IntegratorInfo i = pathReuseMethod("restir_gi", rl::RL_PATH_RESERVOIR_UVEC4S, pathParameters(),
                                       "BSDF and MIS weight at x2 are re-evaluated, ");
    i.summary =
        "ReSTIR GI: one reservoir a pixel, of light samples and of paths that reconnect at x2";
    restir_giSetsProbe(i);
    return i;
  }();
  return info;
}

}  // namespace restlab
