#include "core/temporal_gradients/settings.h"

#include <algorithm>

#include "core/temporal_gradients/passes.h"

namespace restlab {

const PartInfo& changesPartInfo() {
  static const PartInfo info = [] {
    PartInfo i;
    i.name = "changes";
    i.summary = "light that has changed, by paths that are traced again";
    i.parameters = {
        {kValidateEvery,
         int64_t{0},
         0,
         4096,
         {},
         "one of so many pixels traces its path of the last frame again each frame; where it finds "
         "other light, histories around it forget; 0: none does",
         "Schied et al. 2018 trace one of nine; 0: of no use where no light changes"},
        {"validate_response",
         4.0,
         0.0,
         1000.0,
         {},
         "share of a history that is forgotten, over the share of the light around that has "
         "changed",
         "measured: docs/decisions/temporal-gradients.md"}};
    i.enabledIf.parameter = kValidateEvery;
    i.hasHistory = true;
    i.buffers = {{"change_found", 2 * sizeof(uint32_t)},
                 {"change_differences", 2 * sizeof(uint32_t)},
                 {kChanges, sizeof(uint32_t)}};
    i.passes = {{"replay", "changes_trace"}, {"changes", "changes_share", false}};
    for (BufferInfo& buffer : i.buffers) buffer.onePerParameter = kValidateEvery;
    for (PassInfo& pass : i.passes) pass.onePerParameter = kValidateEvery;
    i.passes.front().isReplay = true;
    i.reasonUnused = [](const std::string& name, const ParameterMap& p) -> std::string {
      const bool isOff = std::get<int64_t>(p.at(kValidateEvery)) == 0;
      return name == "validate_response" && isOff ? "validate_every is 0" : "";
    };
    i.packParameters = [](const std::string&, const ParameterMap& p) {
      return bytesOf(rl::ChangePassParams{packChanges(p)});
    };
    return i;
  }();
  return info;
}

bool asksForChanges(const PartInfo& part) {
  return std::find(part.optionalInputs.begin(), part.optionalInputs.end(), kChanges) !=
         part.optionalInputs.end();
}

rl::ChangeParams packChanges(const ParameterMap& parameters) {
  return {uintOf(parameters, kValidateEvery), floatOf(parameters, "validate_response")};
}

}  // namespace restlab
