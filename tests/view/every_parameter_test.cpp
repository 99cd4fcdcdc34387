// Every parameter of every method is taken by the command `parameter` of a page.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "experiments/view/view_settings.h"
#include "tests/runner/every_method.h"

namespace restlab {

namespace {

// Returns the command as a page sends it.
ViewCommand commandOf(const std::string& name, const ParameterValue& value) {
  nlohmann::json command = {{"do", "parameter"}, {"pane", 0}, {"name", name}};
  std::visit([&](const auto& one) { command["value"] = one; }, value);
  return parseViewCommand(command.dump());
}

TEST(EveryParameter, IsTakenByTheViewer) {
  const Scene scene;
  const ViewChoices choices{&scene, {}};
  for (const SessionConfig& config : everyMethod()) {
    SCOPED_TRACE(config.integrator + ", " + config.cache + ", " + config.denoiser);
    ViewSettings settings;
    settings.panes.push_back({config, ""});
    ParameterMap wanted;
    for (const ParameterInfo& info : findMethod(config).parameters()) {
      wanted[info.name] = anotherValue(info);
      settings = changedBy(commandOf(info.name, wanted[info.name]), settings, choices).settings;
    }
    EXPECT_EQ(settings.panes[0].config.parameters, wanted);
    EXPECT_THROW(changedBy(commandOf("no_parameter", true), settings, choices), Error);
  }
}

}  // namespace

}  // namespace restlab
