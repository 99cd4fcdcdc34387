// Every parameter of every method is taken by the command `parameter` of a page.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "experiments/view/view_settings.h"
#include "tests/runner/every_method.h"

namespace restlab {

namespace {

// Returns the command as a page sends it.
ViewCommand commandOf(nlohmann::json command, const std::string& name,
                      const ParameterValue& value) {
  command["name"] = name;
  std::visit([&](const auto& one) { command["value"] = one; }, value);
  return parseViewCommand(command.dump());
}

const nlohmann::json kParameter = {{"do", "parameter"}, {"pane", 0}};
const nlohmann::json kTransport = {{"do", "transport"}};

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
      settings = changedBy(commandOf(kParameter, info.name, wanted[info.name]), settings, choices)
                     .settings;
    }
    EXPECT_EQ(settings.panes[0].config.parameters, wanted);
    EXPECT_THROW(changedBy(commandOf(kParameter, "no_parameter", true), settings, choices), Error);
  }
}

// A setting of light transport is of all panes; the picture is another one, with another reference,
// if its expected image is.
TEST(EveryParameter, OfLightTransportIsTakenByTheViewer) {
  const Scene scene;
  const ViewChoices choices{&scene, {}};
  ViewSettings before;
  before.panes.resize(2);
  for (const ParameterInfo& info : transportSchema().infos()) {
    SCOPED_TRACE(info.name);
    const ParameterValue value = anotherValue(info);
    const ViewSettings after =
        changedBy(commandOf(kTransport, info.name, value), before, choices).settings;
    for (const PaneSettings& pane : after.panes)
      EXPECT_TRUE(pane.config == transportSchema().read({{info.name, value}}));
    EXPECT_FALSE(isSame(before, after));
    EXPECT_EQ(isSamePicture(before, after), info.sameMean);
  }
  EXPECT_THROW(changedBy(commandOf(kTransport, "max_bounces", int64_t{-1}), before, choices),
               Error);
  EXPECT_THROW(changedBy(commandOf(kTransport, "bounces", int64_t{1}), before, choices), Error);
}

}  // namespace

}  // namespace restlab
