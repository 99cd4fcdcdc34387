#include "core/scene/scene_file/scene_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/base/error.h"

namespace restlab {

namespace {

namespace fs = std::filesystem;

// The table that a setting is about: "material.wall.roughness" or "light.lamp.intensity" by its
// name, "camera.yfov", "environment.scale" and "background.radiance" by themselves.
ConfigTable tableOf(const ConfigTable& table, const std::string& key, const std::string& place) {
  const size_t first = key.find('.'), last = key.rfind('.');
  const std::string group = key.substr(0, first);
  const bool isNamed = group == "material" || group == "light";
  const bool isSingle = group == "camera" || group == "environment" || group == "background";
  if (first == std::string::npos || (first == last) == isNamed || !(isNamed || isSingle))
    failInput(place +
              ": material.NAME.KEY, light.NAME.KEY, camera.KEY, environment.KEY or "
              "background.KEY expected");
  if (isSingle) {
    if (!table.has(group)) failInput(fmt::format("{}: the file has no [{}]", place, group));
    return table.getTable(group);
  }
  const std::string name = key.substr(first + 1, last - first - 1);
  std::vector<std::string> names;
  for (const ConfigTable& one : table.getTables(group)) {
    names.push_back(one.getString("name", ""));
    if (names.back() == name) return one;
  }
  failInput(
      fmt::format("{}: no [[{}]] is named '{}'{}", place, group, name, didYouMean(name, names)));
}

const MaterialKind* kindNamed(const std::string& name) {
  for (const MaterialKind& kind : materialKinds())
    if (kind.name == name) return &kind;
  return nullptr;  // an error where it is read
}

// True if a value of the parameter of one kind is one of the other's.
bool isSame(const ClosureParameter& a, const ClosureParameter& b) {
  return a.name == b.name && a.kind == b.kind && a.choices == b.choices;
}

// Removes what a material had as of the kind `before`, unless its new kind has it, too, or it is
// one of the keys that were set.
void removeOthers(ConfigTable material, const MaterialKind& before,
                  const std::set<std::string>& given) {
  const MaterialKind* now = kindNamed(material.getString("kind", ""));
  if (now == nullptr) return;
  for (const std::string& key : material.keys()) {
    // Keys of a texture, such as "color_texture", are of the parameter with the longest name.
    const ClosureParameter* owner = nullptr;
    for (const ClosureParameter& p : before.parameters) {
      const bool isOwn = key == p.name || key.starts_with(p.name + "_");
      if (isOwn && (owner == nullptr || p.name.size() > owner->name.size())) owner = &p;
    }
    if (owner == nullptr || given.count(key) > 0) continue;
    const bool isKept = std::any_of(now->parameters.begin(), now->parameters.end(),
                                    [&](const ClosureParameter& q) { return isSame(*owner, q); });
    const bool readsTexture = now->closure != nullptr || owner->name == "color";
    if (!isKept || (key != owner->name && !readsTexture)) material.remove(key);
  }
}

}  // namespace

std::pair<std::string, std::string> splitBaseSettings(const std::string& settings) {
  std::string own, ofBase;
  for (size_t begin = 0; begin < settings.size();) {
    const size_t end = std::min(settings.find('&', begin), settings.size());
    std::string setting = settings.substr(begin, end - begin);
    begin = end + 1;
    const bool isOfBase = setting.starts_with(kOfBaseSetting);
    if (isOfBase) setting = setting.substr(std::string(kOfBaseSetting).size());
    std::string& to = isOfBase ? ofBase : own;
    to += (to.empty() ? "" : "&") + setting;
  }
  return {own, ofBase};
}

std::string materialKey(uint32_t bases, const std::string& name, const std::string& parameter) {
  std::string key;
  for (uint32_t i = 0; i < bases; ++i) key += kOfBaseSetting;
  return key + "material." + name + "." + parameter;
}

std::string joinedSettings(const std::string& settings, const std::string& more) {
  return settings + (settings.empty() || more.empty() ? "" : "&") + more;
}

void applySettings(const ConfigTable& table, const std::string& settings, const fs::path& file) {
  // By table, such as "material.wall": keys that are set, and kinds of before.
  std::map<std::string, std::set<std::string>> given;
  std::map<std::string, const MaterialKind*> before;
  for (size_t begin = 0; begin < settings.size();) {
    const size_t end = std::min(settings.find('&', begin), settings.size());
    const std::string setting = settings.substr(begin, end - begin);
    begin = end + 1;
    const std::string place = file.string() + "?" + setting;
    const size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0)
      failInput(place + ": must be KEY=VALUE, such as material.wall.alpha=0.3");
    const std::string key = setting.substr(0, equals);
    const std::string of = key.substr(0, key.rfind('.')), name = key.substr(key.rfind('.') + 1);
    ConfigTable meant = tableOf(table, key, place);
    if (name == "kind" && of.starts_with("material."))
      before.emplace(of, kindNamed(meant.getString("kind", "")));
    meant.assign(name, setting.substr(equals + 1), place);
    given[of].insert(name);
  }
  for (const auto& [of, kind] : before)
    if (kind != nullptr)
      removeOthers(tableOf(table, of + ".kind", file.string()), *kind, given[of]);
}

}  // namespace restlab
