#include "core/frame/transport_settings.h"

#include <algorithm>

#include "core/frame/method_settings.h"

namespace restlab {

namespace {

constexpr double kMaxBounces = 1024.0;
// Choices are stored by their place.
static_assert(rl::RL_FILTER_BOX == 0 && rl::RL_FILTER_CENTER == 1);

}  // namespace

const Schema<TransportSettings>& transportSchema() {
  using S = TransportSettings;
  using P = Parameter<S>;
  static const Schema<S> schema = {
      P(&S::maxBounces, "max_bounces", Range{0.0, kMaxBounces},
        "scattering events; 0: emission only, 1: direct light", ""),
      P(&S::russianRoulette, "russian_roulette", "ends paths of little throughput at random",
        "Arvo and Kirk 1990")
          .sameMean(),
      P(&S::pixelFilter, "filter", Choices{"box", "center"},
        "pixel filter: a box of one pixel, or its center", ""),
      P(&S::multiscatter, "multiscatter",
        "rough reflection keeps the light that meets several microfacets", "Kulla and Conty 2017"),
      P(&S::lightChoice, "light_choice", Choices{"power", "tree"},
        "lamps are chosen by power, or by a hierarchy that knows the receiver",
        "Conty Estevez and Kulla 2018")
          .sameMean(),
  };
  return schema;
}

std::string settingText(const ParameterValue& value) {
  if (const bool* flag = std::get_if<bool>(&value)) return *flag ? "on" : "off";
  return parameterText(value);
}

std::vector<std::pair<std::string, std::string>> transportTexts(const TransportSettings& settings,
                                                                bool ofMean) {
  std::vector<std::pair<std::string, std::string>> texts;
  for (const ParameterInfo& info : transportSchema().infos(settings))
    if (!ofMean || !info.sameMean) texts.emplace_back(info.name, settingText(info.defaultValue));
  return texts;
}

std::string transportLine(const TransportSettings& settings) {
  std::string line;
  for (const auto& [name, text] : transportTexts(settings))
    line += (line.empty() ? "" : ", ") + name + " " + text;
  return line;
}

std::string optionName(const std::string& setting, bool isOn) {
  std::string name = (isOn ? "--" : "--no-") + setting;
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

TransportSettings referenceTransport(TransportSettings settings) {
  ParameterMap defaults;
  for (const ParameterInfo& info : transportSchema().infos())
    if (info.sameMean) defaults[info.name] = info.defaultValue;
  transportSchema().assign(settings, defaults);
  return settings;
}

}  // namespace restlab
