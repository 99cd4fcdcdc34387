#include "tests/unit/bsdf_cases.h"

#include <cmath>
#include <numbers>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "tests/unit/dialect_context.h"

namespace restlab::unit {
namespace {

using builtin::glass;
using builtin::lambert;
using builtin::metal;
using builtin::plastic;

const glm::vec3 kOrange(0.8f, 0.5f, 0.2f);

rl::Material transmissive(float roughness, float transmission, float metallic) {
  rl::Material m = plastic(kOrange, roughness);
  m.transmission = transmission;
  m.metallic = metallic;
  return m;
}

rl::Material thin(rl::Material m) {
  m.flags |= rl::RL_MATERIAL_THIN;
  return m;
}

rl::Material withIor(rl::Material m, float ior) {
  m.ior = ior;
  return m;
}

rl::Material withSpecular(rl::Material m, float specular,
                          const glm::vec3& color = glm::vec3(1.0f)) {
  m.specular = specular;
  m.specularColor = color;
  return m;
}

}  // namespace

rl::Bsdf bsdfOf(const rl::Material& material, bool front) {
  builtin::SceneBuilder builder("one triangle");
  const uint32_t id = builder.addMaterial("material", material);
  builder.add(builtin::quad("quad", {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), id);
  Dialect<> d(CompiledScene::build(builder.finish()));
  const rl::Hit hit{0, 0, {0.25f, 0.25f}, 1.0f};
  return d->surfaceLoad(hit, {0.0f, 0.0f, front ? -1.0f : 1.0f}).bsdf;
}

std::vector<BsdfCase> continuousBsdfs() {
  std::vector<BsdfCase> cases;
  auto add = [&](const std::string& name, const rl::Material& m, bool front = true) {
    cases.push_back({name, bsdfOf(m, front)});
  };
  add("lambert", lambert(kOrange));
  add("metal, alpha 1", metal(kOrange, 1.0f));
  add("metal, alpha 0.3", metal(kOrange, std::sqrt(0.3f)));
  add("metal, alpha 0.02", metal(kOrange, std::sqrt(0.02f)));
  add("metal, alpha 0.002", metal(glm::vec3(1.0f), std::sqrt(0.002f)));
  add("coat, roughness 0.05", plastic(kOrange, 0.05f));
  add("coat, roughness 0.3", plastic(kOrange, 0.3f));
  add("coat, roughness 1", plastic(kOrange, 1.0f));
  add("coat, white base", plastic(glm::vec3(1.0f), 0.3f));
  add("coat, black base", plastic(glm::vec3(0.0f), 0.3f));
  add("coat, specular 0.5, tinted", withSpecular(plastic(kOrange, 0.4f), 0.5f, {0.9f, 0.4f, 0.1f}));
  add("metallic 0.5", transmissive(0.5f, 0.0f, 0.5f));
  for (const float alpha : {0.02f, 0.1f, 0.5f}) {
    const std::string roughness = ", alpha " + std::to_string(alpha).substr(0, 4);
    add("glass, eta 1.5" + roughness, glass(std::sqrt(alpha), glm::vec3(0.0f)), true);
    add("glass, eta 1/1.5" + roughness, glass(std::sqrt(alpha), glm::vec3(0.0f)), false);
  }
  add("thin glass, alpha 0.1", thin(glass(std::sqrt(0.1f), glm::vec3(0.0f))));
  add("thin glass, alpha 0.5", thin(glass(std::sqrt(0.5f), glm::vec3(0.0f))));
  add("metallic 0.5, transmission 0.5", transmissive(0.5f, 0.5f, 0.5f));
  add("metallic 0.5, transmission 0.5, from inside", transmissive(0.5f, 0.5f, 0.5f), false);
  add("transmission 0.5, ior nearly 1", withIor(transmissive(0.4f, 0.5f, 0.0f), 1.01f));
  add("transmission 0.5, specular 0", withSpecular(transmissive(0.4f, 0.5f, 0.0f), 0.0f));
  add("transmission 0.5, ior 0", withIor(transmissive(0.4f, 0.5f, 0.0f), 0.0f));
  add("transmission 0.5, ior 4", withIor(transmissive(0.4f, 0.5f, 0.0f), 4.0f));
  add("transmission 0.5, ior 4, from inside", withIor(transmissive(0.4f, 0.5f, 0.0f), 4.0f), false);
  add("transmission 0.5, ior 1.8, thin", thin(withIor(transmissive(0.3f, 0.5f, 0.0f), 1.8f)));
  return cases;
}

std::vector<BsdfCase> deltaBsdfs() {
  std::vector<BsdfCase> cases;
  auto add = [&](const std::string& name, const rl::Material& m, bool front = true) {
    cases.push_back({name, bsdfOf(m, front)});
  };
  add("mirror", metal(kOrange, 0.0f));
  add("smooth coat", plastic(kOrange, 0.0f));
  add("smooth glass, eta 1.5", glass(0.0f, glm::vec3(0.0f)));
  add("smooth glass, eta 1/1.5", glass(0.0f, glm::vec3(0.0f)), false);
  add("smooth thin glass", thin(glass(0.0f, glm::vec3(0.0f))));
  add("smooth, metallic 0.5, transmission 0.5", transmissive(0.0f, 0.5f, 0.5f));
  add("smooth, metallic 0.5, transmission 0.5, inside", transmissive(0.0f, 0.5f, 0.5f), false);
  add("rough, transmission 0.5, ior 1", withIor(transmissive(0.4f, 0.5f, 0.0f), 1.0f));
  add("smooth, transmission 0.5, ior 1", withIor(transmissive(0.0f, 0.5f, 0.0f), 1.0f));
  add("smooth, transmission 0.5, ior 0", withIor(transmissive(0.0f, 0.5f, 0.0f), 0.0f));
  add("smooth, transmission 0.5, ior 4, inside", withIor(transmissive(0.0f, 0.5f, 0.0f), 4.0f),
      false);
  add("smooth, transmission 0.5, specular 0", withSpecular(transmissive(0.0f, 0.5f, 0.0f), 0.0f));
  return cases;
}

glm::vec3 directionAt(double degrees) {
  const double theta = degrees * std::numbers::pi / 180.0;
  return glm::vec3(std::sin(theta) * std::cos(0.7), std::sin(theta) * std::sin(0.7),
                   std::cos(theta));
}

}  // namespace restlab::unit
