// Lamps that are off, dimmed or brighter than the scene has them.
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace restlab {

// Instead of a light's name: all of them.
constexpr const char* kAllLights = "all";

// Names that withLightFactor() knows, each once: of meshes that emit, of their materials, of
// punctual lights, and "environment".
std::vector<std::string> lightNames(const Scene& scene);

// Throws Error (badUsage) with the nearest name where no light of the scene has it.
void requireLight(const Scene& scene, const std::string& name);

// The scene in which every light of that name, or all of them, gives `factor` times the light that
// was loaded: the last factor of a light counts. One that is off keeps its place in the light table
// and its features, so that histories stay valid. Throws Error (badUsage) as requireLight() does,
// and for a factor that is negative or not finite.
Scene withLightFactor(Scene scene, const std::string& name, double factor);

// The factors of all meshes' materials, punctual lights and the environment, in this order; empty
// where all are 1.
std::vector<float> lightFactors(const Scene& scene);

}  // namespace restlab
