// Numbers, colours, spectra and transforms of Mitsuba's XML, and where its cameras see a point.
#include <gtest/gtest.h>

#include <cmath>

#include "core/scene/mitsuba/spectrum.h"
#include "tests/scene/mesh_checks.h"
#include "tests/scene/mitsuba_builder.h"

namespace restlab {
namespace {

using test::rectangleWith;

class MitsubaValues : public ::testing::Test {
 protected:
  glm::vec3 colorOf(const std::string& element) {
    const Scene scene =
        folder_.load(rectangleWith("<bsdf type=\"diffuse\">" + element + "</bsdf>"));
    return scene.materials.at(scene.instances.at(0).material).data.baseColor;
  }
  glm::dmat4 transformOf(const std::string& steps) {
    const Scene scene =
        folder_.load(rectangleWith("<transform name=\"to_world\">" + steps + "</transform>"));
    return scene.instances.at(0).objectToWorld;
  }
  std::string errorOf(const std::string& steps) {
    return folder_.error(rectangleWith("<transform name=\"to_world\">" + steps + "</transform>"));
  }
  SceneCamera cameraOf(const std::string& inside, const std::string& type = "perspective") {
    return folder_.load("<sensor type=\"" + type + "\">" + inside + "</sensor>" + rectangleWith(""))
        .cameras.at(0);
  }
  test::MitsubaFolder folder_;
};

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-6) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance) << "channel " << c;
}

glm::dvec3 moved(const glm::dmat4& m, const glm::dvec3& p) {
  return glm::dvec3(m * glm::dvec4(p, 1.0));
}

TEST_F(MitsubaValues, Colours) {
  expectNear(colorOf("<rgb name=\"reflectance\" value=\"0.1, 0.2, 0.3\"/>"), {0.1, 0.2, 0.3});
  expectNear(colorOf("<rgb name=\"reflectance\" value=\"0.1 0.2 0.3\"/>"), {0.1, 0.2, 0.3});
  expectNear(colorOf("<rgb name=\"reflectance\" value=\"#ff8000\"/>"), {1.0, 128.0 / 255.0, 0.0});
  expectNear(colorOf("<srgb name=\"reflectance\" value=\"#ff8000\"/>"), {1.0, 0.215861, 0.0}, 1e-5);
  expectNear(colorOf("<spectrum name=\"reflectance\" value=\"0.25\"/>"), glm::dvec3(0.25));
  expectNear(colorOf("<rgb name=\"reflectance\" r=\"0.5\" g=\"0.25\"/>"), {0.5, 0.25, 0.0});
  EXPECT_NE(folder_
                .error(rectangleWith("<bsdf type=\"diffuse\"><rgb name=\"reflectance\" "
                                     "value=\"1 2\"/></bsdf>"))
                .find("x.xml:2:46: '1 2' has 2 numbers; 3 or #rrggbb expected"),
            std::string::npos);
  EXPECT_NE(folder_
                .error(rectangleWith("<bsdf type=\"diffuse\"><rgb name=\"reflectance\" "
                                     "value=\"nan 0 0\"/></bsdf>"))
                .find("'nan 0 0' is not finite numbers"),
            std::string::npos);
  EXPECT_NE(folder_
                .error(rectangleWith("<bsdf type=\"diffuse\"><rgb name=\"reflectance\" "
                                     "value=\"#12345g\"/></bsdf>"))
                .find("#rrggbb expected"),
            std::string::npos);
}

// A reflectance above 1 makes energy.
TEST_F(MitsubaValues, ReflectancesAboveOneAreDrawnAsOneAndSaid) {
  const Scene scene = folder_.load(rectangleWith(
      "<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"2, 0.5, 0.5\"/></bsdf>"));
  EXPECT_EQ(scene.materials.at(0).data.baseColor, glm::vec3(1.0f, 0.5f, 0.5f));
  EXPECT_TRUE(test::warns(scene, "'reflectance' is (2, 0.5, 0.5)"));
}

