#include "experiments/runner/suite/suite_methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "core/base/error.h"
#include "core/frame/cache.h"
#include "core/frame/method.h"
#include "core/frame/method_settings.h"
#include "experiments/runner/suite/suite_settings.h"

namespace restlab {

namespace {

// Reads a row of images: [[method]] with a key 'image'.
SuiteMethod readImageRow(const ConfigTable& table, const std::string& folder) {
  ImageRow row;
  row.files = table.getStrings("image");
  row.filesPlace = table.place("image");
  row.folder = folder;
  if (row.files.empty()) table.fail("image", "'image' is empty");
  if (table.has("time_ms")) {
    const size_t count = table.getTexts("time_ms").size();
    if (count != 1 && count != row.files.size()) {
      table.fail("time_ms", fmt::format("'time_ms' has {} numbers for {} image{}; one for each, or "
                                        "one number for all",
                                        count, row.files.size(), row.files.size() == 1 ? "" : "s"));
    }
    row.timesMs = table.getNumbers("time_ms", {}, count == 1 ? 1 : row.files.size(), 1e-9, 1e12);
    if (count == 1) row.timesMs.resize(row.files.size(), row.timesMs.front());
  }
  const std::string bias = table.getChoice("bias", "biased", {"unbiased", "consistent", "biased"});
  row.bias = bias == "unbiased"     ? BiasClass::unbiased
             : bias == "consistent" ? BiasClass::consistent
                                    : BiasClass::biased;
  SuiteMethod method;
  method.name = method.base = method.given = table.getString("name", "");
  method.namePlace = table.place("name");
  if (method.name.empty()) table.fail("name", "[[method]] with 'image' needs a 'name'");
  for (const auto& [key, help, value] : methodSettings()) {
    if (table.has(key))
      table.fail(
          key,
          fmt::format("'{}' and 'image' exclude each other: images are not rendered here", key));
  }
  table.finish();
  method.session.integrator = "image";
  method.session.mode = method.session.cache = method.session.backend = "none";
  method.images = std::move(row);
  return method;
}

// Reads a method. Returns one copy per backend.
std::vector<SuiteMethod> readMethod(const ConfigTable& table, const ConfigTable& settings,
                                    const Suite& suite) {
  SuiteMethod method;
  std::vector<std::string> integrators;
  for (const IntegratorInfo* info : integratorRegistry()) integrators.push_back(info->name);
  method.session.integrator = table.getChoice("integrator", "path", integrators);
  const IntegratorInfo& info = findIntegrator(method.session.integrator);
  std::vector<std::string> modes;
  for (const ModeInfo& mode : info.modes) modes.push_back(mode.name);
  method.session.mode = table.getChoice("mode", modes.front(), modes);
  std::vector<std::string> caches;
  for (const CacheInfo* cache : cacheRegistry()) caches.push_back(cache->name);
  if (info.usesCache) {
    method.session.cache = table.getChoice("cache", caches.front(), caches);
  } else if (table.has("cache")) {
    table.fail("cache", fmt::format("integrator {} keeps no reservoirs: it has no use for a cache",
                                    info.name));
  }
  const std::string kernels = kernelChoiceName(method.session.kernels);
  method.session.kernels = parseKernelChoice(
      table.getChoice("kernels", kernels, kernelChoiceNames()), table.place("kernels"));
  std::vector<std::string> denoisers;
  for (const DenoiserInfo* denoiser : denoiserRegistry()) denoisers.push_back(denoiser->name);
  for (const MissingDenoiser& missing : missingDenoisers()) {
    if (table.getString("denoiser", "") == missing.name)
      table.fail("denoiser",
                 fmt::format("denoiser {} is not there: {}", missing.name, missing.whyNot));
  }
  method.session.denoiser = table.getChoice("denoiser", "none", denoisers);
  const std::string fallback =
      info.name + (modes.size() < 2 ? "" : " (" + method.session.mode + ")") +
      (method.session.denoiser == "none" ? "" : " + " + method.session.denoiser);
  method.name = table.getString("name", fallback);
  for (const ParameterInfo& parameter : findMethod(method.session).parameters()) {
    if (const auto value = table.getParameter(parameter)) {
      method.session.parameters[parameter.name] = *value;
    }
  }
  const std::vector<std::string> backends = readBackends(table, suite.backends);
  table.finish();
  method.base = method.given = method.name;
  method.namePlace = table.place("name");
  const bool isGeneral = !table.has("backend") && settings.has("backend");
  method.backendPlace = (isGeneral ? settings : table).place("backend");
  std::vector<SuiteMethod> all;
  for (const std::string& backend : backends) {
    method.session.backend = backend;
    suite.chooseDevice(method.session);
    all.push_back(method);
  }
  return all;
}

// Returns whether a sweep over all methods applies: `path` has one mode and no cache.
bool isMeant(const SweepAxis& axis, const std::string& integrator, const std::string& denoiser) {
  const std::vector<std::string> known = methodKeys(integrator, denoiser);
  if (std::find(known.begin(), known.end(), axis.leaf) == known.end()) return false;
  if (!axis.method.empty()) return true;
  for (const IntegratorInfo* info : integratorRegistry()) {
    if (info->name != integrator) continue;
    if (axis.leaf == "mode") return info->modes.size() > 1;
    if (axis.leaf == "cache") return info->usesCache;
  }
  return true;
}

// Reads a method's table once for every combination of its swept keys.
std::vector<SuiteMethod> readSwept(ConfigTable& table, const ConfigTable& settings,
                                   const Sweep& sweep, const Suite& suite) {
  const std::string integrator = table.getString("integrator", "path");
  const std::string name = table.getString("name", integrator);
  const bool isNamed = table.has("name");
  std::vector<std::string> integrators = {integrator};
  std::vector<std::string> denoisers = {table.getString("denoiser", "none")};
  for (const SweepAxis& axis : sweep.methods) {
    std::vector<std::string>* parts = axis.leaf == "integrator" ? &integrators
                                      : axis.leaf == "denoiser" ? &denoisers
                                                                : nullptr;
    for (const std::string& text : axis.texts) {
      if (parts) parts->push_back(unquoted(text));
    }
  }
  std::vector<SweepAxis> axes;
  for (const SweepAxis& axis : sweep.methods) {
    if (!axis.method.empty() && axis.method != name) continue;
    const bool isKnown = std::any_of(integrators.begin(), integrators.end(), [&](const auto& of) {
      return std::any_of(denoisers.begin(), denoisers.end(),
                         [&](const auto& with) { return isMeant(axis, of, with); });
    });
    if (isKnown) axes.push_back(axis);
  }
  std::vector<SuiteMethod> all;
  for (const std::vector<size_t>& choice : combinations(axes)) {
    std::vector<SweepAxis> shown;
    std::vector<size_t> shownChoice;
    for (size_t i = 0; i < axes.size(); ++i) {
      table.assign(axes[i].leaf, axes[i].texts[choice[i]], axes[i].place);
      // A method without a name of its own is named by its integrator and mode.
      if (!isNamed && (axes[i].leaf == "integrator" || axes[i].leaf == "mode")) continue;
      if (axes[i].leaf == "backend") continue;  // nameByBackend() adds it
      shown.push_back(axes[i]);
      shownChoice.push_back(choice[i]);
    }
    for (SuiteMethod& method : readMethod(table, settings, suite)) {
      method.swept = sweptValues(shown, shownChoice);
      const std::string label = sweepLabel(method.swept);
      if (!label.empty()) method.name = method.base = fmt::format("{}, {}", method.base, label);
      all.push_back(std::move(method));
    }
  }
  return all;
}

}  // namespace

void readMethods(const ConfigTable& root, const ConfigTable& settings, const Sweep& sweep,
                 const std::string& folder, Suite& suite) {
  std::vector<SuiteMethod> imageRows;
  for (ConfigTable& table : root.getTables("method")) {
    if (table.has("image")) {
      imageRows.push_back(readImageRow(table, folder));
      continue;
    }
    for (SuiteMethod& method : readSwept(table, settings, sweep, suite))
      suite.methods.push_back(std::move(method));
  }
  if (suite.methods.empty()) root.fail("", "the suite has no [[method]] that is rendered");
  std::move(imageRows.begin(), imageRows.end(), std::back_inserter(suite.methods));
}

}  // namespace restlab
