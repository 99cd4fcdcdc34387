// Host side of `bdpt`, the second estimator of the truth.
#include "integrators/bdpt/bdpt.h"

#include "core/frame/frame_graph.h"
#include "core/frame/integrator.h"
#include "core/frame/schema.h"

namespace restlab {

namespace {

struct BdptSettings {
  std::string heuristic = "power";
  std::string strategy = "all";
  bool causticsOfPoints = false;
};

const Schema<BdptSettings>& bdptSchema() {
  using S = BdptSettings;
  using P = Parameter<S>;
  static const Schema<S> all = {
      P(&S::heuristic, "heuristic", Choices{"power", "balance", "none"},
        "weights of the strategies; none: of one strategy alone", "Veach 1997, section 9.2")
          .sameMean(),
      P(&S::strategy, "strategy", Choices{"all", "emission", "light", "connect", "splat"},
        "shows the share of one kind of strategy: the camera's path meets a light, is joined to a "
        "point of one or to a light's path, or a light's path is joined to the camera",
        "all"),
      P(&S::causticsOfPoints, "caustics_of_points",
        "light of points, spots and suns that smooth glass or a mirror sends to rough surfaces; "
        "`path` leaves it out",
        "off: the image of all methods")};
  return all;
}

uint32_t strategiesOf(const BdptSettings& s) {
  if (s.strategy == "emission") return rl::RL_BDPT_EMISSION;
  if (s.strategy == "light") return rl::RL_BDPT_LIGHT;
  if (s.strategy == "connect") return rl::RL_BDPT_CONNECT;
  if (s.strategy == "splat") return rl::RL_BDPT_SPLAT;
  return rl::RL_BDPT_ALL;
}

uint32_t exponentOf(const BdptSettings& s) {
  if (s.heuristic == "balance") return rl::RL_BDPT_BALANCE;
  // Without weights all strategies together would count each path several times.
  const bool isAlone = s.heuristic == "none" && s.strategy != "all";
  return isAlone ? rl::RL_BDPT_ALONE : rl::RL_BDPT_POWER;
}

void recordBdpt(FrameGraph& g, const FrameInfo& f) {
  const BdptSettings s = bdptSchema().read(f.parameters);
  const rl::BdptParams params = {.exponent = exponentOf(s),
                                 .strategies = strategiesOf(s),
                                 .causticsOfPoints = s.causticsOfPoints ? 1u : 0u};
  const Buffer blocks = g.buffer("bdpt_blocks", rl::RL_BDPT_BLOCKS * rl::RL_BDPT_BLOCK_FLOATS, 4);
  const Buffer table = g.buffer("bdpt_table", rl::RL_BDPT_TABLE_WORDS, 4);
  const Buffer splats = g.buffer("bdpt_splats", f.pixels * rl::RL_BDPT_SPLAT_WORDS, 4);
  const Buffer radiance = g.buffer("radiance", f.pixels, sizeof(glm::vec3));
  const Kernels kernels = g.kernels<rl::BdptBuffers>(params, {blocks, table, splats, radiance});
  kernels.pass("bdpt_clear", "bdpt_clear").writes({splats});
  kernels.pass("bdpt_lights", "bdpt_lights").writes({blocks}).over(rl::RL_BDPT_BLOCKS);
  kernels.pass("bdpt_table", "bdpt_table").reads({blocks}).writes({table}).over(1);
  kernels.pass("bdpt", "bdpt").reads({table}).updates({splats}).writes({radiance});
  kernels.pass("bdpt_resolve", "bdpt_resolve").reads({table, splats}).updates({radiance});
  g.shared.radiance = radiance;
}

BiasClass biasOfBdpt(const std::string&, const ParameterMap& parameters) {
  return bdptSchema().read(parameters).strategy == "all" ? BiasClass::unbiased : BiasClass::biased;
}

std::string bdptUnused(const std::string& name, const ParameterMap& parameters) {
  const BdptSettings s = bdptSchema().read(parameters);
  if (name == "heuristic" && s.heuristic == "none" && s.strategy == "all")
    return "strategy = all needs weights: power";
  if (name == "light_choice") return "lamps are chosen by power";
  return "";
}

}  // namespace

const IntegratorInfo& bdptIntegratorInfo() {
  static const IntegratorInfo info = [] {
    IntegratorInfo i;
    i.name = "bdpt";
    i.summary =
        "bidirectional path tracing: paths from lights and from the camera, joined in all ways";
    i.modes = {{"unbiased", BiasClass::unbiased,
                "every path up to max_bounces scattering events has positive density in one "
                "strategy, and the weights of the strategies sum to one"}};
    i.parameters = bdptSchema().infos();
    i.biasOfParameters = biasOfBdpt;
    i.reasonUnused = bdptUnused;
    i.record = recordBdpt;
    return i;
  }();
  return info;
}

}  // namespace restlab
