// Puts a built-in scene together: materials, meshes, camera, content hash.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>

#include "core/scene/scene.h"

namespace restlab::builtin {

// Pure diffuse reflection of the given albedo (specular 0, metallic 0), double-sided.
rl::Material lambert(const glm::vec3& albedo);
// A black body of the given radiance (W sr^-1 m^-2), emitting on its front side only.
rl::Material lamp(const glm::vec3& radiance);
// Metal of the given reflectance at normal incidence; roughness is perceptual, 0 a mirror.
rl::Material metal(const glm::vec3& f0, float roughness);
// Lambert base under a dielectric layer of index of refraction 1.5.
rl::Material plastic(const glm::vec3& albedo, float roughness);
// A solid dielectric of index of refraction 1.5 that transmits; absorption in 1/m.
rl::Material glass(float roughness, const glm::vec3& sigmaAbsorption);

// Radiance 1 from everywhere.
EnvironmentMap uniformEnvironment();

class SceneBuilder {
 public:
  explicit SceneBuilder(const std::string& name) { scene_.name = name; }

  uint32_t addMaterial(const std::string& name, const rl::Material& data);
  // Adds a mesh in world space, used once under its own name.
  void add(MeshGeometry mesh, uint32_t material);
  // Adds a mesh to be placed with place().
  uint32_t addGeometry(MeshGeometry mesh);
  void place(const std::string& name, uint32_t geometry, uint32_t material,
             const glm::dmat4& objectToWorld);
  // A perspective camera of free aspect ratio at `eye`, upright, looking at `target`.
  void addCamera(const std::string& name, const glm::dvec3& eye, const glm::dvec3& target,
                 double yfovDegrees);
  void addLight(const PunctualLight& light) { scene_.lights.push_back(light); }
  void setEnvironment(EnvironmentMap map) { scene_.environment = std::move(map); }

  // The scene with its content hash; the builder is spent.
  Scene finish();

 private:
  Scene scene_;
};

// Hash of everything that determines the image: equal data, equal hash.
uint64_t hashOf(const Scene& scene);

}  // namespace restlab::builtin
