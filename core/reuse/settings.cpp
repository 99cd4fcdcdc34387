#include "core/reuse/settings.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/frame/schema.h"
#include "core/resampling/pair_settings.h"
#include "core/temporal_gradients/settings.h"

namespace restlab {

namespace {

struct ReuseSettings {
  double confidenceCap = 20.0;
  double movingConfidenceCap = 8.0;
  uint32_t spatialNeighbours = 3;
  uint32_t agedNeighbours = 1;
  uint32_t spatialRounds = 1;
  double youngFrames = 8.0;
  double donorNoise = 0.5;
  uint32_t lightEdgeSamples = 8;
  bool temporal = true;
  bool reproject = true;
  bool spatialFeedback = true;
  bool duplicationMap = false;
  double maxReflectanceRatio = 4.0;
  std::string shading = "control_variate";
  std::string mis = "pairwise";

  // Age that a history reaches: a history of n still frames has the age min(n, cap) + 1.
  double oldest() const { return temporal ? confidenceCap + 1.0 : 1.0; }
};

const Schema<ReuseSettings>& schema() {
  static const Schema<ReuseSettings> all = {
      Parameter<ReuseSettings>(
          &ReuseSettings::confidenceCap, "confidence_cap", Range{1.0, 1000.0},
          "confidence that a donor from the last frame may carry in a still view, in frames",
          "Lin et al. 2022 and its implementations: 20"),
      Parameter<ReuseSettings>(
          &ReuseSettings::movingConfidenceCap, "moving_confidence_cap", Range{1.0, 1000.0},
          "the same in frames of a new view, where it is at most confidence_cap: a sample that is "
          "rarely found from where the donor was gets up to that many times its weight",
          "measured: docs/decisions/moving-confidence-cap.md"),
      Parameter<ReuseSettings>(
          &ReuseSettings::spatialNeighbours, "spatial_neighbours", Range{0, rl::RL_MAX_DONORS},
          "donors of the spatial pass while the history is young: the view moves, or has been "
          "still for fewer frames than young_frames",
          "each costs a shift, two rays a pixel and a replayed prefix; measured: "
          "docs/decisions/donors-by-age.md"),
      Parameter<ReuseSettings>(
          &ReuseSettings::agedNeighbours, "aged_neighbours", Range{0, rl::RL_MAX_DONORS},
          "donors of the spatial pass afterwards, where spatial_neighbours is not less",
          "measured: docs/decisions/donors-by-age.md"),
      Parameter<ReuseSettings>(
          &ReuseSettings::spatialRounds, "spatial_rounds", Range{1, 4},
          "merges with neighbours in a frame, one after another, each with other neighbours",
          "Bitterli et al. 2020: one or two; measured: docs/ablation.md"),
      Parameter<ReuseSettings>(
          &ReuseSettings::youngFrames, "young_frames", Range{0.0, 1000.0},
          "frames of a still view up to which histories are young",
          "about the age from which young histories gain no more (docs/performance.md); not swept"),
      Parameter<ReuseSettings>(
          &ReuseSettings::donorNoise, "donor_noise", Range{0.0, 1000.0},
          "how fast a donor's share falls with the age of the history: 1 / (1 + this x (age - 1))",
          "core/resampling/donors.glsl; measured: docs/decisions/donors-by-age.md"),
      Parameter<ReuseSettings>(
          &ReuseSettings::lightEdgeSamples, "light_edge_samples", Range{0, 64},
          "samples of the light in view in pixels where a lamp ends, or its image in a mirror, in "
          "frames of a new view; 0: none but the path's",
          "core/reuse/light_edges.glsl; measured: docs/decisions/images-of-lamps.md"),
      Parameter<ReuseSettings>(&ReuseSettings::temporal, "temporal", "temporal reuse",
                               "Ouyang et al. 2021"),
      Parameter<ReuseSettings>(
          &ReuseSettings::reproject, "reproject",
          "in frames of a new view, the pixel of the last frame that showed the surface is a donor",
          "Ouyang et al. 2021; false leaves what a cache in world space does alone"),
      Parameter<ReuseSettings>(
          &ReuseSettings::spatialFeedback, "spatial_feedback",
          "the history of a pixel is its last merge with spatial neighbours; false: what went into "
          "that merge, with one round the merge over time, so that neighbours' samples stay apart",
          "Bitterli et al. 2020 feed back; Lin et al. 2022 do, too"),
      Parameter<ReuseSettings>(
          &ReuseSettings::duplicationMap, "duplication_map",
          "a donor over time has a lower cap where other pixels of 17 x 17 hold the same sample: "
          "less correlation, but confidence then depends on samples, which is biased",
          "Lin, Kettunen and Wyman 2026"),
      Parameter<ReuseSettings>(
          &ReuseSettings::maxReflectanceRatio, "max_reflectance_ratio", Range{0.0, 1.0e6},
          "bound per channel on the ratio of reflectances by which a donor's per-channel estimate "
          "is "
          "scaled; any bound is unbiased, a large one carries noise, 0 carries nothing",
          "control variate: core/resampling/merge.glsl; docs/decisions/control-variates.md"),
      Parameter<ReuseSettings>(
          &ReuseSettings::shading, "shading", Choices{"winner", "decoupled", "control_variate"},
          "what is shown: the selected sample, the weighted sum of all inputs, or that sum with "
          "the inputs' per-channel estimates carried along",
          "decoupled: Wyman and Panteleev 2021; control variate: core/resampling/merge.glsl"),
      Parameter<ReuseSettings>(
          &ReuseSettings::mis, "mis", Choices{"pairwise", "defensive", "confidence"},
          "resampling MIS weights; `defensive` favours the pixel's own sample, `confidence` is "
          "1/M, "
          "biased and darker",
          "Lin et al. 2022, section 5.4; Wyman et al. 2023, algorithm 7; Bitterli et al. 2020")};
  return all;
}

bool isOneOf(const std::string& name, std::initializer_list<const char*> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

std::vector<ParameterInfo> reuseParameters() {
  std::vector<ParameterInfo> infos = schema().infos();
  append(infos, pairParameters());
  return infos;
}

rl::ReuseParams packReuse(const ParameterMap& parameters, bool assumesVisible) {
  const ReuseSettings s = schema().read(parameters);
  uint32_t flags = 0;
  if (s.mis != "confidence") flags |= rl::RL_REUSE_PAIRWISE;
  if (s.mis == "defensive") flags |= rl::RL_REUSE_DEFENSIVE;
  if (s.shading == "control_variate") flags |= rl::RL_REUSE_CONTROL_VARIATE;
  if (s.shading == "winner") flags |= rl::RL_REUSE_WINNER_ONLY;
  rl::ReuseParams out{};
  out.temporalFlags = flags;
  out.spatialFlags = flags;
  if (assumesVisible)
    out.temporalFlags |= rl::RL_REUSE_ASSUME_VISIBLE | rl::RL_REUSE_ASSUME_VISIBLE_HERE;
  out.spatialNeighbours = s.spatialNeighbours;
  out.agedNeighbours = std::min(s.agedNeighbours, s.spatialNeighbours);
  out.spatialRounds = s.spatialNeighbours == 0 ? 1 : s.spatialRounds;
  out.youngFrames =
      s.oldest() <= s.youngFrames ? rl::RL_INVALID : static_cast<uint32_t>(s.youngFrames);
  out.lightEdgeSamples = s.lightEdgeSamples;
  out.donorNoise = float(s.donorNoise);
  out.temporalReuse = s.temporal ? 1u : 0u;
  out.reproject = s.reproject ? 1u : 0u;
  out.spatialFeedback = s.spatialFeedback ? 1u : 0u;
  out.duplicationMap = s.duplicationMap ? 1u : 0u;
  out.confidenceCap = float(s.confidenceCap);
  out.movingConfidenceCap = std::min(out.confidenceCap, float(s.movingConfidenceCap));
  out.maxReflectanceRatio = float(s.maxReflectanceRatio);
  return out;
}

double reuseRadianceFrames(const ParameterMap& parameters) {
  return schema().read(parameters).oldest();
}

bool reuseIsBiased(const ParameterMap& parameters) {
  const ReuseSettings s = schema().read(parameters);
  return s.mis == "confidence" || (s.duplicationMap && s.temporal);
}

std::string reuseReasonUnused(const std::string& name, const ParameterMap& parameters) {
  const ReuseSettings s = schema().read(parameters);
  const uint32_t neighbours = s.spatialNeighbours;
  if (isOneOf(name, {"confidence_cap", "moving_confidence_cap", "donor_noise", "mode", "reproject",
                     "duplication_map", "spatial_feedback", kValidateEvery, "validate_response"}) &&
      !s.temporal)
    return "temporal is false";
  if (name == "mode" && !s.reproject) return "reproject is false";
  if (name == "moving_confidence_cap" && s.movingConfidenceCap > s.confidenceCap)
    return "confidence_cap is smaller";
  if (neighbours == 0 && isOneOf(name, {"aged_neighbours", "young_frames", "donor_noise",
                                        "spatial_rounds", "spatial_radius", "spatial_feedback"}))
    return "spatial_neighbours is 0";
  if (!s.temporal && neighbours == 0 &&
      isOneOf(name, {"mis", "max_jacobian", "max_reflectance_ratio", "normal_threshold",
                     "plane_threshold"}))
    return "temporal is false and spatial_neighbours is 0";
  if (name == "aged_neighbours" && s.agedNeighbours > neighbours)
    return "there are no more donors than spatial_neighbours says";
  if (name == "aged_neighbours" && s.youngFrames >= s.oldest())
    return fmt::format("young_frames is {:g}, and no history is older than {:g}", s.youngFrames,
                       s.oldest());
  if (name == "max_reflectance_ratio" && s.shading != "control_variate")
    return "shading is not control_variate";
  return "";
}

}  // namespace restlab
