// Light factors: lights that are off, dimmed or brighter than in the scene.
#pragma once

#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace restlab {

// Name that stands for all lights.
constexpr const char* kAllLights = "all";

// Names that withLightFactor() accepts, without duplicates: those of emitting meshes, their
// materials, punctual lights, and "environment".
std::vector<std::string> lightNames(const Scene& scene);

// Throws Error (badUsage) with the nearest name if no light of the scene has this name.
void requireLight(const Scene& scene, const std::string& name);

// Returns the scene with every light of that name, or all of them, giving `factor` times the light
// that was loaded; the last factor of a light replaces earlier ones. A light that is off keeps its
// place in the light table and its features, so that histories stay valid. Throws Error (badUsage)
// as requireLight() does, and for a negative or non-finite factor.
Scene withLightFactor(Scene scene, const std::string& name, double factor);

// Factors of all meshes' materials, punctual lights and the environment, in this order; empty if
// all are 1.
std::vector<float> lightFactors(const Scene& scene);

}  // namespace restlab
