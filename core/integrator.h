// What a researcher implements: parameters, buffers, passes, and how biased the result is.
//
// An integrator is a folder under integrators/, a line in integrators.list, kernels in the dialect
// (*.glsl) and one .cpp that defines `const IntegratorInfo& <name>IntegratorInfo()`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace restlab {

using ParameterValue = std::variant<bool, int64_t, double, std::string>;

// A tunable constant: its default, range, meaning and where the default comes from.
struct ParameterInfo {
  std::string name;
  ParameterValue defaultValue;
  double minValue = 0.0, maxValue = 0.0;  // inclusive; numbers only
  std::vector<std::string> choices;       // strings only
  std::string help;
  std::string source;  // paper, equation, or the measurement behind the default
};

using ParameterMap = std::map<std::string, ParameterValue>;

enum class BiasClass { unbiased, consistent, biased };

// One mode of an integrator ("biased", "unbiased", or "" where there is only one).
struct ModeInfo {
  std::string name;
  BiasClass bias = BiasClass::unbiased;
  std::string why;
};

// A buffer of bytesPerPixel x pixels, bound in order to the kernel's Buffers struct.
struct BufferInfo {
  std::string name;
  uint32_t bytesPerPixel = 0;
  uint32_t neededFeatures = 0;  // allocated only when the mask has one of these bits; 0: always
  int swapWith = -1;            // index of the buffer it trades places with at the end of a frame
  const char* perParameter =
      nullptr;  // an integer parameter: so many entries of bytesPerPixel a pixel
};

struct PassInfo {
  std::string name;    // as in the time columns
  std::string kernel;  // as in CMake's rl_add_kernel
};

struct IntegratorInfo {
  std::string name;
  std::string summary;  // one line
  std::vector<ModeInfo> modes;
  std::vector<ParameterInfo> parameters;
  bool usesCache = false;  // has reservoirs that live in a cache
  // Buffers in the order of the kernels' Buffers struct; buffer 0 is the radiance (12 bytes).
  std::vector<BufferInfo> buffers;
  std::vector<PassInfo> passes;
  // Where parameters decide whether a mode keeps its promise; empty: the mode's own class.
  std::function<BiasClass(const std::string& mode, const ParameterMap&)> biasOfParameters;
  // Packs validated parameters into the block that kernels read as gParams.
  std::function<std::vector<std::byte>(const std::string& mode, const ParameterMap&)>
      packParameters;
};

// All integrators of integrators.list, in its order.
const std::vector<const IntegratorInfo*>& integratorRegistry();
// Throws Error (badUsage) with the nearest name.
const IntegratorInfo& findIntegrator(const std::string& name);
// Defaults overlaid by `given`; throws Error (badUsage) on unknown names, types, ranges, choices.
ParameterMap resolveParameters(const IntegratorInfo& info, const ParameterMap& given);
// What may be said of a mode with these resolved parameters.
BiasClass biasClassOf(const IntegratorInfo& info, const std::string& mode,
                      const ParameterMap& parameters);
// Bytes a pixel of a buffer, with resolved parameters.
uint32_t bytesPerPixelOf(const BufferInfo& buffer, const ParameterMap& parameters);

}  // namespace restlab
