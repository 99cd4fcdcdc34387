// Integrators, the part that a researcher implements: modes, and how biased each of them is.
//
// An integrator is a folder under integrators/, a line in integrators.list, kernels in the dialect
// (*.glsl) and one .cpp that defines `const IntegratorInfo& <name>IntegratorInfo()`.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/frame/part.h"

namespace restlab {

// One mode of an integrator ("biased", "unbiased", or "" if there is only one).
struct ModeInfo {
  std::string name;
  BiasClass bias = BiasClass::unbiased;
  std::string why;
};

// Sets FrameBuffers::radiance (12 bytes per pixel).
struct IntegratorInfo : PartInfo {
  std::vector<ModeInfo> modes;
  // Light that the method does not look for, in words; "": none. Tests of the mean do not apply to
  // it.
  std::string leavesOut;
  // Same light for one scene; "": the scene has none of it. Empty: `leavesOut`.
  std::function<std::string(const CompiledScene&, const ParameterMap&)> leavesOutOf;
  bool usesCache = false;       // keeps reservoirs in a cache
  bool readsFirstHits = false;  // asks for first hits itself (core/gbuffer/first_hits.h)
  bool endsPaths = false;  // paths may end in cells of the radiance cache (core/radiance_cache)
  // Bias class if it depends on parameters; empty: the class of the mode.
  std::function<BiasClass(const std::string& mode, const ParameterMap&)> biasOfParameters;
  // Number of frames that the radiance of a pixel averages once its history is old; empty: one.
  std::function<double(const ParameterMap&)> radianceFrames;
};

// All integrators of integrators.list, in its order.
const std::vector<const IntegratorInfo*>& integratorRegistry();
// Throws Error (badUsage) with the nearest name if the integrator is unknown.
const IntegratorInfo& findIntegrator(const std::string& name);
// Bias class of a mode with these resolved parameters.
BiasClass biasClassOf(const IntegratorInfo& info, const std::string& mode,
                      const ParameterMap& parameters);

}  // namespace restlab
