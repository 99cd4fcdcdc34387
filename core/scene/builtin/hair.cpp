// A ball with hair, on a floor under a lamp.
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/builtin/random.h"
#include "core/scene/builtin/scenes.h"
#include "core/scene/curves/curve_words.h"
#include "core/scene/curves/stand_in.h"
#include "core/scene/shapes/shape_info.h"

namespace restlab::builtin {

namespace {

// Roots are spread evenly over the ball around the origin. Strands begin within it, lean, curl and
// fall.
Strands hairOf(uint32_t count) {
  constexpr double kStep = 0.14, kRoot = 0.008, kTip = 0.003;
  constexpr int kPoints = 8;
  SceneRandom random(7);
  Strands strands;
  for (uint32_t i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count,
                 phi = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double r = std::sqrt(1.0 - z * z);
    const glm::dvec3 out(r * std::cos(phi), r * std::sin(phi), z);
    glm::dvec3 dir = out;
    glm::dvec3 at = 0.5 * out - kStep * dir;
    const glm::dvec3 lean(random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2),
                          random.uniform(-0.5, -0.3));
    for (int k = 0; k < kPoints; ++k) {
      strands.points.emplace_back(at, glm::mix(kRoot, kTip, k / (kPoints - 1.0)));
      at += kStep * dir;
      dir = glm::normalize(
          dir + lean +
          0.15 * glm::dvec3(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), 0.0));
    }
    strands.counts.push_back(kPoints);
  }
  return strands;
}

}  // namespace

Scene makeHair(const HairShape& hair) {
  SceneBuilder scene("hair");
  const uint32_t floor = scene.addMaterial("floor", lambert({0.55f, 0.53f, 0.5f}));
  scene.add(grid("floor", {-6.0, 0.0, 6.0}, {12.0, 0.0, 0.0}, {0.0, 0.0, -12.0}, 1, 1), floor);
  scene.add(quad("lamp", {-1.6, 4.0, 0.4}, {1.6, 0.0, 0.0}, {0.0, 0.0, 1.6}),
            scene.addMaterial("lamp", lamp({22.0f, 20.0f, 18.0f})));
  glm::dmat4 place = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 1.1, 0.0));
  place = glm::rotate(place, glm::radians(-90.0), glm::dvec3(1.0, 0.0, 0.0));
  scene.place("ball", scene.addGeometry(sphere("ball", glm::dvec3(0.0), 0.49, 5)),
              scene.addMaterial("skin", lambert({0.6f, 0.4f, 0.3f})), place);
  const std::vector<uint32_t> words = curveWords(cutStrands(hairOf(hair.count), kStrandError));
  MeshGeometry geometry =
      hair.isMesh ? tubesOf(words, true) : makeShape({findShape("curves"), {}, words}, "hair");
  geometry.name = "hair";
  scene.place("hair", scene.addGeometry(std::move(geometry)),
              scene.addMaterial("hair", plastic({0.35f, 0.16f, 0.06f}, 0.35f)), place);
  scene.addCamera("front", {0.0, 1.5, 4.6}, {0.0, 0.95, 0.0}, 32.0);
  return scene.finish();
}

}  // namespace restlab::builtin