// Peaks of the CIE's tables: y is 1 at 555 nm, x has 1.0622 at 600 nm, z has 1.7826 at 445 nm.
TEST_F(MitsubaValues, ColourMatchingIsThatOfTheTables) {
  EXPECT_NEAR(mitsuba::colorMatching(555.0).y, 1.0, 0.01);
  EXPECT_NEAR(mitsuba::colorMatching(600.0).x, 1.0622, 0.02);
  EXPECT_NEAR(mitsuba::colorMatching(445.0).z, 1.7826, 0.05);
  EXPECT_NEAR(mitsuba::colorMatching(500.0).y, 0.323, 0.02);
  double x = 0.0, y = 0.0, z = 0.0;
  for (double w = 360.0; w <= 830.0; w += 1.0) {
    const glm::dvec3 c = mitsuba::colorMatching(w);
    x += c.x, y += c.y, z += c.z;
  }
  EXPECT_NEAR(x / y, 1.0, 0.005);
  EXPECT_NEAR(z / y, 1.0, 0.005);
}

TEST_F(MitsubaValues, SpectraAreIntegrated) {
  const mitsuba::Spectrum flat = {{300.0, 0.5}, {900.0, 0.5}};
  expectNear(mitsuba::reflectanceOf(flat), glm::dvec3(0.5));
  const glm::dvec3 light = mitsuba::radianceOf(flat);
  EXPECT_NEAR(0.2126 * light.x + 0.7152 * light.y + 0.0722 * light.z, 0.5, 1e-3);
  EXPECT_GT(light.x, light.z) << "the illuminant E is redder than D65";
  const glm::vec3 red =
      colorOf("<spectrum name=\"reflectance\" value=\"400:0, 600:0, 620:0.8, 700:0.8\"/>");
  EXPECT_GT(red.x, 0.3f);
  EXPECT_LT(red.y, 0.1f);
  EXPECT_NE(folder_
                .error(rectangleWith("<bsdf type=\"diffuse\"><spectrum name=\"reflectance\" "
                                     "value=\"500:1, 400:1\"/></bsdf>"))
                .find("wavelength 400 does not follow 500"),
            std::string::npos);
  folder_.write("a.spd", "# nm value\n400 0.5\n700 0.5\n");
  const glm::vec3 grey = colorOf("<spectrum name=\"reflectance\" filename=\"a.spd\"/>");
  EXPECT_NEAR(grey.y, 0.5f, 0.01f);
}

TEST_F(MitsubaValues, StepsOfATransformFollowEachOther) {
  const glm::dvec3 p =
      moved(transformOf("<translate x=\"1\"/><rotate z=\"1\" angle=\"90\"/><scale value=\"2\"/>"),
            {0, 0, 0});
  expectNear(p, {0.0, 2.0, 0.0});
  expectNear(moved(transformOf("<scale x=\"3\"/>"), {1, 1, 1}), {3.0, 1.0, 1.0});
  expectNear(moved(transformOf("<matrix value=\"1 0 0 4 0 0 -1 5 0 1 0 6 0 0 0 1\"/>"), {1, 2, 3}),
             {5.0, 2.0, 8.0});
  expectNear(moved(transformOf("<matrix value=\"0 -1 0 1 0 0 0 0 1\"/>"), {1, 2, 3}),
             {-2.0, 1.0, 3.0});
  const glm::dmat4 look =
      transformOf("<lookat origin=\"1, 2, 3\" target=\"1, 2, 7\" up=\"0, 1, 0\"/>");
  expectNear(moved(look, {0, 0, 1}), {1.0, 2.0, 4.0});
  expectNear(moved(look, {0, 1, 0}), {1.0, 3.0, 3.0});
  EXPECT_EQ(errorOf("<scale x=\"0\"/>").substr(0, 44),
            "x.xml:2:25: the transform is singular or not");
  EXPECT_NE(
      errorOf("<matrix value=\"1 0 0 0 0 1 0 0 0 0 1 0 0 0 0.1 1\"/>").find("last row is 0 0 0.1"),
      std::string::npos);
  EXPECT_NE(errorOf("<rotate angle=\"3\"/>").find("has no axis"), std::string::npos);
  EXPECT_NE(errorOf("<skew x=\"3\"/>").find("<skew> is no step of a transform"), std::string::npos);
  EXPECT_NE(errorOf("<matrix value=\"1 2 3\"/>").find("a matrix of 3 numbers"), std::string::npos);
  EXPECT_NE(errorOf("<lookat origin=\"0,0,0\" target=\"0,1,0\" up=\"0,1,0\"/>").find("parallel"),
            std::string::npos);
}

