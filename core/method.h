// A method: an integrator, the cache of its reservoirs and a denoiser. Their parameters are one
// table.
#pragma once

#include <string>
#include <vector>

#include "core/cache.h"
#include "core/denoiser.h"
#include "core/integrator.h"

namespace restlab {

struct SessionConfig;

struct Method {
  const IntegratorInfo* integrator = nullptr;
  const CacheInfo* cache = nullptr;  // null: the integrator keeps no reservoirs
  const DenoiserInfo* denoiser = nullptr;

  // Its parts, in the order in which their passes run.
  std::vector<const PartInfo*> parts() const;
  // Of all parts, in that order.
  std::vector<ParameterInfo> parameters() const;
  // A frame depends on those before it, with these resolved parameters.
  bool hasHistory(const ParameterMap& resolved) const;
  // Of all parts, those that are there with the method's parameters.
  std::vector<const LayerInfo*> layers() const;
  // What Session::aov() knows: the names of Session::aovNames(), then those of the layers.
  std::vector<std::string> aovNames() const;
  // What may be said of a mode with these resolved parameters.
  BiasClass bias(const std::string& mode, const ParameterMap& resolved, bool cameraMoves) const;
};

// Fills the registries of core/integrator.h, core/cache.h and core/denoiser.h. Called by the table
// that is generated from their lists, when the program starts; always true.
bool registerMethods(std::vector<const IntegratorInfo*> integrators,
                     std::vector<const CacheInfo*> caches,
                     std::vector<const DenoiserInfo*> denoisers,
                     std::vector<MissingDenoiser> missingDenoisers);

// Throws Error (badUsage) with the nearest name, and where an integrator has no use for a cache.
// `cache`: "" is the first one, of an integrator that has use for it.
Method findMethod(const std::string& integrator, const std::string& cache,
                  const std::string& denoiser);
Method findMethod(const SessionConfig& config);

// Defaults overlaid by `given`; throws Error (badUsage) on unknown names, types, ranges, choices.
ParameterMap resolveParameters(const Method& method, const ParameterMap& given);

// The mode of that name; "" is the first one. Throws Error (badUsage) with the nearest name.
std::string findMode(const IntegratorInfo& info, const std::string& mode);

// A setting that changes nothing, and why: "confidence_cap", "temporal is false".
struct SettingWithoutEffect {
  std::string name;
  std::string why;
};
// Of the mode, where it is not the first one, and of the given parameters. Both are valid.
std::vector<SettingWithoutEffect> settingsWithoutEffect(const Method& method,
                                                        const std::string& mode,
                                                        const ParameterMap& given);

}  // namespace restlab
