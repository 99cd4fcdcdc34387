#include "core/integrator.h"

#include "core/error.h"

namespace restlab {

const IntegratorInfo& findIntegrator(const std::string& name) {
  std::vector<std::string> names;
  for (const IntegratorInfo* info : integratorRegistry()) {
    if (info->name == name) return *info;
    names.push_back(info->name);
  }
  failUsage("unknown integrator '" + name + "'" + didYouMean(name, names) +
            " (see: restlab list integrators)");
}

BiasClass biasClassOf(const IntegratorInfo& info, const std::string& mode,
                      const ParameterMap& parameters) {
  if (info.biasOfParameters) return info.biasOfParameters(mode, parameters);
  for (const ModeInfo& m : info.modes) {
    if (m.name == mode) return m.bias;
  }
  return BiasClass::biased;
}

}  // namespace restlab
