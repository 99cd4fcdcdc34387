// Settings of light transport that all methods of a comparison share. Options, keys of suites,
// metadata, records, columns and the viewer's controls are made from transportSchema().
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/dialect/types.h"
#include "core/frame/schema.h"

namespace restlab {

// How a receiver chooses among the lamps of a scene: by their power alone, or by a hierarchy that
// knows the receiver.
constexpr uint32_t kLightChoicePower = 0, kLightChoiceTree = 1;

struct TransportSettings {
  uint32_t maxBounces = 8;  // scattering events
  bool russianRoulette = false;
  uint32_t pixelFilter = rl::RL_FILTER_BOX;
  bool multiscatter = false;
  uint32_t lightChoice = kLightChoicePower;

  bool operator==(const TransportSettings&) const = default;
};

const Schema<TransportSettings>& transportSchema();

// Names and texts of the settings, in the order of the schema. `ofMean`: only those that change the
// expected image.
std::vector<std::pair<std::string, std::string>> transportTexts(const TransportSettings& settings,
                                                                bool ofMean = false);

// Returns "max_bounces 8, russian_roulette off, ...".
std::string transportLine(const TransportSettings& settings);

// Returns "--max-bounces" for max_bounces; of a flag that is off, "--no-multiscatter".
std::string optionName(const std::string& setting, bool isOn = true);

// Settings of a reference: those that leave the expected image as it is have their defaults.
TransportSettings referenceTransport(TransportSettings settings);

// Text of a setting's value in metadata and tables: "on" and "off" for flags, else parameterText().
std::string settingText(const ParameterValue& value);

}  // namespace restlab
