#include "experiments/view/probe_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "core/frame/method.h"

namespace restlab {

namespace {

using Json = nlohmann::ordered_json;

// Not named "radiance": a reservoir has a value of that name.
constexpr const char* kShown = "shaded radiance";
constexpr const char* kShownHelp = "what the frame shows: R, G, B";

// Splits a value into numbers: "0.5 1 2 m" of the unit m is three numbers. A value that is not
// numeric stays a text.
Json valueJson(std::string text, const std::string& unit) {
  if (!unit.empty() && text.ends_with(" " + unit)) text.resize(text.size() - unit.size() - 1);
  std::istringstream words(text);
  Json numbers = Json::array();
  for (std::string word; words >> word;) {
    double number = 0.0;
    const char* end = word.data() + word.size();
    const auto read = std::from_chars(word.data(), end, number);
    if (read.ec != std::errc() || read.ptr != end) return text;
    numbers.push_back(std::isfinite(number) ? Json(number) : Json(nullptr));
  }
  if (numbers.empty()) return text;
  return numbers.size() == 1 ? numbers.front() : numbers;
}

}  // namespace

std::vector<ProbeValue> probedValues(const Session& session, uint32_t x, uint32_t y) {
  std::vector<ProbeValue> values = session.probe(x, y);
  const glm::vec3& shown = session.radiance().at(x, y);
  values.insert(values.begin(),
                {kShown, fmt::format("{:.6g} {:.6g} {:.6g}", shown.x, shown.y, shown.z)});
  return values;
}

Json probedValuesJson(const Session& session, uint32_t x, uint32_t y) {
  const Method method = findMethod(session.config());
  Json all = Json::array();
  for (const ProbeValue& value : probedValues(session, x, y)) {
    std::string unit, help = value.name == kShown ? kShownHelp : "";
    for (const LayerInfo* layer : method.layers()) {
      if (layer->name != value.name) continue;
      unit = layer->unit;
      help = layer->summary;
    }
    all.push_back({{"name", value.name},
                   {"value", valueJson(value.value, unit)},
                   {"unit", unit},
                   {"help", help}});
  }
  return all;
}

std::string probedDonorsText(const Session& session, uint32_t x, uint32_t y) {
  std::string text;
  for (const Donor& donor : session.donors(x, y)) {
    const size_t width = session.config().width;
    text += donor.reuse == "entry"
                ? fmt::format("donor entry {}", donor.id)
                : fmt::format("donor {} {},{}", donor.reuse, donor.id % width, donor.id / width);
    text += fmt::format(": {}, confidence {:.6g}", donor.shift, donor.confidence);
    const auto add = [&](const char* name, const std::optional<double>& number) {
      if (number) text += fmt::format(", {} {:.6g}", name, *number);
    };
    add("MIS weight", donor.misWeight);
    add("share", donor.share);
    add("Jacobian", donor.jacobian);
    text += donor.isSelected ? ", selected\n" : "\n";
  }
  return text;
}

Json probedDonorsJson(const Session& session, uint32_t x, uint32_t y) {
  const auto orNull = [](const std::optional<double>& number) {
    return number && std::isfinite(*number) ? Json(*number) : Json(nullptr);
  };
  Json all = Json::array();
  for (const Donor& donor : session.donors(x, y)) {
    const size_t width = session.config().width;
    Json one = {{"reuse", donor.reuse}};
    if (donor.reuse == "entry") {
      one["entry"] = donor.id;
    } else {
      one["x"] = donor.id % width;
      one["y"] = donor.id / width;
    }
    one["shift"] = donor.shift;
    one["confidence"] = donor.confidence;
    one["mis_weight"] = orNull(donor.misWeight);
    one["share"] = orNull(donor.share);
    one["jacobian"] = orNull(donor.jacobian);
    one["selected"] = donor.isSelected;
    all.push_back(std::move(one));
  }
  return all;
}

std::string probedPathText(const Session& session, uint32_t x, uint32_t y) {
  std::string text;
  for (const PathVertex& v : session.path(x, y)) {
    text += fmt::format("path {}: {} at {:.6g} {:.6g} {:.6g}{}", v.name,
                        v.isReconnected ? "reconnected" : "replayed", v.posW.x, v.posW.y, v.posW.z,
                        v.isDirection ? " (direction)" : "");
    text += v.film ? fmt::format(", on the film at {:.4g},{:.4g}\n", v.film->x, v.film->y)
                   : ", behind the camera\n";
  }
  return text;
}

Json probedPathJson(const Session& session, uint32_t x, uint32_t y) {
  Json all = Json::array();
  for (const PathVertex& v : session.path(x, y)) {
    all.push_back({{"name", v.name},
                   {"position", {v.posW.x, v.posW.y, v.posW.z}},
                   {"film", v.film ? Json({v.film->x, v.film->y}) : Json(nullptr)},
                   {"direction", v.isDirection},
                   {"reconnected", v.isReconnected}});
  }
  return all;
}

}  // namespace restlab
