#include "core/frame/method.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/frame/session.h"
#include "core/gbuffer/first_hits.h"
#include "core/radiance_cache/settings.h"
#include "core/temporal_gradients/settings.h"

namespace restlab {

namespace {

const char* typeName(const ParameterValue& v) {
  switch (v.index()) {
    case 0:
      return "a boolean";
    case 1:
      return "an integer";
    case 2:
      return "a number";
    default:
      return "a string";
  }
}

void checkRange(const std::string& owner, const ParameterInfo& p, double value) {
  if (value >= p.minValue && value <= p.maxValue) return;
  failUsage(fmt::format("{}.{} = {}: must be between {} and {}", owner, p.name, value, p.minValue,
                        p.maxValue));
}

struct Registry {
  std::vector<const IntegratorInfo*> integrators;
  std::vector<const CacheInfo*> caches;
  std::vector<const DenoiserInfo*> denoisers;
  std::vector<MissingDenoiser> missingDenoisers;
};

Registry& registry() {
  static Registry all;
  return all;
}

template <class Info>
const Info& findPart(const std::vector<const Info*>& all, const std::string& kind,
                     const std::string& name) {
  std::vector<std::string> names;
  for (const Info* info : all) {
    if (info->name == name) return *info;
    names.push_back(info->name);
  }
  failUsage(fmt::format("unknown {} '{}'{} (see: restlab list {}s)", kind, name,
                        didYouMean(name, names), kind));
}

}  // namespace

bool registerMethods(std::vector<const IntegratorInfo*> integrators,
                     std::vector<const CacheInfo*> caches,
                     std::vector<const DenoiserInfo*> denoisers,
                     std::vector<MissingDenoiser> missingDenoisers) {
  registry() = {std::move(integrators), std::move(caches), std::move(denoisers),
                std::move(missingDenoisers)};
  return true;
}

const std::vector<const IntegratorInfo*>& integratorRegistry() { return registry().integrators; }
const std::vector<const CacheInfo*>& cacheRegistry() { return registry().caches; }
const std::vector<const DenoiserInfo*>& denoiserRegistry() { return registry().denoisers; }
const std::vector<MissingDenoiser>& missingDenoisers() { return registry().missingDenoisers; }

const IntegratorInfo& findIntegrator(const std::string& name) {
  return findPart(integratorRegistry(), "integrator", name);
}
const CacheInfo& findCache(const std::string& name) {
  return findPart(cacheRegistry(), "cache", name);
}
const DenoiserInfo& findDenoiser(const std::string& name) {
  for (const MissingDenoiser& missing : missingDenoisers()) {
    if (missing.name == name)
      failUsage(fmt::format("denoiser {} is not there: {}", name, missing.whyNot));
  }
  return findPart(denoiserRegistry(), "denoiser", name);
}

BiasClass biasClassOf(const IntegratorInfo& info, const std::string& mode,
                      const ParameterMap& parameters) {
  if (info.biasOfParameters) return info.biasOfParameters(mode, parameters);
  for (const ModeInfo& m : info.modes) {
    if (m.name == mode) return m.bias;
  }
  return BiasClass::biased;
}

Method findMethod(const std::string& integrator, const std::string& cache,
                  const std::string& denoiser) {
  Method method{&findIntegrator(integrator), nullptr, &findDenoiser(denoiser)};
  if (!cache.empty()) method.cache = &findCache(cache);
  if (method.integrator->usesCache && cache.empty()) method.cache = cacheRegistry().front();
  if (!method.integrator->usesCache && !cache.empty()) {
    failUsage(fmt::format("cache {}: integrator {} keeps no reservoirs: it has no use for one",
                          cache, integrator));
  }
  return method;
}

Method findMethod(const SessionConfig& config) {
  return findMethod(config.integrator, config.cache, config.denoiser);
}

std::vector<const PartInfo*> Method::parts() const {
  std::vector<const PartInfo*> all;
  if (cache != nullptr) all.push_back(cache);
  if (integrator->readsFirstHits || integrator->needsSurfaces || denoiser->needsSurfaces ||
      denoiser->needsFeatures || (cache != nullptr && cache->needsSurfaces))
    all.push_back(&firstHitsPartInfo());
  if (integrator->endsPaths) all.push_back(&radiancePartInfo());
  if (integrator->followsChanges || denoiser->followsChanges) all.push_back(&changesPartInfo());
  all.push_back(integrator);
  all.push_back(denoiser);
  return all;
}

std::vector<ParameterInfo> Method::parameters() const {
  std::vector<ParameterInfo> all;
  const std::vector<const PartInfo*> of = parts();
  for (const PartInfo* part : of)
    all.insert(all.end(), part->parameters.begin(), part->parameters.end());
  for (const PartInfo* part : of) {
    for (ParameterInfo& p : all) {
      if (const auto other = part->defaults.find(p.name); other != part->defaults.end())
        p.defaultValue = other->second;
    }
  }
  return all;
}

bool Method::hasHistory(const ParameterMap& resolved) const {
  const std::vector<const PartInfo*> all = parts();
  return std::any_of(all.begin(), all.end(), [&](const PartInfo* part) {
    return part->hasHistory && isEnabled(part->enabledIf, resolved);
  });
}

std::vector<const LayerInfo*> Method::layers() const {
  const ParameterMap known = resolveParameters(*this, {});
  std::vector<const LayerInfo*> all;
  for (const PartInfo* part : parts()) {
    for (const LayerInfo& layer : part->layers)
      if (isEnabled(layer.enabledIf, known)) all.push_back(&layer);
  }
  return all;
}

std::vector<std::string> Method::aovNames() const {
  std::vector<std::string> names = Session::aovNames();
  for (const LayerInfo* layer : layers()) names.push_back(layer->name);
  return names;
}

BiasClass Method::bias(const std::string& mode, const ParameterMap& resolved,
                       bool cameraMoves) const {
  BiasClass bias = std::max(biasClassOf(*integrator, mode, resolved),
                            cameraMoves ? denoiser->biasOfMovingView : denoiser->biasOfStillView);
  for (const PartInfo* part : parts()) {
    if (isEnabled(part->enabledIf, resolved)) bias = std::max(bias, part->bias);
  }
  return bias;
}

ParameterValue checkedValue(const std::string& owner, const ParameterInfo& p,
                            ParameterValue value) {
  // Accept an integer for a number.
  if (p.defaultValue.index() == 2 && value.index() == 1)
    value = static_cast<double>(std::get<int64_t>(value));
  if (value.index() != p.defaultValue.index()) {
    failUsage(fmt::format("{}.{}: is {} but must be {}", owner, p.name, typeName(value),
                          typeName(p.defaultValue)));
  }
  if (value.index() == 1) checkRange(owner, p, static_cast<double>(std::get<int64_t>(value)));
  if (value.index() == 2) checkRange(owner, p, std::get<double>(value));
  if (value.index() == 3 && !p.choices.empty()) {
    const std::string& text = std::get<std::string>(value);
    if (std::find(p.choices.begin(), p.choices.end(), text) == p.choices.end()) {
      failUsage(fmt::format("{}.{} = '{}': must be one of {}{}", owner, p.name, text,
                            fmt::join(p.choices, ", "), didYouMean(text, p.choices)));
    }
  }
  return value;
}

ParameterMap resolveParameters(const Method& method, const ParameterMap& given) {
  ParameterMap resolved;
  std::vector<std::string> names;
  std::map<std::string, ParameterValue> defaults;
  for (const ParameterInfo& p : method.parameters()) defaults[p.name] = p.defaultValue;
  for (const PartInfo* part : method.parts()) {
    for (const ParameterInfo& p : part->parameters) {
      const auto value = given.find(p.name);
      resolved[p.name] =
          value == given.end() ? defaults.at(p.name) : checkedValue(part->name, p, value->second);
      names.push_back(p.name);
    }
  }
  for (const auto& [name, value] : given) {
    if (resolved.contains(name)) continue;
    const bool isPlain = method.denoiser->parameters.empty();
    failUsage(fmt::format("integrator {}{} has no parameter '{}'{}", method.integrator->name,
                          isPlain ? "" : fmt::format(" with denoiser {}", method.denoiser->name),
                          name, didYouMean(name, names)));
  }
  return resolved;
}

std::string findMode(const IntegratorInfo& info, const std::string& mode) {
  std::vector<std::string> modes;
  for (const ModeInfo& m : info.modes) modes.push_back(m.name);
  if (mode.empty()) return modes.front();
  if (std::find(modes.begin(), modes.end(), mode) != modes.end()) return mode;
  failUsage(fmt::format("mode '{}': integrator {} knows {}{}", mode, info.name,
                        fmt::join(modes, ", "), didYouMean(mode, modes)));
}

std::vector<SettingWithoutEffect> settingsWithoutEffect(const Method& method,
                                                        const std::string& mode,
                                                        const ParameterMap& given) {
  const ParameterMap resolved = resolveParameters(method, given);
  std::vector<SettingWithoutEffect> all;
  const auto ask = [&](const std::string& name) {
    // An integrator that has no use for changes cannot tell that the denoiser has.
    const std::vector<ParameterInfo>& ofChanges = changesPartInfo().parameters;
    const bool isForDenoiser =
        method.denoiser->followsChanges &&
        std::any_of(ofChanges.begin(), ofChanges.end(),
                    [&](const ParameterInfo& info) { return info.name == name; });
    for (const PartInfo* part : method.parts()) {
      if (isForDenoiser && part == method.integrator) continue;
      const std::string why = part->reasonUnused ? part->reasonUnused(name, resolved) : "";
      if (!why.empty()) return all.push_back({name, why});
    }
  };
  if (mode != findMode(*method.integrator, "")) ask("mode");
  for (const auto& [name, value] : given) ask(name);
  return all;
}

bool isEnabled(const EnabledIf& only, const ParameterMap& resolved) {
  if (only.parameter == nullptr) return true;
  const auto found = resolved.find(only.parameter);
  if (found == resolved.end()) return false;
  if (only.value != nullptr) return std::get<std::string>(found->second) == only.value;
  const int64_t* number = std::get_if<int64_t>(&found->second);
  return number == nullptr || *number != 0;
}

}  // namespace restlab
