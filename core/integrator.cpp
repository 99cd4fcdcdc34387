#include "core/integrator.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"

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

void checkRange(const IntegratorInfo& info, const ParameterInfo& p, double value) {
  if (value >= p.minValue && value <= p.maxValue) return;
  failUsage(fmt::format("{}.{} = {}: must be between {} and {}", info.name, p.name, value,
                        p.minValue, p.maxValue));
}

ParameterValue checked(const IntegratorInfo& info, const ParameterInfo& p, ParameterValue value) {
  // An integer is accepted where a number is meant.
  if (p.defaultValue.index() == 2 && value.index() == 1)
    value = static_cast<double>(std::get<int64_t>(value));
  if (value.index() != p.defaultValue.index()) {
    failUsage(fmt::format("{}.{}: is {} but must be {}", info.name, p.name, typeName(value),
                          typeName(p.defaultValue)));
  }
  if (value.index() == 1) checkRange(info, p, static_cast<double>(std::get<int64_t>(value)));
  if (value.index() == 2) checkRange(info, p, std::get<double>(value));
  if (value.index() == 3 && !p.choices.empty()) {
    const std::string& text = std::get<std::string>(value);
    if (std::find(p.choices.begin(), p.choices.end(), text) == p.choices.end()) {
      failUsage(fmt::format("{}.{} = '{}': must be one of {}{}", info.name, p.name, text,
                            fmt::join(p.choices, ", "), didYouMean(text, p.choices)));
    }
  }
  return value;
}

}  // namespace

const IntegratorInfo& findIntegrator(const std::string& name) {
  std::vector<std::string> names;
  for (const IntegratorInfo* info : integratorRegistry()) {
    if (info->name == name) return *info;
    names.push_back(info->name);
  }
  failUsage("unknown integrator '" + name + "'" + didYouMean(name, names) +
            " (see: restlab list integrators)");
}

ParameterMap resolveParameters(const IntegratorInfo& info, const ParameterMap& given) {
  ParameterMap resolved;
  std::vector<std::string> names;
  for (const ParameterInfo& p : info.parameters) {
    resolved[p.name] = p.defaultValue;
    names.push_back(p.name);
  }
  for (const auto& [name, value] : given) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
      failUsage(fmt::format("integrator {} has no parameter '{}'{}", info.name, name,
                            didYouMean(name, names)));
    }
    resolved[name] =
        checked(info, info.parameters[static_cast<size_t>(found - names.begin())], value);
  }
  return resolved;
}

BiasClass biasClassOf(const IntegratorInfo& info, const std::string& mode,
                      const ParameterMap& parameters) {
  if (info.biasOfParameters) return info.biasOfParameters(mode, parameters);
  for (const ModeInfo& m : info.modes) {
    if (m.name == mode) return m.bias;
  }
  return BiasClass::biased;
}

uint32_t bytesPerPixelOf(const BufferInfo& buffer, const ParameterMap& parameters) {
  if (buffer.perParameter == nullptr) return buffer.bytesPerPixel;
  return buffer.bytesPerPixel *
         static_cast<uint32_t>(std::get<int64_t>(parameters.at(buffer.perParameter)));
}

}  // namespace restlab
