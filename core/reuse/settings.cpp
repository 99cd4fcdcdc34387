#include "core/reuse/settings.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/resampling/pair_settings.h"
#include "core/temporal_gradients/settings.h"

namespace restlab {

std::vector<ParameterInfo> reuseParameters() {
  std::vector<ParameterInfo> infos = {
      {"confidence_cap",
       20.0,
       1.0,
       1000.0,
       {},
       "confidence that a donor from the last frame may carry in a still view, in frames",
       "Lin et al. 2022 and its implementations: 20"},
      {"moving_confidence_cap",
       8.0,
       1.0,
       1000.0,
       {},
       "the same in frames of a new view, where it is at most confidence_cap: a sample that is "
       "rarely found from where the donor was gets up to that many times its weight",
       "measured: docs/decisions/moving-confidence-cap.md"},
      {"spatial_neighbours",
       int64_t{3},
       0,
       rl::RL_MAX_DONORS,
       {},
       "donors of the spatial pass while the view is new: it moves, or was still for young_frames",
       "each costs a shift, two rays a pixel; measured: docs/decisions/donors-by-age.md"},
      {"aged_neighbours",
       int64_t{1},
       0,
       rl::RL_MAX_DONORS,
       {},
       "donors of the spatial pass afterwards, where spatial_neighbours is not less",
       "measured: docs/decisions/donors-by-age.md"},
      {"young_frames",
       8.0,
       0.0,
       1000.0,
       {},
       "frames of a still view up to which histories are young",
       "about the age from which young histories gain no more (docs/performance.md); not swept"},
      {"donor_noise",
       0.5,
       0.0,
       1000.0,
       {},
       "how fast a donor's share falls with the age of the history: 1 / (1 + this x (age - 1))",
       "core/resampling/donors.glsl; measured: docs/decisions/donors-by-age.md"},
      {"light_edge_samples",
       int64_t{8},
       0,
       64,
       {},
       "camera rays through pixels where a lamp in view ends, in frames of a new view; 0: none "
       "but "
       "the path's",
       "core/transport/lights_in_view.glsl; measured: docs/decisions/light-edge-samples.md"},
      {"temporal", true, 0, 0, {}, "temporal reuse", "Ouyang et al. 2021"},
      {"reproject",
       true,
       0,
       0,
       {},
       "in frames of a new view, the pixel of the last frame that showed the surface is a donor",
       "Ouyang et al. 2021; false leaves what a cache in world space does alone"},
      {"max_reflectance_ratio",
       4.0,
       0.0,
       1.0e6,
       {},
       "bound per channel on the ratio of reflectances by which a donor's per-channel estimate is "
       "scaled; any bound is unbiased, a large one carries noise, 0 carries nothing",
       "control variate: core/resampling/merge.glsl; docs/decisions/control-variates.md"},
      {"shading",
       std::string("control_variate"),
       0,
       0,
       {"winner", "decoupled", "control_variate"},
       "what is shown: the selected sample, the weighted sum of all inputs, or that sum with the "
       "inputs' "
       "per-channel estimates carried along",
       "decoupled: Wyman and Panteleev 2021; control variate: core/resampling/merge.glsl"},
      {"mis",
       std::string("pairwise"),
       0,
       0,
       {"pairwise", "defensive", "confidence"},
       "resampling MIS weights; `defensive` favours the pixel's own sample, `confidence` is 1/M, "
       "biased and darker",
       "Lin et al. 2022, section 5.4; Wyman et al. 2023, algorithm 7; Bitterli et al. 2020"},
  };
  for (ParameterInfo& info : pairParameters()) infos.push_back(std::move(info));
  return infos;
}

rl::ReuseParams packReuse(const ParameterMap& p, bool assumesVisible) {
  uint32_t flags = 0;
  const std::string& mis = textOf(p, "mis");
  if (mis != "confidence") flags |= rl::RL_REUSE_PAIRWISE;
  if (mis == "defensive") flags |= rl::RL_REUSE_DEFENSIVE;
  const std::string& shading = textOf(p, "shading");
  if (shading == "control_variate") flags |= rl::RL_REUSE_CONTROL_VARIATE;
  if (shading == "winner") flags |= rl::RL_REUSE_WINNER_ONLY;
  rl::ReuseParams out{};
  out.temporalFlags = flags;
  out.spatialFlags = flags;
  if (assumesVisible)
    out.temporalFlags |= rl::RL_REUSE_ASSUME_VISIBLE | rl::RL_REUSE_ASSUME_VISIBLE_HERE;
  out.spatialNeighbours = uintOf(p, "spatial_neighbours");
  out.neighboursLongHistory = std::min(uintOf(p, "aged_neighbours"), out.spatialNeighbours);
  // A history of n still frames before this one has the age min(n, cap) + 1.
  const double young = std::get<double>(p.at("young_frames"));
  const double oldest = reuseRadianceFrames(p);
  out.longHistoryFrames = oldest <= young ? rl::RL_INVALID : static_cast<uint32_t>(young);
  out.lightEdgeSamples = uintOf(p, "light_edge_samples");
  out.donorNoise = floatOf(p, "donor_noise");
  out.temporalReuse = boolOf(p, "temporal") ? 1u : 0u;
  out.reproject = boolOf(p, "reproject") ? 1u : 0u;
  out.confidenceCap = floatOf(p, "confidence_cap");
  out.movingConfidenceCap = std::min(out.confidenceCap, floatOf(p, "moving_confidence_cap"));
  out.maxReflectanceRatio = floatOf(p, "max_reflectance_ratio");
  return out;
}

double reuseRadianceFrames(const ParameterMap& p) {
  return boolOf(p, "temporal") ? std::get<double>(p.at("confidence_cap")) + 1.0 : 1.0;
}

bool reuseHasWrongWeights(const ParameterMap& p) { return textOf(p, "mis") == "confidence"; }

namespace {

bool isOneOf(const std::string& name, std::initializer_list<const char*> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::string reuseReasonUnused(const std::string& name, const ParameterMap& p) {
  const bool isOverTime = boolOf(p, "temporal");
  const int64_t neighbours = std::get<int64_t>(p.at("spatial_neighbours"));
  const double young = std::get<double>(p.at("young_frames"));
  const double oldest = isOverTime ? std::get<double>(p.at("confidence_cap")) + 1.0 : 1.0;
  if (isOneOf(name, {"confidence_cap", "moving_confidence_cap", "donor_noise", "mode", "reproject",
                     kValidateEvery, "validate_response"}) &&
      !isOverTime)
    return "temporal is false";
  if (name == "mode" && !boolOf(p, "reproject")) return "reproject is false";
  if (name == "moving_confidence_cap" &&
      std::get<double>(p.at(name)) > std::get<double>(p.at("confidence_cap")))
    return "confidence_cap is smaller";
  if (neighbours == 0 &&
      isOneOf(name, {"aged_neighbours", "young_frames", "donor_noise", "spatial_radius"}))
    return "spatial_neighbours is 0";
  if (!isOverTime && neighbours == 0 &&
      isOneOf(name, {"mis", "max_jacobian", "max_reflectance_ratio", "shading", "normal_threshold",
                     "plane_threshold"}))
    return "temporal is false and spatial_neighbours is 0";
  if (name == "aged_neighbours" && std::get<int64_t>(p.at("aged_neighbours")) > neighbours)
    return "there are no more donors than spatial_neighbours says";
  if (name == "aged_neighbours" && young >= oldest)
    return fmt::format("young_frames is {:g}, and no history is older than {:g}", young, oldest);
  if (name == "max_reflectance_ratio" && textOf(p, "shading") != "control_variate")
    return "shading is not control_variate";
  return "";
}

}  // namespace restlab
