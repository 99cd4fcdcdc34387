#include "experiments/view/command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/base/error.h"
#include "experiments/runner/suite/image_settings.h"

namespace restlab {

namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kMostCharacters = 256;  // length limit of a string
constexpr uint32_t kMostSeenPanes = 64;  // those that bits have room for

// Reads the members of a command. expectNoMore() refuses members that were never read.
class Members {
 public:
  explicit Members(const Json& json) : json_(json) { name_ = text("do"); }

  const std::string& name() const { return name_; }
  bool has(const char* key) {
    known_.emplace_back(key);
    return json_.contains(key);
  }

  const Json& at(const char* key) {
    if (!has(key)) fail(fmt::format("'{}' is missing", key));
    return json_.at(key);
  }

  std::string text(const char* key) {
    const Json& value = at(key);
    if (!value.is_string() || value.get_ref<const std::string&>().size() > kMostCharacters)
      fail(fmt::format("'{}' must be a text of at most {} bytes", key, kMostCharacters));
    return value.get<std::string>();
  }

  bool flag(const char* key) {
    const Json& value = at(key);
    if (!value.is_boolean()) fail(fmt::format("'{}' must be true or false", key));
    return value.get<bool>();
  }

  double number(const char* key, double lo, double hi) {
    return numberOf(at(key), fmt::format("'{}'", key), lo, hi);
  }

  uint32_t whole(const char* key, uint32_t lo, uint32_t hi) {
    const Json& value = at(key);
    if (!value.is_number_integer() || value < lo || value > hi)
      fail(fmt::format("'{}' must be a whole number from {} to {}", key, lo, hi));
    return value.get<uint32_t>();
  }

  uint32_t pane(const char* key = "pane") { return whole(key, 0, kMostPanes - 1); }

  // Reads a list of whole numbers below `most`, at most 64, as bits.
  uint64_t bits(const char* key, uint32_t most) {
    const Json& value = at(key);
    if (!value.is_array() || value.size() > most)
      fail(fmt::format("'{}' must be a list of at most {} whole numbers", key, most));
    uint64_t bits = 0;
    for (const Json& one : value) {
      if (!one.is_number_integer() || one < 0 || one >= most)
        fail(fmt::format("'{}' must have whole numbers from 0 to {}", key, most - 1));
      bits |= uint64_t(1) << one.get<uint32_t>();
    }
    return bits;
  }

  std::array<double, 16> numbers16(const char* key) {
    const Json& value = at(key);
    std::array<double, 16> numbers{};
    if (!value.is_array() || value.size() != numbers.size())
      fail(fmt::format("'{}' must be 16 numbers", key));
    for (size_t i = 0; i < numbers.size(); ++i)
      numbers[i] = numberOf(value[i], fmt::format("'{}'[{}]", key, i), -1e9, 1e9);
    return numbers;
  }

  void expectNoMore() const {
    for (const auto& item : json_.items()) {
      if (std::find(known_.begin(), known_.end(), item.key()) == known_.end()) {
        fail(fmt::format("'{}' is unknown{}", item.key().substr(0, kMostCharacters),
                         didYouMean(item.key(), known_)));
      }
    }
  }

  [[noreturn]] void fail(const std::string& what) const {
    failUsage(fmt::format("command: {}{}{}", name_, name_.empty() ? "" : ": ", what));
  }

 private:
  double numberOf(const Json& value, const std::string& what, double lo, double hi) const {
    const double number = value.is_number() ? value.get<double>() : std::nan("");
    if (!(number >= lo && number <= hi))
      fail(fmt::format("{} must be a number from {:g} to {:g}", what, lo, hi));
    return number;
  }

  const Json& json_;
  std::vector<std::string> known_;
  std::string name_;
};

std::optional<ParameterValue> parameterOf(Members& members) {
  const Json& value = members.at("value");
  if (value.is_null()) return std::nullopt;
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_string()) return members.text("value");
  constexpr auto kMost = uint64_t(std::numeric_limits<int64_t>::max());
  if (value.is_number_unsigned() && value.get<uint64_t>() > kMost)
    members.fail("'value' is too large");
  if (value.is_number_integer()) return value.get<int64_t>();
  return members.number("value", -1e30, 1e30);
}

