// Every parameter of every method is taken by [[method]], by --set and by a sweep, and is listed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>

#include "core/base/error.h"
#include "core/frame/method_settings.h"
#include "experiments/runner/registries/registries.h"
#include "experiments/runner/run/render_command.h"
#include "experiments/runner/suite/suite.h"
#include "experiments/runner/suite/suite_settings.h"
#include "experiments/runner/tables/column_groups.h"
#include "tests/runner/every_method.h"
#include "tests/runner/temporary_folder.h"

namespace restlab {

namespace {

using Lines = std::vector<std::string>;

// Returns "name=VALUE" with a TOML value.
std::string assignment(const std::string& name, const ParameterValue& value) {
  struct Text {
    std::string operator()(bool of) const { return of ? "true" : "false"; }
    std::string operator()(int64_t of) const { return std::to_string(of); }
    std::string operator()(double of) const { return fmt::format("{:.17e}", of); }
    std::string operator()(const std::string& of) const { return '"' + of + '"'; }
  };
  return name + "=" + std::visit(Text(), value);
}

// Returns the key of a parameter in a sweep: a setting of the same name comes first.
std::string sweptKey(const std::string& name) {
  const std::vector<std::string>& settings = settingsKeys();
  const bool isSetting = std::find(settings.begin(), settings.end(), name) != settings.end();
  return isSetting ? "method." + name : name;
}

std::string nameOf(const SessionConfig& config) {
  return fmt::format("{}, {}, {}", config.integrator, config.cache, config.denoiser);
}

class EveryParameter : public TemporaryFolder {
 protected:
  // Returns the parameters of the only method of a suite.
  ParameterMap load(const SessionConfig& config, const Lines& own, const Lines& overrides = {},
                    const Lines& sweeps = {}) const {
    const std::filesystem::path file = folder() / "suite.toml";
    std::ofstream out(file);
    out << "scenes = [\"furnace\"]\n[[method]]\nname = \"it\"\nintegrator = \"" << config.integrator
        << "\"\ndenoiser = \"" << config.denoiser << "\"\n";
    if (!config.cache.empty()) out << "cache = \"" << config.cache << "\"\n";
    for (const std::string& line : own) out << line << "\n";
    out.close();
    const std::vector<Suite> suites = loadSuites(file, overrides, sweeps);
    EXPECT_EQ(suites.size(), 1u);
    EXPECT_EQ(suites[0].methods.size(), 1u);
    return suites[0].methods[0].session.parameters;
  }
  std::string errorOf(const SessionConfig& config, const Lines& own, const Lines& overrides = {},
                      const Lines& sweeps = {}) const {
    try {
      load(config, own, overrides, sweeps);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::badUsage);
      return error.what();
    }
    return "";
  }
};

TEST_F(EveryParameter, IsTakenByMethodSetAndSweep) {
  size_t parameters = 0;
  for (const SessionConfig& config : everyMethod()) {
    SCOPED_TRACE(nameOf(config));
    Lines own, set, named, swept, sweptByName;
    ParameterMap wanted;
    for (const ParameterInfo& info : findMethod(config).parameters()) {
      wanted[info.name] = anotherValue(info);
      const std::string text = assignment(info.name, wanted[info.name]);
      own.push_back(text);
      set.push_back("method." + text);
      named.push_back("method.it." + text);
      swept.push_back(assignment(sweptKey(info.name), wanted[info.name]));
      sweptByName.push_back("method.it." + text);
      ++parameters;
    }
    EXPECT_EQ(load(config, own), wanted);
    EXPECT_EQ(load(config, {}, set), wanted);
    EXPECT_EQ(load(config, {}, named), wanted);
    EXPECT_EQ(load(config, {}, {}, swept), wanted);
    EXPECT_EQ(load(config, {}, {}, sweptByName), wanted);
  }
  EXPECT_GT(parameters, 500u) << "the registries have lost parameters";
}

TEST_F(EveryParameter, OfAnotherMethodIsRefused) {
  std::map<std::string, ParameterInfo> all;
  for (const SessionConfig& config : everyMethod())
    for (const ParameterInfo& info : findMethod(config).parameters()) all[info.name] = info;
  size_t refused = 0;
  for (const SessionConfig& config : everyMethod()) {
    if (config.denoiser != "none") continue;
    SCOPED_TRACE(nameOf(config));
    const std::vector<std::string> known = parameterNames(config.integrator, config.denoiser);
    for (const auto& [name, info] : all) {
      if (std::find(known.begin(), known.end(), name) != known.end()) continue;
      const std::string text = assignment(name, anotherValue(info)), quoted = "'" + name + "'";
      EXPECT_NE(errorOf(config, {text}).find("unknown key " + quoted), std::string::npos)
          << errorOf(config, {text});
      EXPECT_NE(errorOf(config, {}, {"method." + text}).find("has a parameter " + quoted),
                std::string::npos);
      const std::string swept = assignment(sweptKey(name), anotherValue(info));
      EXPECT_NE(errorOf(config, {}, {}, {swept}).find("nor something of a method"),
                std::string::npos)
          << swept;
      ++refused;
    }
  }
  EXPECT_GT(refused, 50u);
}

// Every setting of light transport is a key of [settings] and [[scene]], is taken by --set and a
// sweep, has a column, and stands in the command that renders the row again.
TEST_F(EveryParameter, OfLightTransportIsTaken) {
  const auto loaded = [&](const Lines& scene, const Lines& settings, const Lines& overrides = {},
                          const Lines& sweeps = {}) {
    const std::filesystem::path file = folder() / "suite.toml";
    std::ofstream(file) << fmt::format(
        "[[scene]]\nscene = \"furnace\"\n{}\n[[method]]\n[settings]\n{}\n", fmt::join(scene, "\n"),
        fmt::join(settings, "\n"));
    const std::vector<Suite> suites = loadSuites(file, overrides, sweeps);
    EXPECT_EQ(suites.size(), 1u);
    return ofScene(suites[0], suites[0].scenes[0]);
  };
  Lines assigned;
  ParameterMap values;
  for (const ParameterInfo& info : transportSchema().infos()) {
    values[info.name] = anotherValue(info);
    assigned.push_back(assignment(info.name, values[info.name]));
  }
  const TransportSettings wanted = transportSchema().read(values);
  EXPECT_FALSE(wanted == TransportSettings());
  EXPECT_TRUE(static_cast<TransportSettings>(loaded({}, assigned)) == wanted);
  EXPECT_TRUE(static_cast<TransportSettings>(loaded(assigned, {})) == wanted);
  EXPECT_TRUE(static_cast<TransportSettings>(loaded({}, {}, assigned)) == wanted);
  EXPECT_TRUE(static_cast<TransportSettings>(loaded({}, {}, {}, assigned)) == wanted);

  SessionConfig config;
  static_cast<TransportSettings&>(config) = wanted;
  const std::vector<std::string> words = renderWords(SceneRequest(), config, config);
  for (const ParameterInfo& info : transportSchema().infos()) {
    EXPECT_EQ(std::count(words.begin(), words.end(), optionName(info.name)), 1) << info.name;
    const Columns columns = conditionColumns();
    EXPECT_TRUE(std::any_of(columns.begin(), columns.end(), [&](const Column& column) {
      return column.key == info.name;
    })) << info.name;
  }
}

// Returns what the lists of the registries say a part brings.
Lines listed(const nlohmann::ordered_json& parts, const std::string& name) {
  Lines names;
  for (const auto& part : parts) {
    if (part.at("name") != name) continue;
    for (const auto& parameter : part.at("parameters")) names.push_back(parameter.at("name"));
  }
  return names;
}

TEST(ListedParameters, AreThoseOfTheMethods) {
  for (const SessionConfig& config : everyMethod()) {
    SCOPED_TRACE(nameOf(config));
    std::set<std::string> wanted, found;
    for (const ParameterInfo& info : findMethod(config).parameters()) wanted.insert(info.name);
    for (const Lines& names :
         {listed(integratorsJson(), config.integrator), listed(cachesJson(), config.cache),
          listed(denoisersJson(), config.denoiser)}) {
      const std::set<std::string> once(names.begin(), names.end());
      EXPECT_EQ(once.size(), names.size()) << "a parameter is listed twice";
      found.insert(once.begin(), once.end());
    }
    EXPECT_EQ(found, wanted);
  }
}

}  // namespace

}  // namespace restlab
