// Settings that a page can change beside the choice of a method and its parameters: light that is
// shown, light transport, and what it is computed with. Commands, controls, the page's address and
// saved sessions are made from these lists.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/frame/session.h"

namespace restlab {

class CompiledScene;  // core/scene/compiled/compiled_scene.h
struct Method;        // core/frame/method.h
struct PaneSettings;  // experiments/view/view_settings.h

struct PageSetting {
  ParameterInfo info;
  std::string group;  // heading of its control
  std::function<ParameterValue(const SessionConfig&)> get;
  std::function<void(SessionConfig&, const ParameterValue&)> set;
};

// Settings of all panes and of the reference.
const std::vector<PageSetting>& sharedSettings();
// Settings of each pane. The default of the seed is that of the command line; a viewer's is
// LiveView::firstSeed().
const std::vector<PageSetting>& paneSettings();

// A parameter with the heading of its control: the method's own come first, then those of the
// passes of reuse, of the cache, of the denoiser, and of parts that several methods have.
struct GroupedParameter {
  std::string group, summary;  // of the group
  ParameterInfo info;
};
std::vector<GroupedParameter> groupedParameters(const Method& method);

// Value of a shared setting: that of the panes for which it is meant.
ParameterValue sharedValue(const PageSetting& setting, const std::vector<PaneSettings>& panes);

// Returns why a setting of sharedSettings() has no effect in panes of these configurations; "": it
// has one.
std::string whyUnused(const PageSetting& setting, const std::vector<SessionConfig>& panes,
                      const CompiledScene& scene);
// Returns why the mode ("mode") and parameters of the pane's method have no effect, by name. Those
// that have one are absent.
std::map<std::string, std::string> unusedParameters(const SessionConfig& pane);

}  // namespace restlab
