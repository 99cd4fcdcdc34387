#include "core/temporal_gradients/settings.h"

#include "core/frame/frame_graph.h"
#include "core/frame/schema.h"
#include "core/temporal_gradients/passes.h"

namespace restlab {

namespace {

struct ChangeSettings {
  uint32_t every = 0;
  double response = 4.0;
};

const Schema<ChangeSettings>& schema() {
  static const Schema<ChangeSettings> all = {
      Parameter<ChangeSettings>(
          &ChangeSettings::every, kValidateEvery, Range{0, 4096},
          "one of so many pixels traces its path of the last frame again each frame; where it "
          "finds "
          "other light, histories around it forget; 0: none does",
          "Schied et al. 2018 trace one of nine; 0: of no use where no light changes"),
      Parameter<ChangeSettings>(
          &ChangeSettings::response, "validate_response", Range{0.0, 1000.0},
          "share of a history that is forgotten, over the share of the light around that has "
          "changed",
          "measured: docs/decisions/temporal-gradients.md")};
  return all;
}

void recordChanges(FrameGraph& g, const FrameInfo& f) {
  const rl::ChangePassParams params{packChanges(f.parameters)};
  const size_t groups = f.groups(params.changes.every);
  const Buffer found = g.buffer("change_found", groups, 2 * sizeof(uint32_t));
  const Buffer differences = g.buffer("change_differences", groups, 2 * sizeof(uint32_t));
  const Buffer changes = g.buffer("changes", groups, sizeof(uint32_t));
  const Kernels kernels = g.kernels<rl::ChangeBuffers>(params, {found, differences, changes});
  kernels.pass("replay", "changes_trace")
      .over(groups)
      .writes({differences})
      .updates({found})
      .replays();
  kernels.pass("changes", "changes_share").over(groups).reads({differences}).writes({changes});
  g.shared.changes = changes;
}

}  // namespace

const PartInfo& changesPartInfo() {
  static const PartInfo info = [] {
    PartInfo i;
    i.name = "changes";
    i.summary = "light that has changed, by paths that are traced again";
    i.parameters = schema().infos();
    i.enabledIf.parameter = kValidateEvery;
    i.hasHistory = true;
    i.record = recordChanges;
    i.reasonUnused = [](const std::string& name, const ParameterMap& p) -> std::string {
      const bool isOff = schema().read(p).every == 0;
      return name == "validate_response" && isOff ? "validate_every is 0" : "";
    };
    return i;
  }();
  return info;
}

rl::ChangeParams packChanges(const ParameterMap& parameters) {
  const ChangeSettings s = schema().read(parameters);
  return {s.every, float(s.response)};
}

}  // namespace restlab
