// Makes the command line that renders a probed pixel again.
#include <fmt/format.h>

#include "experiments/runner/base/build_info.h"
#include "experiments/runner/run/render_command.h"
#include "experiments/view/view_session.h"

namespace restlab {

std::string probeCommand(const ViewFacts& facts, const LiveView& view, const Probe& probe) {
  const PreparedScene& loaded = view.loaded();
  const ViewSettings& settings = view.settings();
  const SceneCamera& own = loaded.scene->source().cameras.at(loaded.camera);
  if (!settings.lights.empty() || !settings.materials.empty() ||
      !isSameCamera(own, settings.camera) || !view.hasPlainHistory(probe.pane))
    return "";
  const SessionConfig& config = settings.panes.at(probe.pane).config;
  std::vector<std::string> words =
      renderWords(facts.request, settings.panes.front().config, config);
  for (const std::string& word : {std::string("--pixel"), fmt::format("{},{}", probe.x, probe.y),
                                  std::string("--seed"), std::to_string(config.seed),
                                  std::string("--frame"), std::to_string(view.frames(probe.pane))})
    words.push_back(word);
  return shellCommand(words);
}

}  // namespace restlab
