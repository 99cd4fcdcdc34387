// Registries as JSON: the output of `restlab list KIND --json`.
#pragma once

#include <nlohmann/json.hpp>

#include "core/frame/part.h"

namespace restlab {

// Returns "name", "default", "range" of numbers, "choices", "help" and "source".
nlohmann::ordered_json parameterJson(const ParameterInfo& parameter);
nlohmann::ordered_json parameterValueJson(const ParameterValue& value);

// Settings of light transport.
nlohmann::ordered_json transportSettingsJson();

// Return arrays in the order of the registries.
nlohmann::ordered_json integratorsJson();
nlohmann::ordered_json cachesJson();
nlohmann::ordered_json backendsJson();
// Lists available denoisers first, then those that the program was built without.
nlohmann::ordered_json denoisersJson();
nlohmann::ordered_json metricsJson();
// Kinds of materials: the closures, and those that the lobes of glTF stand for.
nlohmann::ordered_json closuresJson();
// Kinds of shapes beside triangles.
nlohmann::ordered_json shapesJson();

}  // namespace restlab
