#include "tests/analytic/inconsistent_normals.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"

namespace restlab::analytic {

uint32_t addBumps(Scene& scene, float sine) {
  constexpr uint32_t n = 16;
  TextureImage image{"bumps", n, n, {}};
  const auto byteOf = [](double x) {
    return static_cast<uint32_t>(std::lround((0.5 + 0.5 * x) * 255.0));
  };
  for (uint32_t i = 0; i < n * n; ++i) {
    const double x = sine * std::sin(glm::two_pi<double>() * (i % n) / n);
    const double y = sine * std::sin(glm::two_pi<double>() * (i / n) / n);
    const double z = std::sqrt(1.0 - x * x - y * y);
    image.texels.push_back(byteOf(x) | byteOf(y) << 8 | byteOf(z) << 16 | 255u << 24);
  }
  scene.images.push_back(image);
  TextureUse use;
  use.image = static_cast<uint32_t>(scene.images.size() - 1);
  use.uvRow0 = {8.0f, 0.0f, 0.0f};
  use.uvRow1 = {0.0f, 8.0f, 0.0f};
  scene.textureUses.push_back(use);
  return static_cast<uint32_t>(scene.textureUses.size() - 1);
}

Scene solidInFurnace(Solid solid, const rl::Material& material) {
  MeshGeometry mesh = builtin::sphere("solid", glm::dvec3(0.0), 1.0, solid == Solid::smooth ? 1 : 4,
                                      solid != Solid::flat);
  // UVs go around the sphere once; faces at the seam run backwards, where bumps are still bumps.
  for (const glm::vec3& p : mesh.positions) {
    mesh.uvs[0].emplace_back(std::atan2(p.z, p.x) * glm::one_over_two_pi<float>(),
                             std::acos(glm::clamp(p.y, -1.0f, 1.0f)) * glm::one_over_pi<float>());
  }
  builtin::SceneBuilder builder("solid in a furnace");
  builder.add(mesh, builder.addMaterial("material", material));
  EnvironmentMap uniform;
  uniform.source = "uniform radiance 1";
  uniform.width = 16;
  uniform.height = 8;
  uniform.radiance.assign(size_t(uniform.width) * uniform.height, glm::vec3(1.0f));
  builder.setEnvironment(uniform);
  builder.addCamera("front", {0.0, 0.4, 3.2}, {0.0, 0.0, 0.0}, 45.0);
  Scene scene = builder.finish();
  if (solid == Solid::mapped)
    scene.materials.at(0).data.textures[rl::RL_TEX_NORMAL] = addBumps(scene, 0.6f);
  return scene;
}

}  // namespace restlab::analytic
