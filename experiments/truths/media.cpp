#include "experiments/truths/media.h"

#include <algorithm>

#include "experiments/truths/film.h"

namespace restlab::analytic {
namespace {

struct Slab {
  double nearZ, farZ;
  glm::dvec3 sigma;
};

Slab slabOf(const Scene& scene, const char* name) {
  const MeshInstance& instance = instanceNamed(scene, name);
  const MeshGeometry& mesh = scene.geometries.at(instance.geometry);
  Slab slab{-1e30, 1e30, glm::dvec3(scene.materials.at(instance.material).data.sigmaAbsorption)};
  for (const glm::vec3& p : mesh.positions) {
    slab.nearZ = std::max(slab.nearZ, double(p.z));
    slab.farZ = std::min(slab.farZ, double(p.z));
  }
  return slab;
}

}  // namespace

std::string whyNotMedia(const Scene&, const ExactView& view) {
  if (view.moved) return "from a camera that is not its own";
  // Surfaces of index 1 count as scattering events, too.
  return view.scatteringEvents < 5 ? "below 5 scattering events" : "";
}

std::vector<glm::dvec3> mediaImage(const Scene& scene, const ExactView& view) {
  const Slab around = slabOf(scene, "around"), nearer = slabOf(scene, "near"),
             far = slabOf(scene, "far");
  const bool farWins = scene.materials.at(instanceNamed(scene, "far").material).priority > 0;
  const double border = farWins ? far.nearZ : nearer.farZ;
  const double eyeZ = cameraOf(scene, view).cameraToWorld[3].z;
  const double inAround = (eyeZ - nearer.nearZ) + (far.farZ - around.farZ);
  const glm::dvec3 exponent = around.sigma * inAround + nearer.sigma * (nearer.nearZ - border) +
                              far.sigma * (border - far.farZ);
  return std::vector<glm::dvec3>(size_t(view.width) * view.height,
                                 glm::exp(-exponent) * double(scene.environment->lightFactor));
}

}  // namespace restlab::analytic
