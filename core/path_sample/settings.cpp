#include "core/path_sample/settings.h"

#include <fmt/format.h>

#include <array>
#include <bit>

#include "core/base/packing.h"
#include "core/frame/schema.h"

namespace restlab {

namespace {

struct PathSettings {
  uint32_t lightCandidates = 1;
  double roughnessLimit = 0.2;
  double maxJacobian = 10.0;
};

const Schema<PathSettings>& schema() {
  static const Schema<PathSettings> all = {
      Parameter<PathSettings>(&PathSettings::lightCandidates, "light_candidates", Range{1, 64},
                              "light samples a pixel and frame, of which one is kept",
                              "1: the same rays as the path tracer"),
      Parameter<PathSettings>(
          &PathSettings::roughnessLimit, "roughness_limit", Range{0.0, 1.0},
          "perceptual roughness below which x1 is not reused: own light alone (counted)",
          "Lin et al. 2022, section 6.5: 0.2")
          .beginsHistory(),
      Parameter<PathSettings>(
          &PathSettings::maxJacobian, "max_jacobian", Range{1.0, 1.0e6},
          "shifts whose Jacobian lies outside [1/x, x] are undefined, both ways",
          "symmetric rejection keeps the estimator unbiased; Falcor and RTXDI: 10; measured: "
          "docs/decisions/moving-confidence-cap.md")};
  return all;
}

std::string three(const glm::vec3& v) { return fmt::format("{:.6g} {:.6g} {:.6g}", v.x, v.y, v.z); }

float number(std::span<const uint32_t> words, size_t at) { return std::bit_cast<float>(words[at]); }

// Describes x2 or the light, as pathReservoirWrite() lays it out.
std::string endOf(std::span<const uint32_t> words, rl::Packing& packing) {
  const uint32_t kind = words[2] >> 24;
  const uint32_t light = kind >> rl::RL_PATH_LIGHT_SHIFT & rl::RL_PATH_LIGHT_MASK;
  const bool isLight = (kind & rl::RL_PATH_KIND_MASK) == rl::RL_PATH_DIRECT;
  if (isLight && light == rl::RL_LIGHT_ENVIRONMENT)
    return "direction " + three(packing.unpackUnit22(words[6] & 0xffffffu, words[7] & 0xffffffu));
  if (isLight && light != rl::RL_LIGHT_TRIANGLE) return fmt::format("light {}", words[0]);
  return fmt::format("instance {}, triangle {}, at {:.6g} {:.6g}", words[0], words[1],
                     packing.unpackUnorm24(words[2] & 0xffffffu),
                     packing.unpackUnorm24(words[3] & 0xffffffu));
}

}  // namespace

std::vector<ParameterInfo> pathParameters() { return schema().infos(); }

rl::PathParams packPath(const ParameterMap& parameters) {
  const PathSettings s = schema().read(parameters);
  const auto roughness = float(s.roughnessLimit);
  return {s.lightCandidates, roughness * roughness, float(s.maxJacobian)};
}

std::vector<ProbeValue> pathProbe(std::span<const uint32_t> words) {
  // From here on as reservoirStateWrite() lays it out.
  constexpr size_t kState = 4 * rl::RL_PATH_SAMPLE_UVEC4S;
  rl::Packing packing;
  static const std::array<const char*, 5> kinds = {
      "light at x1", "Lambert x2", "glossy x2, light sample", "glossy x2, emitter behind it",
      "glossy x2, continued"};
  // As pathReservoirWrite() lays it out.
  const uint32_t kind = words[2] >> 24, film = words[4];
  const float weight = number(words, kState + 2);
  std::vector<ProbeValue> values = {
      {"W", fmt::format("{:.6g}", weight)},
      {"F", three(packing.unpackPositive3(words[kState], words[kState + 1]))},
      {"residual", three(packing.unpackSigned3(words[kState + 4], words[kState + 5]))}};
  if (!(weight > 0.0f)) {
    values.push_back({"kind", "none: the reservoir is empty"});
    return values;
  }
  values.push_back({"kind", kinds.at(kind & rl::RL_PATH_KIND_MASK)});
  values.push_back({"film", fmt::format("{:.4f} {:.4f}", double(film & 0xffffu) / 65536.0,
                                        double(film >> 16) / 65536.0)});
  values.push_back({"end", endOf(words, packing)});
  values.push_back(
      {"radiance", three(packing.unpackPositive3(words[kState + 6], words[kState + 7]))});
  return values;
}

}  // namespace restlab