// Requires orthonormal, right-handed columns (a rotation and a translation).
void expectRigid(const Members& members, const std::array<double, 16>& m) {
  constexpr double kTolerance = 1e-3;
  const auto dot = [&](size_t a, size_t b) {
    return m[4 * a] * m[4 * b] + m[4 * a + 1] * m[4 * b + 1] + m[4 * a + 2] * m[4 * b + 2];
  };
  bool isRigid = true;
  for (size_t a = 0; a < 3; ++a) {
    for (size_t b = 0; b <= a; ++b)
      isRigid = isRigid && std::abs(dot(a, b) - (a == b ? 1.0 : 0.0)) <= kTolerance;
  }
  const double determinant = m[0] * (m[5] * m[10] - m[6] * m[9]) -
                             m[4] * (m[1] * m[10] - m[2] * m[9]) +
                             m[8] * (m[1] * m[6] - m[2] * m[5]);
  isRigid =
      isRigid && determinant > 0.0 && m[3] == 0.0 && m[7] == 0.0 && m[11] == 0.0 && m[15] == 1.0;
  if (!isRigid) members.fail("'to_world' must turn and move, and nothing else");
  // Squares of float32 beyond it are infinite, and rays have no direction.
  constexpr double kFarthest = 1e15;
  if (std::max({std::abs(m[12]), std::abs(m[13]), std::abs(m[14])}) > kFarthest)
    members.fail("'to_world' must move by at most 1e15");
}

ViewCommand commandOf(Members& members) {
  const std::string& name = members.name();
  if (name == "set") return SetSetting{members.pane(), members.text("key"), members.text("value")};
  if (name == "parameter")
    return SetParameter{members.pane(), members.text("name"), parameterOf(members)};
  if (name == "camera") {
    MoveCamera move{members.numbers16("to_world"), std::nullopt};
    expectRigid(members, move.toWorld);
    if (members.has("yfov")) move.yfov = members.number("yfov", 2e-4, 3.12);
    return move;
  }
  if (name == "resolution")
    return Resize{members.whole("width", 1, kMaxSide), members.whole("height", 1, kMaxSide)};
  if (name == "transport") return SetTransport{members.text("name"), parameterOf(members)};
  if (name == "light") return SetLight{members.text("name"), members.number("factor", 0.0, 1e6)};
  if (name == "material") {
    SetMaterial set{members.text("name"), members.text("key"), std::nullopt};
    if (!members.at("value").is_null()) set.value = members.text("value");
    if (members.has("bases")) set.bases = members.whole("bases", 0, kMostBases);
    return set;
  }
  if (name == "layer") return ShowLayer{members.pane(), members.text("name")};
  if (name == "probe") {
    return Probe{members.pane(), members.whole("x", 0, kMaxSide - 1),
                 members.whole("y", 0, kMaxSide - 1)};
  }
  if (name == "pause") return Pause{members.flag("on")};
  if (name == "look") {
    Look look{members.flag("on")};
    if (members.has("panes")) look.panes = members.bits("panes", kMostSeenPanes);
    return look;
  }
  if (name == "adaptive") return AdaptMotion{members.flag("on")};
  if (name == "restart") return Restart{};
  if (name == "copy") return CopyMethod{members.pane("from"), members.pane("to")};
  if (name == "undo") return Undo{};
  if (name == "redo") return Redo{};
  if (name == "save") return SaveSession{members.has("name") ? members.text("name") : ""};
  if (name == "measure") return Measure{members.has("name") ? members.text("name") : ""};
  if (name == "cancel") return CancelMeasure{};
  if (name == "picture") return SavePicture{members.whole("image", 0, kMostImages)};
  if (name == "table") return ShowTable{members.text("name")};
  const std::vector<std::string> names = {
      "set",   "parameter", "camera", "resolution", "transport", "light",   "material",
      "layer", "probe",     "pause",  "look",       "adaptive",  "restart", "copy",
      "undo",  "redo",      "save",   "measure",    "cancel",    "picture", "table"};
  failUsage(fmt::format("command: '{}' is unknown (known: {}){}", name, fmt::join(names, ", "),
                        didYouMean(name, names)));
}

template <class... Commands>
bool isOneOf(const ViewCommand& command) {
  return (std::holds_alternative<Commands>(command) || ...);
}

}  // namespace

bool changesFrames(const ViewCommand& command) {
  return isOneOf<SetSetting, SetParameter, MoveCamera, Resize, SetTransport, SetLight, SetMaterial,
                 Restart, CopyMethod, Undo, Redo>(command);
}

ViewCommand parseViewCommand(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) failUsage("command: must be a JSON object, {\"do\": ...}");
  Members members(json);
  ViewCommand command = commandOf(members);
  members.expectNoMore();
  return command;
}

}  // namespace restlab