// Where a point lies on the film, (0, 0) the upper left corner.
glm::dvec2 filmOf(const SceneCamera& camera, const glm::dvec3& posW) {
  const glm::dvec3 p = moved(glm::inverse(camera.cameraToWorld), posW);
  const double half = std::tan(0.5 * camera.yfov);
  return {0.5 + 0.5 * p.x / (-p.z * half * camera.aspect), 0.5 - 0.5 * p.y / (-p.z * half)};
}

// Mitsuba's sensor without a transform looks along +Z, +Y is up and +X is on the left.
TEST_F(MitsubaValues, SensorsSeeAPointWhereMitsubaDoes) {
  const std::string film =
      "<film type=\"hdrfilm\"><integer name=\"width\" value=\"200\"/><integer name=\"height\" "
      "value=\"100\"/></film>";
  const SceneCamera own = cameraOf("<float name=\"fov\" value=\"90\"/>" + film);
  EXPECT_EQ(own.aspect, 2.0);
  EXPECT_FALSE(own.isMirrored);
  // At depth 2 the film is 4 wide and 2 high.
  const glm::dvec2 left = filmOf(own, {1.0, 0.5, 2.0});
  EXPECT_NEAR(left.x, 0.25, 1e-9);
  EXPECT_NEAR(left.y, 0.25, 1e-9);
  const glm::dvec3 ray = test::cameraDirection(own, 0.25, 0.25, 2.0);
  expectNear(ray / ray.z, {0.5, 0.25, 1.0});
  const SceneCamera turned = cameraOf(
      "<float name=\"fov\" value=\"90\"/><transform name=\"to_world\"><lookat origin=\"0,0,5\" "
      "target=\"0,0,0\" up=\"0,1,0\"/></transform>" +
      film);
  EXPECT_NEAR(filmOf(turned, {2.5, 0.0, 0.0}).x, 0.75, 1e-9) << "+X is on the right here";
  const SceneCamera mirrored = cameraOf(
      "<float name=\"fov\" value=\"90\"/><transform name=\"to_world\"><scale "
      "x=\"-1\"/></transform>" +
      film);
  EXPECT_TRUE(mirrored.isMirrored);
}

TEST_F(MitsubaValues, FieldsOfView) {
  const std::string film =
      "<film type=\"hdrfilm\"><integer name=\"width\" value=\"200\"/><integer name=\"height\" "
      "value=\"100\"/></film>";
  const auto heightOf = [&](const std::string& axis, double fov) {
    return std::tan(0.5 * cameraOf("<float name=\"fov\" value=\"" + std::to_string(fov) +
                                   "\"/><string name=\"fov_axis\" value=\"" + axis + "\"/>" + film)
                              .yfov);
  };
  EXPECT_NEAR(heightOf("x", 90.0), 0.5, 1e-9);
  EXPECT_NEAR(heightOf("y", 90.0), 1.0, 1e-9);
  EXPECT_NEAR(heightOf("smaller", 90.0), 1.0, 1e-9);
  EXPECT_NEAR(heightOf("larger", 90.0), 0.5, 1e-9);
  EXPECT_NEAR(heightOf("diagonal", 90.0), 1.0 / std::sqrt(5.0), 1e-9);
  const double ofFilm =
      std::tan(0.5 * cameraOf("<string name=\"focal_length\" value=\"50mm\"/>" + film).yfov);
  EXPECT_NEAR(ofFilm, std::hypot(36.0, 24.0) / 100.0 / std::sqrt(5.0), 1e-9);
  EXPECT_NE(folder_
                .error("<sensor type=\"perspective\"><string name=\"focal_length\" "
                       "value=\"long\"/></sensor>")
                .find("no length in millimetres"),
            std::string::npos);
  const SceneCamera flat = cameraOf(
      "<transform name=\"to_world\"><scale x=\"3\" y=\"3\"/></transform>" + film, "orthographic");
  EXPECT_EQ(flat.kind, rl::RL_CAMERA_ORTHOGRAPHIC);
  EXPECT_NEAR(flat.xmag, 3.0, 1e-9);
  EXPECT_NEAR(flat.ymag, 1.5, 1e-9);
}

