// Furnaces: scenes whose radiance is known exactly, at every pixel and for every path length.
#include <glm/gtc/matrix_transform.hpp>

#include "core/base/error.h"
#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/builtin/scenes.h"

namespace restlab::builtin {

namespace {

constexpr glm::dvec3 kRoomLow(-2.0, 0.0, -3.0), kRoomHigh(2.0, 3.0, 2.0);

// Adds a room around the first one, `wall` away from it. No light of the outer room may come
// through.
void addRoomBeyond(SceneBuilder& scene, rl::Material glowing, double wall) {
  glowing.emission *= 1e6f;
  const uint32_t bright = scene.addMaterial("glowing, beyond", glowing);
  const glm::dvec3 low = kRoomLow - wall, high = kRoomHigh + wall;
  scene.add(box("outer face of the wall", low, high), bright);
  scene.add(insideOut(box("room beyond", low - 1.0, high + 1.0)), bright);
}

}  // namespace

// A closed room and a block in it; every surface has albedo a and emits L = 1/2. Every ray
// that leaves a surface meets another one like it, so the radiance after n scattering events is
//   L (1 + a + ... + a^n) = L (1 - a^(n+1)) / (1 - a)
// at every pixel; for a = 1/2 that is 1 - 2^-(n+1), and 1 without a limit. The block makes light
// samples need their shadow rays.
Scene makeFurnace(const FurnaceShape& shape) {
  if (shape.wall && shape.height != 1.0)
    failInput("scene 'furnace': 'wall' is of a room of full height; leave 'height' out");
  SceneBuilder scene("furnace");
  rl::Material glowing = lambert(glm::vec3(static_cast<float>(shape.albedo)));
  glowing.emission = glm::vec3(0.5f);
  glowing.flags = 0u;  // one side suffices: the walls look inwards, the block outwards
  const uint32_t wall = scene.addMaterial("glowing", glowing);
  const glm::dmat4 flat = glm::scale(glm::dmat4(1.0), {1.0, shape.height, 1.0});
  scene.add(transformed(insideOut(box("room", kRoomLow, kRoomHigh)), flat), wall);
  const MeshGeometry block = box("block", {-0.6, shape.gap, -1.6}, {0.6, shape.gap + 1.0, -0.6});
  scene.add(transformed(block, flat * turnAbout({0.0, 0.0, -1.1}, 30.0)), wall);
  if (shape.wall) addRoomBeyond(scene, glowing, *shape.wall);
  scene.addCamera("inside", {0.3, 1.6 * shape.height, 1.7}, {0.0, 1.3 * shape.height, -1.1}, 60.0);
  return scene.finish();
}

// A convex solid of albedo 1 in an environment of radiance 1. All light that the solid scatters
// comes straight from the environment: radiance is 1 at every pixel from one scattering event on,
// and the solid is invisible. Flat faces: an interpolated normal would lose light below the face's
// horizon. Metal of reflectance 1 is as white if multiple scattering between microfacets is kept
// (--multiscatter).
Scene makeSphereFurnace(std::optional<double> roughness) {
  SceneBuilder scene("sphere-furnace");
  const rl::Material material =
      roughness ? metal(glm::vec3(1.0f), static_cast<float>(*roughness)) : lambert(glm::vec3(1.0f));
  const uint32_t white = scene.addMaterial("white", material);
  scene.add(sphere("solid", {0.0, 0.0, 0.0}, 1.0, 4, false), white);
  scene.setEnvironment(uniformEnvironment());
  scene.addCamera("front", {0.0, 0.4, 3.2}, {0.0, 0.0, 0.0}, 45.0);
  return scene.finish();
}

}  // namespace restlab::builtin
