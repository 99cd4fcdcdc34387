// The BSDF of one material on the host, by the kernels' own functions: for checks and tables.
#pragma once

#include <glm/glm.hpp>
#include <memory>

#include "core/scene/scene.h"

namespace restlab {

struct BsdfDraw {
  glm::dvec3 wi{0.0};
  glm::dvec3 weight{0.0};  // f |cos| / pdf
  double pdf = 0.0;        // per solid angle; of a delta lobe the probability of the lobe
  bool isDelta = false;
  bool isNone = true;  // absorbed
};

// Directions are local: z along the normal, x along the tangent, away from the surface. The surface
// is seen from its front.
class BsdfProbe {
 public:
  // `scene` has the images, tables and other materials that the material names; images are read at
  // uv (0, 0).
  BsdfProbe(const SceneMaterial& material, const Scene& scene);
  ~BsdfProbe();

  // f |cos_i| of all lobes but delta lobes, and the density of draw().
  glm::dvec3 eval(const glm::dvec3& wo, const glm::dvec3& wi, double& pdf) const;
  BsdfDraw draw(const glm::dvec3& wo, double uLobe, const glm::dvec2& u) const;
  double alpha() const;          // roughness of the narrowest lobe
  bool hasDelta() const;         // a mirror's or smooth glass's
  bool hasSpecular() const;      // a rough lobe about the mirrored direction
  bool hasTransmission() const;  // light passes

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace restlab
