// A method: an integrator, the cache of its reservoirs and a denoiser. Their parameters are one
// table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/denoiser.h"
#include "core/integrator.h"

namespace restlab {

struct SessionConfig;

struct Method {
  const IntegratorInfo* integrator = nullptr;
  const DenoiserInfo* denoiser = nullptr;

  // Its parts, in the order in which their passes run.
  std::vector<const PartInfo*> parts() const;
  // Of all parts, in that order.
  std::vector<ParameterInfo> parameters() const;
  // A frame depends on those before it.
  bool hasHistory() const;
  // What may be said of a mode with these resolved parameters.
  BiasClass bias(const std::string& mode, const ParameterMap& resolved, bool cameraMoves) const;
};

// Fills the registries of core/integrator.h and core/denoiser.h. Called by the table that is
// generated from integrators.list and denoisers.list, when the program starts; always true.
bool registerMethods(std::vector<const IntegratorInfo*> integrators,
                     std::vector<const DenoiserInfo*> denoisers);

// Throws Error (badUsage) with the nearest name.
Method findMethod(const std::string& integrator, const std::string& denoiser);
Method findMethod(const SessionConfig& config);

// Defaults overlaid by `given`; throws Error (badUsage) on unknown names, types, ranges, choices.
ParameterMap resolveParameters(const Method& method, const ParameterMap& given);

}  // namespace restlab
