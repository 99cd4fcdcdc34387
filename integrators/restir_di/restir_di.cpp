// Host side of `restir_di`: the declaration of its bias, and what a reservoir holds, for people.
//
// One reservoir a pixel over film samples and points of lights (Bitterli et al. 2020): candidates
// by the light table and by the BSDF, visibility in the target, merged by generalised RIS with
// pairwise MIS (Lin et al. 2022). Light that comes by a second vertex is that of `path`.
#include <fmt/format.h>

#include <bit>

#include "core/path_sample/method.h"
#include "core/path_sample/path_sample.h"
#include "core/path_sample/settings.h"

namespace restlab {

namespace {

// Words as core/path_sample/direct_words.glsl lays them out.
std::vector<ProbeValue> probe(const FrameSnapshot& snapshot, size_t pixel) {
  constexpr size_t kWords = 4 * rl::RL_DIRECT_RESERVOIR_UVEC4S;
  const auto words = snapshot.words("reservoir_history").subspan(kWords * pixel, kWords);
  std::vector<ProbeValue> values = weightProbe(words[2], words[3]);
  if (std::bit_cast<float>(words[2]) > 0.0f)
    values.push_back({"light", fmt::format("{}", words[0] & 0xfffffffu)});
  return values;
}

}  // namespace

const IntegratorInfo& restir_diIntegratorInfo() {
  static const IntegratorInfo info = [] {
    IntegratorInfo i =
        pathReuseMethod("restir_di", rl::RL_DIRECT_RESERVOIR_UVEC4S, directParameters(), "");
    i.summary =
        "ReSTIR DI: one reservoir a pixel, of points of lights; other light as path has it, "
        "averaged in a still view";
    i.probe = probe;
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
