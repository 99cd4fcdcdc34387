// A hall of 24 x 9 x 36 m under garlands of lamps: 5,000 small squares, 10,000 emissive triangles,
// unless another number is asked for; together they have the same power. A lamp's power is drawn
// log-uniformly over three decades, so uniform selection wastes most samples: the strongest tenth
// gives half the light. Lambert throughout.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/builtin/random.h"
#include "core/scene/builtin/scenes.h"

namespace restlab::builtin {
namespace {

constexpr int kMostGarlands = 100, kLampsPerGarland = 50;
// A lamp of rank t in [0, 1) has side 0.025 x 10^(0.85 t) metres and radiance 2 x 10^(1.4 t) W
// sr^-1 m^-2: its power spans 3.1 decades, half of them by size, so that the visible lamps do not
// dominate the image. Radiance comes in steps, one material each.
constexpr int kRadianceSteps = 16;
constexpr double kSmallestSide = 0.025, kSideDecades = 0.85;
constexpr double kDimmestRadiance = 2.0, kRadianceDecades = 1.4;
constexpr std::array<glm::vec3, 4> kTints{
    {{1.0f, 0.72f, 0.42f}, {1.0f, 0.92f, 0.80f}, {0.72f, 0.85f, 1.0f}, {1.0f, 0.45f, 0.35f}}};
constexpr double kHallHalfWidth = 12.0, kHallHeight = 9.0, kLength = 36.0;

// Makes a square that faces down, tilted by up to 40 degrees in a random direction.
MeshGeometry lampSquare(SceneRandom& random, const glm::dvec3& center, double side) {
  const double azimuth = random.uniform(0.0, 2.0 * glm::pi<double>());
  const double tilt = random.uniform(0.0, glm::radians(40.0));
  const double turn = random.uniform(0.0, glm::half_pi<double>());
  const glm::dvec3 normal(std::sin(tilt) * std::cos(azimuth), -std::cos(tilt),
                          std::sin(tilt) * std::sin(azimuth));
  const glm::dvec3 helper(std::cos(turn), 0.0, std::sin(turn));
  const glm::dvec3 u = glm::normalize(helper - normal * glm::dot(helper, normal)) * side;
  const glm::dvec3 v = glm::cross(normal, u);
  return quad("lamps", center - 0.5 * (u + v), u, v);
}

// Garlands hang across the hall, each from a hook on the left to one on the right.
// Fewer lamps hang on fewer garlands, more lamps closer together.
void addLamps(SceneBuilder& scene, int lamps) {
  const int garlands = std::clamp(lamps / kLampsPerGarland, 1, kMostGarlands);
  const int perGarland = lamps / garlands;
  const double sideFactor =
      std::sqrt(double(kMostGarlands * kLampsPerGarland) / double(garlands * perGarland));

  std::array<MeshGeometry, size_t(kRadianceSteps) * kTints.size()> byMaterial;
  SceneRandom random(2024);
  for (int g = 0; g < garlands; ++g) {
    // One draw per statement: C++ leaves the evaluation order of arguments to the compiler.
    const double heightLeft = random.uniform(5.0, 8.6);
    const double heightRight = random.uniform(5.0, 8.6);
    const double z = -random.uniform(0.5, kLength - 0.5);
    const double slant = random.uniform(-0.4, 0.4);
    const glm::dvec3 left(-kHallHalfWidth + 0.3, heightLeft, z);
    const glm::dvec3 right(kHallHalfWidth - 0.3, heightRight, z + slant);
    const double sag = random.uniform(0.4, 2.2);
    for (int i = 0; i < perGarland; ++i) {
      const double t = (i + random.uniform(0.2, 0.8)) / perGarland;
      glm::dvec3 center = glm::mix(left, right, t);
      center.y -= 4.0 * sag * t * (1.0 - t);
      const double rank = random.uniform();
      const size_t step = size_t(rank * kRadianceSteps);
      const size_t tint = size_t(random.uniform(0.0, double(kTints.size())));
      const double side = sideFactor * kSmallestSide * std::pow(10.0, kSideDecades * rank);
      append(byMaterial[step * kTints.size() + tint], lampSquare(random, center, side));
    }
  }
  for (size_t m = 0; m < byMaterial.size(); ++m) {
    if (byMaterial[m].triangles.empty()) continue;
    const size_t step = m / kTints.size(), tint = m % kTints.size();
    const double radiance =
        kDimmestRadiance * std::pow(10.0, kRadianceDecades * double(step) / (kRadianceSteps - 1));
    byMaterial[m].name = "lamps-" + std::to_string(step) + "-" + std::to_string(tint);
    scene.add(byMaterial[m],
              scene.addMaterial(byMaterial[m].name, lamp(kTints[tint] * float(radiance))));
  }
}

void addHall(SceneBuilder& scene) {
  const uint32_t stone = scene.addMaterial("stone", lambert({0.62f, 0.58f, 0.52f}));
  const uint32_t floor = scene.addMaterial("floor", lambert({0.38f, 0.32f, 0.28f}));
  const uint32_t tile = scene.addMaterial("tile", lambert({0.16f, 0.22f, 0.32f}));
  const uint32_t wall = scene.addMaterial("wall", lambert({0.55f, 0.30f, 0.24f}));
  const double w = kHallHalfWidth, h = kHallHeight, l = kLength;
  scene.add(quad("ceiling", {-w, h, -l}, {2 * w, 0, 0}, {0, 0, l}), stone);
  scene.add(quad("end", {-w, 0, -l}, {2 * w, 0, 0}, {0, h, 0}), wall);
  scene.add(quad("entrance", {w, 0, 0}, {-2 * w, 0, 0}, {0, h, 0}), wall);
  scene.add(quad("left", {-w, 0, 0}, {0, 0, -l}, {0, h, 0}), wall);
  scene.add(quad("right", {w, 0, -l}, {0, 0, l}, {0, h, 0}), wall);

  // Checkered floor: squares of two metres.
  std::array<MeshGeometry, 2> squares;
  squares[0].name = "floor-light";
  squares[1].name = "floor-dark";
  for (int i = 0; i < 12; ++i) {
    for (int j = 0; j < 18; ++j) {
      append(squares[size_t((i + j) % 2)],
             quad("", {-w + 2.0 * i, 0, -2.0 * j}, {2, 0, 0}, {0, 0, -2}));
    }
  }
  scene.add(squares[0], floor);
  scene.add(squares[1], tile);

  MeshGeometry columns, blocks;
  columns.name = "columns";
  blocks.name = "bases";
  for (const double x : {-6.5, 6.5}) {
    for (int i = 0; i < 7; ++i) {
      const double z = -4.0 - 5.0 * i;
      append(columns, cylinder("", {x, 0.401, z}, 0.45, 8.198, 48));
      append(blocks, box("", {x - 0.65, 0.001, z - 0.65}, {x + 0.65, 0.40, z + 0.65}));
      append(blocks, box("", {x - 0.65, 8.6, z - 0.65}, {x + 0.65, 8.999, z + 0.65}));
    }
  }
  scene.add(columns, stone);
  scene.add(blocks, stone);
  scene.add(sphere("globe", {0.0, 1.501, -14.0}, 1.5, 5), stone);
}

}  // namespace

Scene makeManyLights(int lamps) {
  SceneBuilder scene("many-lights");
  addHall(scene);
  addLamps(scene, lamps);
  scene.addCamera("entrance", {-1.5, 2.6, -0.6}, {0.3, 1.6, -14.0}, 52.0);
  return scene.finish();
}

}  // namespace restlab::builtin
