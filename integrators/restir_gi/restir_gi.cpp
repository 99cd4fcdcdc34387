// Host side of `restir_gi`: the declaration of its bias, and what a reservoir holds, for people.
//
// One reservoir a pixel over film samples and paths: light samples at x1 (Bitterli et al. 2020) and
// paths that reconnect at x2 (Ouyang et al. 2021), merged by generalised RIS with pairwise
// MIS (Lin et al. 2022). The film sample is part of the path, as in
// Area ReSTIR (Zhang et al. 2024): a shift traces x1 anew. Unlike the GI paper, x2 is re-evaluated
// for the new direction, BSDF and MIS weight, so that glossy x2 are unbiased too.
#include "integrators/restir_gi/restir_gi.h"

#include <fmt/format.h>

#include <bit>

#include "core/path_sample/method.h"
#include "core/path_sample/settings.h"
#include "integrators/restir_gi/pixel_donors.h"

namespace restlab {

namespace {

std::vector<ProbeValue> probe(const FrameSnapshot& snapshot, size_t pixel) {
  constexpr size_t kReservoir = 4 * rl::RL_PATH_RESERVOIR_UVEC4S;
  const auto own = snapshot.words("unresampled_radiance").subspan(4 * pixel, 3);
  std::vector<ProbeValue> values = {
      {"own light", fmt::format("{:.6g} {:.6g} {:.6g}", std::bit_cast<float>(own[0]),
                                std::bit_cast<float>(own[1]), std::bit_cast<float>(own[2]))}};
  for (ProbeValue& value :
       pathProbe(snapshot.words("reservoir_history").subspan(kReservoir * pixel, kReservoir)))
    values.push_back(std::move(value));
  return values;
}

}  // namespace

const IntegratorInfo& restir_giIntegratorInfo() {
  static const IntegratorInfo info = [] {
    IntegratorInfo i = pathReuseMethod("restir_gi", rl::RL_PATH_RESERVOIR_UVEC4S, pathParameters(),
                                       "BSDF and MIS weight at x2 are re-evaluated, ");
    i.summary =
        "ReSTIR GI: one reservoir a pixel, of light samples and of paths that reconnect at x2";
    i.probe = probe;
    i.donors = giDonorsOf;
    return i;
  }();
  return info;
}

}  // namespace restlab
