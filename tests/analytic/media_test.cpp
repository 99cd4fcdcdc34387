// Bodies that absorb and refract: around the camera, inside each other, overlapping, touching. With
// a white wall behind them, or a lamp among them; each truth is a product of Beer-Lambert
// transmittances.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/frame/session.h"
#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/compiled/compiled_scene.h"
#include "tests/scene/gltf_builder.h"

namespace restlab {
namespace {

using builtin::SceneBuilder;

const glm::vec3 kRed(0.2f, 1.0f, 2.0f), kBlue(1.5f, 0.7f, 0.1f);

// Material that absorbs, and refracts by its index.
rl::Material body(const glm::vec3& sigma, float ior = 1.0f, float roughness = 0.0f) {
  rl::Material m = builtin::glass(roughness, sigma);
  m.ior = ior;
  return m;
}

// A box around the z axis, so wide that all rays of the camera hit only its ends.
MeshGeometry box(double nearZ, double farZ, double halfWidth = 5.0) {
  return builtin::box("box", {-halfWidth, -halfWidth, farZ}, {halfWidth, halfWidth, nearZ});
}

// Adds a white wall, only behind the bodies: reflections of the bodies are black.
void addWhiteWall(SceneBuilder& builder) {
  builder.add(builtin::quad("white", {-20, -20, -8}, {40, 0, 0}, {0, 40, 0}),
              builder.addMaterial("white", builtin::lamp(glm::vec3(1.0f))));
}

// Adds a camera that looks along -Z from z = 0 with parallel rays.
Scene finish(SceneBuilder& builder) {
  Scene scene = builder.finish();
  SceneCamera camera;
  camera.kind = rl::RL_CAMERA_ORTHOGRAPHIC;
  camera.xmag = camera.ymag = 0.1;
  camera.cameraToWorld = glm::dmat4(1.0);
  scene.cameras = {camera};
  return scene;
}

struct Machine {
  const char* integrator;
  const char* rayTracing;
};
constexpr Machine kMachines[] = {{"path", "embree"}, {"path", "bvh"}, {"restir_gi", "embree"}};

// Compares the mean of all pixels over `frames` frames.
void expectImage(const Scene& scene, const glm::dvec3& expected, const std::string& what,
                 uint32_t frames = 1, double tolerance = 1e-4, uint32_t maxBounces = 16) {
  const auto compiled = CompiledScene::build(scene);
  for (const Machine& machine : kMachines) {
    SessionConfig config;
    config.integrator = machine.integrator;
    config.rayTracing = machine.rayTracing;
    config.width = config.height = 4;
    config.maxBounces = maxBounces;
    Session session(compiled, config);
    glm::dvec3 mean(0.0);
    for (uint32_t i = 0; i < frames; ++i) {
      session.frame();
      for (const glm::vec3& pixel : session.radiance().pixels)
        mean += glm::dvec3(pixel) / (16.0 * frames);
    }
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(mean[c], expected[c], tolerance * expected[c])
          << what << ", " << machine.integrator << ", " << machine.rayTracing << ", channel " << c;
    }
  }
}

glm::dvec3 through(const glm::vec3& sigma, double metres) {
  return glm::exp(-glm::dvec3(sigma) * metres);
}

TEST(Media, TheCameraIsInside) {
  SceneBuilder one("camera in a body");
  one.add(box(1.0, -1.5), one.addMaterial("red", body(kRed)));
  addWhiteWall(one);
  expectImage(finish(one), through(kRed, 1.5), "one body");

  SceneBuilder two("camera in two bodies");
  two.add(box(3.0, -2.0, 6.0), two.addMaterial("red", body(kRed)));
  two.add(box(1.0, -0.5), two.addMaterial("blue", body(kBlue)));
  addWhiteWall(two);
  expectImage(finish(two), through(kBlue, 0.5) * through(kRed, 1.5), "a body in a body");

  SceneBuilder dense("camera in glass");
  dense.add(box(1.0, -1.5), dense.addMaterial("red", body(kRed, 1.5f)));
  addWhiteWall(dense);
  const double reflected = std::pow(0.5 / 2.5, 2.0);
  // Radiance in glass is that in air times the square of the index.
  expectImage(finish(dense), 2.25 * (1.0 - reflected) * through(kRed, 1.5), "out of glass", 4000,
              0.01, 1);
}

// Two boxes of one mesh overlap around the camera: one body, which ends at the last of their faces.
TEST(Media, TheCameraIsInTwoShellsOfOneMesh) {
  SceneBuilder builder("shells");
  MeshGeometry mesh = box(1.0, -1.0);
  builtin::append(mesh, box(1.5, -2.0, 6.0));
  builder.add(mesh, builder.addMaterial("red", body(kRed)));
  addWhiteWall(builder);
  expectImage(finish(builder), through(kRed, 2.0), "shells of one mesh");
}

TEST(Media, BodiesOverlapTouchAndLieInEachOther) {
  struct Case {
    const char* name;
    double ends[4];  // ends of the red and of the blue body, along -Z
    double red, blue;
  };
  // The smaller of two overlapping bodies fills the place.
  for (const Case& c : {Case{"overlapping by 1 mm", {1.0, 2.0, 1.999, 2.5}, 0.999, 0.501},
                        Case{"the other way round", {1.501, 2.5, 1.0, 1.502}, 0.998, 0.502},
                        Case{"touching", {1.0, 2.0, 2.0, 2.5}, 1.0, 0.5},
                        Case{"touching, the other way round", {1.5, 2.5, 1.0, 1.5}, 1.0, 0.5},
                        Case{"inside", {1.0, 3.0, 1.5, 1.75}, 1.75, 0.25},
                        Case{"apart", {1.0, 2.0, 2.5, 3.0}, 1.0, 0.5}}) {
    SceneBuilder builder(c.name);
    builder.add(box(-c.ends[0], -c.ends[1]), builder.addMaterial("red", body(kRed)));
    builder.add(box(-c.ends[2], -c.ends[3]), builder.addMaterial("blue", body(kBlue)));
    addWhiteWall(builder);
    expectImage(finish(builder), through(kRed, c.red) * through(kBlue, c.blue), c.name);
  }
}

// The result must not depend on the face that a ray meets first.
TEST(Media, ThreeBodiesBeginInOnePlane) {
  const glm::vec3 green(0.9f, 0.1f, 0.6f);
  std::array<int, 3> order{0, 1, 2};
  do {
    SceneBuilder builder("flush");
    const uint32_t materials[] = {builder.addMaterial("red", body(kRed)),
                                  builder.addMaterial("blue", body(kBlue)),
                                  builder.addMaterial("green", body(green))};
    for (const int i : order) builder.add(box(-1.0, -2.0 - i), materials[i]);
    addWhiteWall(builder);
    expectImage(finish(builder), through(kRed, 1.0) * through(kBlue, 1.0) * through(green, 1.0),
                "order " + std::to_string(order[0]) + std::to_string(order[1]));
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(Media, APriorityDecidesWhoFillsThePlace) {
  SceneBuilder builder("priority");
  const uint32_t red = builder.addMaterial("red", body(kRed)),
                 blue = builder.addMaterial("blue", body(kBlue));
  builder.add(box(-1.0, -3.0), red);
  builder.add(box(-2.0, -3.5), blue);
  addWhiteWall(builder);
  Scene scene = finish(builder);
  expectImage(scene, through(kRed, 1.0) * through(kBlue, 1.5), "the smaller one");
  scene.materials[red].priority = 1;
  expectImage(scene, through(kRed, 2.0) * through(kBlue, 0.5), "the one of greater priority");
}

// A red box, a blue one and the white wall, through a glTF file.
Scene sceneOfFile(const nlohmann::json& redExtras, const nlohmann::json& blueExtras) {
  test::GltfBuilder file;
  const auto add = [&](const MeshGeometry& mesh, nlohmann::json material) {
    std::vector<float> positions;
    std::vector<uint32_t> corners;
    for (const glm::vec3& p : mesh.positions) positions.insert(positions.end(), {p.x, p.y, p.z});
    for (const glm::uvec3& t : mesh.triangles) corners.insert(corners.end(), {t.x, t.y, t.z});
    file.node({{"mesh", file.mesh({{"attributes", {{"POSITION", file.accessor(positions, "VEC3")}}},
                                   {"indices", file.accessor(corners, "SCALAR")},
                                   {"material", file.add("materials", material)}})}});
  };
  const auto tinted = [](const glm::vec3& sigma, const nlohmann::json& extras) {
    const glm::vec3 afterOneMetre = glm::exp(-sigma);
    nlohmann::json material = {{"pbrMetallicRoughness", {{"roughnessFactor", 0}}}};
    material["pbrMetallicRoughness"]["metallicFactor"] = 0;
    material["extensions"] = {
        {"KHR_materials_ior", {{"ior", 1}}},
        {"KHR_materials_transmission", {{"transmissionFactor", 1}}},
        {"KHR_materials_volume",
         {{"thicknessFactor", 1},
          {"attenuationDistance", 1},
          {"attenuationColor", {afterOneMetre.x, afterOneMetre.y, afterOneMetre.z}}}}};
    if (!extras.is_null()) material["extras"] = extras;
    return material;
  };
  add(box(-1.0, -3.0), tinted(kRed, redExtras));
  add(box(-2.0, -3.5), tinted(kBlue, blueExtras));
  add(builtin::quad("white", {-20, -20, -8}, {40, 0, 0}, {0, 40, 0}),
      {{"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 1}}}},
       {"emissiveFactor", {1, 1, 1}}});
  const nlohmann::json film = {{"xmag", 0.1}, {"ymag", 0.1}, {"zfar", 10}, {"znear", 0}};
  file.add("cameras", {{"type", "orthographic"}, {"orthographic", film}});
  file.node({{"camera", 0}});
  return file.load();
}

TEST(Media, APriorityOfAFileDecides) {
  const glm::dvec3 redFills = through(kRed, 2.0) * through(kBlue, 0.5),
                   blueFills = through(kRed, 1.0) * through(kBlue, 1.5);
  const auto priority = [](int number) { return nlohmann::json{{"priority", number}}; };
  expectImage(sceneOfFile({}, {}), blueFills, "the smaller one");
  expectImage(sceneOfFile(priority(1), priority(0)), redFills, "1 and 0");
  expectImage(sceneOfFile({}, priority(-1)), redFills, "none and -1");
  expectImage(sceneOfFile(priority(0), priority(1)), blueFills, "0 and 1");
}

// Copies of one mesh with one material are one medium, whose length counts once.
TEST(Media, CopiesOfABodyAreOneMedium) {
  SceneBuilder builder("copies");
  const uint32_t mesh = builder.addGeometry(box(-1.0, -2.0)),
                 red = builder.addMaterial("red", body(kRed, 1.5f));
  builder.place("first", mesh, red, glm::dmat4(1.0));
  glm::dmat4 shifted(1.0);
  shifted[3].z = -0.25;
  builder.place("second", mesh, red, shifted);
  addWhiteWall(builder);
  const double through2 = std::pow(1.0 - std::pow(0.5 / 2.5, 2.0), 2.0);
  expectImage(finish(builder), through2 * through(kRed, 1.25), "overlap", 4000, 0.01, 3);
}

TEST(Media, ThinSheetsLeaveTheMediumAlone) {
  SceneBuilder builder("sheet");
  builder.add(box(-1.0, -2.0), builder.addMaterial("red", body(kRed)));
  rl::Material sheet = body(kBlue);
  sheet.flags |= rl::RL_MATERIAL_THIN;
  builder.add(box(-1.25, -1.5), builder.addMaterial("sheet", sheet));
  addWhiteWall(builder);
  expectImage(finish(builder), through(kRed, 1.0), "thin sheets in a body");
}

// Perpendicular view, without light that is reflected back and forth.
TEST(Media, TouchingBodiesRefractByTheRatio) {
  for (const bool isSwapped : {false, true}) {
    SceneBuilder builder("touching");
    const double order[2] = {isSwapped ? -2.0 : -1.0, isSwapped ? -1.0 : -2.0};
    builder.add(box(order[0], order[0] - 1.0), builder.addMaterial("glass", body(kRed, 1.6f)));
    builder.add(box(order[1], order[1] - 1.0), builder.addMaterial("water", body(kBlue, 1.33f)));
    addWhiteWall(builder);
    const auto passes = [](double a, double b) { return 1.0 - std::pow((a - b) / (a + b), 2.0); };
    const double surfaces = passes(1.0, 1.6) * passes(1.6, 1.33) * passes(1.33, 1.0);
    expectImage(finish(builder), surfaces * through(kRed, 1.0) * through(kBlue, 1.0),
                isSwapped ? "water before glass" : "glass before water", 4000, 0.01, 3);
  }
}

// A surface between equal media still counts, by its colour and by its emission.
TEST(Media, SurfacesWithoutContrastKeepTheirColourAndLight) {
  for (const bool isInside : {false, true}) {
    SceneBuilder builder("tinted");
    rl::Material tinted = body(isInside ? kRed : glm::vec3(0.0f), isInside ? 1.5f : 1.0f);
    tinted.baseColor = {0.5f, 1.0f, 1.0f};
    tinted.emission = {0.0f, 0.25f, 0.0f};
    if (isInside) builder.add(box(1.0, -10.0, 21.0), builder.addMaterial("red", body(kRed, 1.5f)));
    builder.add(box(-1.0, -2.0), builder.addMaterial("tinted", tinted));
    addWhiteWall(builder);
    const auto dimmed = [&](double metres) {
      return isInside ? through(kRed, metres) : glm::dvec3(1.0);
    };
    const glm::dvec3 tint(0.5, 1.0, 1.0), glow(0.0, 0.25, 0.0);
    expectImage(finish(builder),
                dimmed(1) * glow + dimmed(2) * tint * glow + dimmed(8) * tint * tint,
                isInside ? "in a body of its medium" : "in air");
  }
}

// A lamp and a wall in one body, and a box of the same medium between them: shadow rays stop at the
// box, so paths must get the full credit for that light.
TEST(Media, ABoxOfTheSameMediumTakesNoLight) {
  const auto means = [](bool hasBox) {
    SceneBuilder builder("same medium");
    builder.add(box(2.0, -4.0, 30.0), builder.addMaterial("red", body(kRed, 1.5f)));
    if (hasBox) builder.add(box(-1.0, -2.0, 25.0), builder.addMaterial("same", body(kRed, 1.5f)));
    builder.add(builtin::quad("wall", {-20, -20, -3}, {40, 0, 0}, {0, 40, 0}),
                builder.addMaterial("wall", builtin::lambert(glm::vec3(0.5f))));
    builder.add(builtin::quad("lamp", {-20, -20, 0.5}, {0, 40, 0}, {40, 0, 0}),
                builder.addMaterial("lamp", builtin::lamp(glm::vec3(1.0f))));
    const auto scene = CompiledScene::build(finish(builder));
    std::vector<double> result;
    for (const Machine& machine : kMachines) {
      SessionConfig config;
      config.integrator = machine.integrator;
      config.rayTracing = machine.rayTracing;
      config.width = config.height = 4;
      config.maxBounces = hasBox ? 5 : 1;  // the same paths, with the box's faces
      Session session(scene, config);
      double sum = 0.0;
      for (int i = 0; i < 1000; ++i) {
        session.frame();
        for (const glm::vec3& pixel : session.radiance().pixels) sum += double(pixel.x);
      }
      result.push_back(sum / 16000.0);
    }
    return result;
  };
  const std::vector<double> without = means(false), with = means(true);
  for (size_t i = 0; i < with.size(); ++i)
    EXPECT_NEAR(with[i], without[i], 0.03 * without[i]) << kMachines[i].integrator << " " << i;
}

// Adds a grey wall at z = -3 under a point lamp at z = 0.5, seen in one direction. kLitWall is the
// radiance of the wall.
Scene finishLitWall(SceneBuilder& builder) {
  builder.add(builtin::quad("wall", {-1, -1, -3}, {2, 0, 0}, {0, 2, 0}),
              builder.addMaterial("wall", builtin::lambert(glm::vec3(0.5f))));
  PunctualLight lamp;
  lamp.posW = {0.0, 0.0, 0.5};
  lamp.intensity = glm::vec3(10.0f);
  builder.addLight(lamp);
  Scene scene = finish(builder);
  scene.cameras[0].xmag = scene.cameras[0].ymag = 1e-4;
  return scene;
}
const double kLitWall = 10.0 / (3.5 * 3.5) * 0.5 / 3.14159265358979;

// A surface without contrast or colour is removed: it costs no event, and light of a point lamp
// reaches the wall behind.
TEST(Media, NothingIsSeenOfAnIndexOfOne) {
  for (const uint32_t flags : {0u, uint32_t(rl::RL_MATERIAL_THIN)}) {
    SceneBuilder builder("clear");
    rl::Material clear = body(glm::vec3(0.0f), 1.0f, 0.5f);
    clear.flags |= flags;
    builder.add(box(-1.0, -2.0), builder.addMaterial("clear", clear));
    expectImage(finishLitWall(builder), glm::dvec3(kLitWall), "behind it", 1, 1e-4, 1);
  }
}

// A lamp and a wall in one body, with a body of lower priority between them that changes nothing:
// shadow rays must pass its faces, which are no surfaces.
TEST(Media, ShadowRaysPassBodiesOfLessPriority) {
  SceneBuilder builder("shadow");
  const uint32_t red = builder.addMaterial("red", body(kRed, 1.5f));
  builder.add(box(2.0, -4.0, 6.0), red);
  builder.add(box(-1.0, -1.5), builder.addMaterial("blue", body(kBlue, 1.2f)));
  Scene scene = finishLitWall(builder);
  scene.materials[red].priority = 1;
  expectImage(scene, kLitWall * through(kRed, 3.5 + 3.0), "lamp and wall in one body", 1, 1e-4, 1);
}

}  // namespace
}  // namespace restlab
