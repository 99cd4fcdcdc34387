// Scenes of one surface each: a function that is 0 there, or a solid made of others.
#include <algorithm>
#include <array>
#include <glm/gtc/matrix_transform.hpp>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/builtin/scenes.h"
#include "core/scene/field/expression.h"
#include "core/scene/field/solid.h"

namespace restlab::builtin {

namespace {

struct NamedField {
  const char* name;
  const char* text;
  glm::vec3 reach;  // of an expression: half of its box
};

constexpr std::array<NamedField, 5> kSurfaces{{
    {"tangle", "x^4 - 5*x^2 + y^4 - 5*y^2 + z^4 - 5*z^2 + 11.8", {2.5f, 2.5f, 2.5f}},
    {"heart", "(x^2 + 9/4*y^2 + z^2 - 1)^3 - x^2*z^3 - 9/80*y^2*z^3", {1.4f, 0.9f, 1.4f}},
    {"gyroid",
     "max(abs(sin(5*x)*cos(5*y) + sin(5*y)*cos(5*z) + sin(5*z)*cos(5*x)) - 0.3, "
     "x^2 + y^2 + z^2 - 1)",
     {1.05f, 1.05f, 1.05f}},
    {"torus", "(sqrt(x^2 + y^2) - 0.7)^2 + z^2 - 0.0625", {1.0f, 1.0f, 0.3f}},
    {"saddle", "z - 0.6*(x^2 - y^2)", {1.0f, 1.0f, 1.0f}},
}};

constexpr std::array<NamedField, 4> kSolids{{
    {"cut-cube",
     "difference(intersection(box(0.75, 0.75, 0.75), sphere(1)), cylinder(3, 0.4), "
     "rotate(1, 0, 0, 90, cylinder(3, 0.4)), rotate(0, 1, 0, 90, cylinder(3, 0.4)))",
     {}},
    {"drops",
     "smooth_union(0.35, sphere(0.6), translate(0.7, 0, 0.3, sphere(0.35)), "
     "translate(-0.5, 0.3, 0.6, sphere(0.3)), translate(0, -0.2, 0.9, sphere(0.25)))",
     {}},
    {"column", "twist(90, round(0.05, box(0.35, 0.35, 0.95)))", {}},
    {"rough-ball", "displace(0.03, 20, sphere(0.9))", {}},
}};

template <size_t N>
std::vector<std::string> namesOf(const std::array<NamedField, N>& fields) {
  std::vector<std::string> names;
  for (const NamedField& field : fields) names.push_back(field.name);
  return names;
}

Scene fieldScene(const std::string& name, const char* kind, const FieldProgram& field) {
  SceneBuilder scene(name);
  const uint32_t floor = scene.addMaterial("floor", lambert({0.55f, 0.53f, 0.5f}));
  scene.add(grid("floor", {-6.0, 0.0, 6.0}, {12.0, 0.0, 0.0}, {0.0, 0.0, -12.0}, 1, 1), floor);
  scene.add(quad("lamp", {-1.6, 4.0, 0.4}, {1.6, 0.0, 0.0}, {0.0, 0.0, 1.6}),
            scene.addMaterial("lamp", lamp({16.0f, 15.0f, 14.0f})));
  rl::Material lacquer = plastic({0.12f, 0.3f, 0.55f}, 0.2f);
  lacquer.flags |= rl::RL_MATERIAL_DOUBLE_SIDED;
  const glm::vec3 extent = field.high - field.low, middle = 0.5f * (field.low + field.high);
  const double factor = 2.0 / double(std::max({extent.x, extent.y, extent.z}));
  glm::dmat4 place = glm::translate(glm::dmat4(1.0),
                                    glm::dvec3(0.0, 0.001 + 0.5 * factor * double(extent.z), 0.0));
  place = glm::rotate(place, glm::radians(30.0), glm::dvec3(0.0, 1.0, 0.0));
  place = glm::rotate(place, glm::radians(-90.0), glm::dvec3(1.0, 0.0, 0.0));
  place = glm::translate(glm::scale(place, glm::dvec3(factor)), -glm::dvec3(middle));
  scene.place("surface",
              scene.addGeometry(makeShape({findShape(kind), {}, fieldWords(field)}, "surface")),
              scene.addMaterial("lacquer", lacquer), place);
  scene.addCamera("front", {0.0, 1.9, 4.6}, {0.0, 0.85, 0.0}, 36.0);
  return scene.finish();
}

}  // namespace

const std::vector<std::string>& implicitSurfaces() {
  static const std::vector<std::string> kNames = namesOf(kSurfaces);
  return kNames;
}

const std::vector<std::string>& solids() {
  static const std::vector<std::string> kNames = namesOf(kSolids);
  return kNames;
}

Scene makeImplicit(size_t surface) {
  const NamedField& field = kSurfaces.at(surface);
  return fieldScene("implicit", "implicit", readExpression(field.text, -field.reach, field.reach));
}

Scene makeSdf(size_t solid) { return fieldScene("sdf", "sdf", readSolid(kSolids.at(solid).text)); }

}  // namespace restlab::builtin
