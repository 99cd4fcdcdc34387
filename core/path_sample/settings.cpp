#include "core/path_sample/settings.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/frame/schema.h"

namespace restlab {

namespace {

struct PathSettings {
  uint32_t lightCandidates = 1;
  double roughnessLimit = 0.2;
  double maxJacobian = 10.0;
  uint32_t visibility = 0;
  std::string shift = "hybrid", criterion = "footprint";
  double footprint = 0.02;
};

const Schema<PathSettings>& schema() {
  static const Schema<PathSettings> all = {
      Parameter<PathSettings>(&PathSettings::lightCandidates, "light_candidates", Range{1, 64},
                              "light samples a pixel and frame, of which one is kept",
                              "1: the same rays as the path tracer"),
      Parameter<PathSettings>(&PathSettings::roughnessLimit, "roughness_limit", Range{0.0, 1.0},
                              "perceptual roughness below which x1 is not reused: own light alone "
                              "(counted); `restir_pt` "
                              "replays such vertices",
                              "Lin et al. 2022, section 6.5: 0.2")
          .beginsHistory(),
      Parameter<PathSettings>(
          &PathSettings::maxJacobian, "max_jacobian", Range{1.0, 1.0e6},
          "shifts whose Jacobian lies outside [1/x, x] are undefined, both ways",
          "symmetric rejection keeps the estimator unbiased; Falcor and RTXDI: 10; measured: "
          "docs/decisions/moving-confidence-cap.md"),
      Parameter<PathSettings>(
          &PathSettings::visibility, "visibility", Choices{"target", "shading"},
          "`target`: what is resampled includes visibility, a ray for each shift; `shading`: it "
          "does "
          "not, candidates are light samples alone, and the one that is shown is traced",
          "Bitterli et al. 2020, section 4; Wyman and Panteleev 2021")
          .beginsHistory(),
      Parameter<PathSettings>(
          &PathSettings::shift, "shift", Choices{"reconnection", "replay", "hybrid"},
          "`reconnection`: at x2, of paths through a smooth x1 or x2 direct light alone is reused; "
          "`replay`: all random numbers, but light samples are reconnected; `hybrid`: random "
          "numbers "
          "up to the first pair of vertices that connects",
          "Lin et al. 2022, section 7")
          .beginsHistory(),
      Parameter<PathSettings>(
          &PathSettings::criterion, "criterion", Choices{"footprint", "roughness"},
          "which pairs of rough vertices connect: those that are far enough apart for the density "
          "of "
          "the ray, or all",
          "Lin, Kettunen and Wyman 2026, equation 5; Lin et al. 2022, section 7.5")
          .beginsHistory(),
      Parameter<PathSettings>(&PathSettings::footprint, "connect_footprint", Range{1.0e-6, 1.0e3},
                              "least area that a ray stands for at a vertex that connects, in "
                              "percent of what a ray of the "
                              "camera stands for at x1, if it sent as many rays everywhere",
                              "Lin, Kettunen and Wyman 2026: 0.02")
          .beginsHistory()};
  return all;
}

// Parameters of one kind of methods.
std::vector<ParameterInfo> those(std::initializer_list<const char*> names) {
  std::vector<ParameterInfo> infos = schema().infos();
  std::erase_if(infos, [&](const ParameterInfo& info) {
    return std::find(names.begin(), names.end(), info.name) == names.end();
  });
  return infos;
}

}  // namespace

std::vector<ParameterInfo> pathParameters() {
  return those({"light_candidates", "roughness_limit", "max_jacobian"});
}

std::vector<ParameterInfo> replayParameters() {
  return those({"light_candidates", "roughness_limit", "max_jacobian", "shift", "criterion",
                "connect_footprint"});
}

std::vector<ParameterInfo> directParameters() {
  std::vector<ParameterInfo> infos = those({"light_candidates", "roughness_limit", "visibility"});
  for (ParameterInfo& info : infos) {
    if (info.name != "light_candidates") continue;
    info.defaultValue = int64_t{8};
    info.source = "Bitterli et al. 2020: 32";
  }
  return infos;
}

std::string replayReasonUnused(const std::string& name, const ParameterMap& parameters) {
  const PathSettings s = schema().read(parameters);
  const bool isOfPairs = name == "criterion" || name == "connect_footprint";
  if (isOfPairs && s.shift != "hybrid") return "shift is not hybrid";
  if (name == "connect_footprint" && s.criterion != "footprint")
    return "criterion is not footprint";
  if (name == "max_jacobian" && s.shift == "replay") return "shift is replay";
  return "";
}

bool hasUnshadowedTarget(const ParameterMap& parameters) {
  return schema().read(parameters).visibility != 0;
}

rl::PathParams packPath(const ParameterMap& parameters) {
  const PathSettings s = schema().read(parameters);
  const auto roughness = float(s.roughnessLimit);
  rl::PathParams out{};
  out.lightCandidates = s.lightCandidates;
  out.minAlpha = roughness * roughness;
  out.maxJacobian = float(s.maxJacobian);
  out.unshadowedTarget = s.visibility;
  out.mostReplayed = s.shift == "reconnection" ? 0u : rl::RL_PATH_MOST_REPLAYED;
  if (s.shift == "hybrid" && s.criterion == "footprint") out.footprint = float(0.01 * s.footprint);
  // No pair of surfaces is wide enough.
  if (s.shift == "replay") out.footprint = std::numeric_limits<float>::max();
  return out;
}

}  // namespace restlab
