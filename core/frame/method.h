// A method: an integrator, the cache of its reservoirs and a denoiser. Their parameters form one
// table.
#pragma once

#include <string>
#include <vector>

#include "core/frame/cache.h"
#include "core/frame/denoiser.h"
#include "core/frame/integrator.h"

namespace restlab {

struct SessionConfig;

struct Method {
  const IntegratorInfo* integrator = nullptr;
  const CacheInfo* cache = nullptr;  // null: the integrator keeps no reservoirs
  const DenoiserInfo* denoiser = nullptr;

  // Parts in the order in which their passes run.
  std::vector<const PartInfo*> parts() const;
  // Parameters of all parts, in the order of parts().
  std::vector<ParameterInfo> parameters() const;
  // Returns whether a frame depends on earlier frames, with these resolved parameters.
  bool hasHistory(const ParameterMap& resolved) const;
  // Layers of all parts that exist with the method's parameters.
  std::vector<const LayerInfo*> layers() const;
  // Names that Session::aov() accepts: Session::aovNames(), then the layers.
  std::vector<std::string> aovNames() const;
  // Bias class of a mode with these resolved parameters.
  BiasClass bias(const std::string& mode, const ParameterMap& resolved, bool cameraMoves) const;
};

// Fills the registries of core/frame/integrator.h, core/frame/cache.h and core/frame/denoiser.h.
// The table generated from their lists calls it at program start; always returns true.
bool registerMethods(std::vector<const IntegratorInfo*> integrators,
                     std::vector<const CacheInfo*> caches,
                     std::vector<const DenoiserInfo*> denoisers,
                     std::vector<MissingDenoiser> missingDenoisers);

// Finds the parts of a method. Throws Error (badUsage) with the nearest name, or if a cache is
// given and the integrator uses none. `cache`: "" is the first one, if the integrator uses a cache.
Method findMethod(const std::string& integrator, const std::string& cache,
                  const std::string& denoiser);
Method findMethod(const SessionConfig& config);

// Returns the value with the parameter's type; throws Error (badUsage), naming the part `owner`, on
// a wrong type, range or choice.
ParameterValue checkedValue(const std::string& owner, const ParameterInfo& info,
                            ParameterValue value);
// Returns the defaults overlaid by `given`; throws Error (badUsage) on unknown names, wrong types,
// ranges, choices.
ParameterMap resolveParameters(const Method& method, const ParameterMap& given);

// Returns the mode of that name; "" is the first one. Throws Error (badUsage) with the nearest
// name.
std::string findMode(const IntegratorInfo& info, const std::string& mode);

// A setting that changes nothing, and why: "confidence_cap", "temporal is false".
struct SettingWithoutEffect {
  std::string name;
  std::string why;
};
// Checks the mode, unless it is the first one, and the given parameters. Both must be valid.
std::vector<SettingWithoutEffect> settingsWithoutEffect(const Method& method,
                                                        const std::string& mode,
                                                        const ParameterMap& given);

}  // namespace restlab