TEST_F(MitsubaValues, BouncesOfIntegrators) {
  const auto bounces = [&](const std::string& integrator) {
    const Scene scene = folder_.load(integrator + rectangleWith(""));
    EXPECT_EQ(suggestedBounces((folder_.path() / "x.xml").string()), scene.maxBounces);
    return scene.maxBounces;
  };
  const std::string depth = "<integer name=\"maxDepth\" value=\"4\"/></integrator>";
  EXPECT_EQ(bounces("<integrator type=\"volpath\">" + depth), 3u);
  EXPECT_EQ(
      bounces("<integrator type=\"aov\"><integrator type=\"path\">" + depth + "</integrator>"), 3u);
  EXPECT_EQ(bounces("<integrator type=\"direct\"/>"), 1u);
  EXPECT_EQ(bounces("<integrator type=\"path\"/>"), std::nullopt);
  EXPECT_EQ(bounces(""), std::nullopt);
  folder_.write("y.scene.toml", "base = \"x.xml\"\n");
  folder_.load("<integrator type=\"path\">" + depth + rectangleWith(""));
  EXPECT_EQ(suggestedBounces((folder_.path() / "y.scene.toml").string()), 3u);
  EXPECT_EQ(suggestedBounces("no-such-scene"), std::nullopt);
  try {
    folder_.load("<integrator type=\"direct\"/>\n<integrator type=\"path\"/>" + rectangleWith(""));
    FAIL() << "two integrators were read";
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find(": a second <integrator>, the first is at "), std::string::npos) << text;
  }
}

// The middle of a window of 100 x 50 pixels at (300, 0) of a film of 400 x 200 pixels is 150 pixels
// to the right of the film's and 75 above it, and the principal point moves it by 40 and 20.
TEST_F(MitsubaValues, WindowsOfTheFilm) {
  const auto camera = [&](const std::string& type, const std::string& more) {
    return folder_
        .load("<sensor type=\"" + type + "\"><float name=\"fov\" value=\"90\"/>" + more +
              "<film type=\"hdrfilm\"><integer name=\"width\" value=\"400\"/><integer "
              "name=\"height\" value=\"200\"/><integer name=\"crop_offset_x\" value=\"300\"/>"
              "<integer name=\"crop_width\" value=\"100\"/><integer name=\"crop_height\" "
              "value=\"50\"/></film></sensor>" +
              rectangleWith(""))
        .cameras.at(0);
  };
  const SceneCamera plain = camera("perspective", "");
  EXPECT_EQ(plain.film, glm::uvec2(100, 50));
  EXPECT_NEAR(std::tan(0.5 * plain.yfov), 50.0 / 400.0, 1e-9);
  EXPECT_NEAR(plain.aspect, 2.0, 1e-9);
  EXPECT_NEAR(plain.shift.x, 150.0 / 200.0, 1e-9);
  EXPECT_NEAR(plain.shift.y, 75.0 / 200.0, 1e-9);
  const SceneCamera moved = camera("perspective",
                                   "<float name=\"principal_point_offset_x\" value=\"0.1\"/><float "
                                   "name=\"principal_point_offset_y\" value=\"-0.1\"/>");
  EXPECT_NEAR(moved.shift.x, 190.0 / 200.0, 1e-9);
  EXPECT_NEAR(moved.shift.y, 95.0 / 200.0, 1e-9);
  const SceneCamera flat = camera("orthographic", "");
  EXPECT_NEAR(flat.xmag, 0.25, 1e-9);
  EXPECT_NEAR(flat.shift.x, 0.75, 1e-9);
}

TEST_F(MitsubaValues, WhatASensorHasBesideIsSaid) {
  const Scene scene = folder_.load(
      "<integrator type=\"path\"><integer name=\"max_depth\" value=\"6\"/><boolean "
      "name=\"hide_emitters\" value=\"true\"/></integrator>"
      "<sensor type=\"thinlens\"><float name=\"fov\" value=\"45\"/><float "
      "name=\"aperture_radius\" value=\"0.1\"/><float name=\"focus_distance\" value=\"3\"/>"
      "<sampler type=\"independent\"/></sensor>" +
      rectangleWith(""));
  EXPECT_TRUE(test::notes(scene, "its paths have 5 bounces"));
  EXPECT_TRUE(test::notes(scene, "the 768x576 pixels of the film"));
  EXPECT_EQ(scene.maxBounces, 5u);
  EXPECT_EQ(scene.cameras.at(0).film, glm::uvec2(768, 576));
  ASSERT_EQ(scene.warnings.size(), 2u);
  EXPECT_TRUE(test::warns(scene, "drawn as a pinhole"));
  EXPECT_TRUE(test::warns(scene, "the camera sees lamps"));
}

}  // namespace
}  // namespace restlab
