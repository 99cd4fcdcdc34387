// BSDFs, textures and emitters of Mitsuba as materials and lights of the scene.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/dialect/features.h"
#include "core/frame/session.h"
#include "core/image/image.h"
#include "core/scene/compiled/compiled_scene.h"
#include "core/scene/scene_file/scene_file.h"
#include "core/scene/textures/image_formats.h"
#include "tests/scene/mitsuba_builder.h"

namespace restlab {
namespace {

using test::rectangleWith;

class MitsubaBsdf : public ::testing::Test {
 protected:
  Scene sceneOf(const std::string& bsdf, const std::string& version = "3.0.0") {
    return folder_.load(rectangleWith(bsdf), "", version);
  }
  std::string errorOf(const std::string& bsdf) { return folder_.error(rectangleWith(bsdf)); }
  test::MitsubaFolder folder_;
};

const SceneMaterial& firstMaterial(const Scene& scene) {
  return scene.materials.at(scene.instances.at(0).material);
}

// A number of a closure by its name.
float valueOf(const SceneMaterial& material, const std::string& name) {
  for (const ClosureInfo& info : closureRegistry()) {
    if (info.kind != material.data.closure) continue;
    for (size_t i = 0; i < info.parameters.size(); ++i)
      if (info.parameters[i].name == name)
        return std::bit_cast<float>(material.closure.at(i).words.x);
  }
  throw std::runtime_error("no parameter " + name);
}
uint32_t choiceOf(const SceneMaterial& material, const std::string& name) {
  return std::bit_cast<uint32_t>(valueOf(material, name));
}

TEST_F(MitsubaBsdf, DiffuseIsTheDefaultAndHasNoSpecularLobe) {
  for (const std::string& bsdf : {std::string(), std::string("<bsdf type=\"diffuse\"/>")}) {
    const Scene scene = sceneOf(bsdf);
    const SceneMaterial& m = firstMaterial(scene);
    EXPECT_EQ(m.data.baseColor, glm::vec3(0.5f));
    EXPECT_EQ(m.data.specular, 0.0f);
    EXPECT_EQ(m.data.metallic, 0.0f);
    EXPECT_TRUE(test::notes(scene, "without 'twosided'"));
  }
  EXPECT_FALSE(test::notes(sceneOf("<bsdf type=\"twosided\"><bsdf type=\"diffuse\"/></bsdf>"),
                           "without 'twosided'"));
}

TEST_F(MitsubaBsdf, Conductors) {
  const Scene gold = sceneOf(
      "<bsdf type=\"roughconductor\"><string name=\"material\" value=\"Au\"/><float "
      "name=\"alpha\" value=\"0.3\"/></bsdf>");
  const SceneMaterial& m = firstMaterial(gold);
  EXPECT_EQ(m.data.closure, rl::RL_CLOSURE_CONDUCTOR);
  EXPECT_EQ(choiceOf(m, "metal"), 3u);
  EXPECT_EQ(valueOf(m, "alpha"), 0.3f);
  EXPECT_EQ(choiceOf(m, "distribution"), 1u) << "beckmann is Mitsuba's default";
  EXPECT_EQ(choiceOf(m, "masking"), 1u) << "Smith's, without heights";
  const Scene given = sceneOf(
      "<bsdf type=\"conductor\"><rgb name=\"eta\" value=\"0.2 0.9 1.1\"/><rgb name=\"k\" "
      "value=\"3.9 2.4 2.2\"/><float name=\"ext_eta\" value=\"2\"/></bsdf>");
  EXPECT_EQ(valueOf(firstMaterial(given), "eta"), 0.1f);
  EXPECT_EQ(valueOf(firstMaterial(given), "k"), 1.95f);
  EXPECT_EQ(valueOf(firstMaterial(given), "alpha"), 0.0f);
  // A flat spectrum is the same index at every wavelength.
  const Scene flat = sceneOf(
      "<bsdf type=\"conductor\"><spectrum name=\"eta\" value=\"300:2, 900:2\"/><rgb name=\"k\" "
      "value=\"3\"/></bsdf>");
  EXPECT_NEAR(valueOf(firstMaterial(flat), "eta"), 2.0f, 1e-5f);
  EXPECT_EQ(firstMaterial(sceneOf("<bsdf type=\"conductor\"/>")).data.closure,
            rl::RL_CLOSURE_MIRROR);
  EXPECT_EQ(choiceOf(firstMaterial(sceneOf("<bsdf type=\"conductor\"/>", "0.6.0")), "metal"), 2u)
      << "copper is the default of 0.6";
  EXPECT_NE(errorOf("<bsdf type=\"conductor\"><string name=\"material\" value=\"Xy\"/></bsdf>")
                .find("material 'Xy' is unknown; none, Al, Cu, Au, Ag, Cr or eta and k expected"),
            std::string::npos);
  EXPECT_NE(errorOf("<bsdf type=\"roughconductor\"><float name=\"alpha\" value=\"-1\"/></bsdf>")
                .find("'alpha' is -1; 0 to 1 expected"),
            std::string::npos);
}

// The closure stretches alpha along the tangent: alpha_u = alpha / sqrt(1 - 0.9 a).
TEST_F(MitsubaBsdf, AnisotropicConductors) {
  const Scene scene = sceneOf(
      "<bsdf type=\"roughconductor\"><string name=\"material\" value=\"Al\"/><float "
      "name=\"alpha_u\" value=\"0.4\"/><float name=\"alpha_v\" value=\"0.2\"/></bsdf>");
  const SceneMaterial& m = firstMaterial(scene);
  const float aspect = std::sqrt(1.0f - 0.9f * valueOf(m, "anisotropic"));
  EXPECT_NEAR(valueOf(m, "alpha") / aspect, 0.4f, 1e-5f);
  EXPECT_NEAR(valueOf(m, "alpha") * aspect, 0.2f, 1e-5f);
  EXPECT_NE(m.data.flags & rl::RL_MATERIAL_ANISOTROPIC, 0u);
  EXPECT_FALSE(scene.geometries.at(0).tangents.empty());
  EXPECT_TRUE(scene.warnings.empty());
  EXPECT_TRUE(test::warns(
      sceneOf("<bsdf type=\"roughconductor\"><string name=\"material\" value=\"Al\"/><float "
              "name=\"alpha_u\" value=\"0.2\"/><float name=\"alpha_v\" value=\"0.4\"/></bsdf>"),
      "alpha_v is 0.1 to 1 times alpha_u"));
}

TEST_F(MitsubaBsdf, Dielectrics) {
  const SceneMaterial glass = firstMaterial(sceneOf("<bsdf type=\"dielectric\"/>"));
  EXPECT_NEAR(glass.data.ior, 1.5046 / 1.000277, 1e-6);
  EXPECT_EQ(glass.data.transmission, 1.0f);
  EXPECT_EQ(glass.data.roughness, 0.0f);
  const SceneMaterial rough = firstMaterial(
      sceneOf("<bsdf type=\"roughdielectric\"><float name=\"alpha\" value=\"0.25\"/><string "
              "name=\"int_ior\" value=\"water\"/><float name=\"ext_ior\" value=\"1\"/></bsdf>"));
  EXPECT_EQ(rough.data.roughness, 0.5f) << "alpha is the square of glTF's roughness";
  EXPECT_EQ(rough.data.ior, 1.333f);
  const SceneMaterial sheet = firstMaterial(
      sceneOf("<bsdf type=\"thindielectric\"><float name=\"int_ior\" value=\"1.5\"/><float "
              "name=\"ext_ior\" value=\"1\"/></bsdf>"));
  EXPECT_NE(sheet.data.flags & rl::RL_MATERIAL_THIN, 0u);
  const double f0 = std::pow((sheet.data.ior - 1.0) / (sheet.data.ior + 1.0), 2.0);
  EXPECT_NEAR(f0, 2.0 * 0.04 / 1.04, 1e-6) << "both faces, with all reflections between them";
  EXPECT_NE(errorOf("<bsdf type=\"dielectric\"><string name=\"int_ior\" value=\"waxer\"/></bsdf>")
                .find("did you mean 'water'?"),
            std::string::npos);
  EXPECT_NE(errorOf("<bsdf type=\"dielectric\"><float name=\"int_ior\" value=\"1\"/><float "
                    "name=\"ext_ior\" value=\"1.5\"/></bsdf>")
                .find("1 to 4 expected"),
            std::string::npos);
}

TEST_F(MitsubaBsdf, Plastics) {
  const Scene scene = sceneOf(
      "<bsdf type=\"roughplastic\"><rgb name=\"diffuse_reflectance\" value=\"0.2 0.4 0.6\"/><float "
      "name=\"alpha\" value=\"0.04\"/><string name=\"distribution\" value=\"ggx\"/></bsdf>");
  const SceneMaterial& m = firstMaterial(scene);
  EXPECT_EQ(m.data.baseColor, glm::vec3(0.2f, 0.4f, 0.6f));
  EXPECT_NEAR(m.data.roughness, 0.2f, 1e-6f);
  EXPECT_EQ(m.data.specular, 1.0f);
  EXPECT_TRUE(scene.warnings.empty());
  // Multiple reflections below the layer: 0.5 (1 - Fi) / (1 - 0.5 Fi), Fi = 0.596 at index 1.5.
  const Scene nonlinear = sceneOf(
      "<bsdf type=\"plastic\"><boolean name=\"nonlinear\" value=\"true\"/><float "
      "name=\"int_ior\" value=\"1.5\"/><float name=\"ext_ior\" value=\"1\"/></bsdf>");
  EXPECT_NEAR(firstMaterial(nonlinear).data.baseColor.x, 0.5 * 0.404 / (1.0 - 0.298), 2e-3);
}

TEST_F(MitsubaBsdf, PhongOrenNayarAndPrincipled) {
  const SceneMaterial phong = firstMaterial(
      sceneOf("<bsdf type=\"phong\"><float name=\"exponent\" value=\"50\"/></bsdf>", "0.6.0"));
  EXPECT_EQ(phong.data.closure, rl::RL_CLOSURE_PHONG);
  EXPECT_EQ(valueOf(phong, "power"), 50.0f);
  EXPECT_EQ(valueOf(phong, "diffuse"), 0.5f);
  EXPECT_EQ(valueOf(phong, "specular"), 0.2f);
  EXPECT_EQ(choiceOf(phong, "model"), 1u);
  const SceneMaterial rough = firstMaterial(
      sceneOf("<bsdf type=\"roughdiffuse\"><float name=\"alpha\" value=\"0.5\"/></bsdf>"));
  EXPECT_NEAR(valueOf(rough, "sigma"), 0.5 / std::sqrt(2.0), 1e-6);
  const SceneMaterial paint = firstMaterial(
      sceneOf("<bsdf type=\"principled\"><float name=\"eta\" value=\"1.5\"/><float name=\"sheen\" "
              "value=\"0.5\"/></bsdf>"));
  EXPECT_EQ(paint.data.closure, rl::RL_CLOSURE_DISNEY);
  EXPECT_NEAR(valueOf(paint, "specular"), 0.5f, 1e-5f);
  EXPECT_EQ(valueOf(paint, "sheenTint"), 0.0f) << "Mitsuba's default";
  EXPECT_EQ(valueOf(paint, "clearcoatGloss"), 0.0f);
  const SceneMaterial clear = firstMaterial(
      sceneOf("<bsdf type=\"principled\"><float name=\"spec_trans\" value=\"1\"/></bsdf>"));
  EXPECT_EQ(clear.data.transmission, 1.0f);
  EXPECT_NEAR(clear.data.ior, 1.5f, 1e-4f);
}

TEST_F(MitsubaBsdf, BlendsAndMixtures) {
  const std::string two =
      "<bsdf type=\"diffuse\"/><bsdf type=\"conductor\"><string name=\"material\" "
      "value=\"Ag\"/></bsdf>";
  const Scene scene =
      sceneOf("<bsdf type=\"blendbsdf\"><float name=\"weight\" value=\"0.25\"/>" + two + "</bsdf>");
  const SceneMaterial& m = firstMaterial(scene);
  EXPECT_EQ(m.data.closure, rl::RL_CLOSURE_MIXTURE);
  EXPECT_EQ(valueOf(m, "second_share"), 0.25f);
  EXPECT_EQ(scene.materials.at(m.closure.at(0).words.x).data.closure, rl::RL_CLOSURE_GLTF);
  EXPECT_EQ(scene.materials.at(m.closure.at(1).words.x).data.closure, rl::RL_CLOSURE_CONDUCTOR);
  const SceneMaterial sum = firstMaterial(sceneOf(
      "<bsdf type=\"mixturebsdf\"><string name=\"weights\" value=\"0.3, 0.5\"/>" + two + "</bsdf>",
      "0.6.0"));
  EXPECT_EQ(valueOf(sum, "second_share"), 0.5f);
  EXPECT_NEAR(valueOf(sum, "first_share"), 0.6f, 1e-6f) << "0.3 of the 0.5 that is left";
  EXPECT_NE(errorOf("<bsdf type=\"blendbsdf\"><bsdf type=\"diffuse\"/><bsdf "
                    "type=\"dielectric\"/></bsdf>")
                .find("takes BSDFs that reflect alone"),
            std::string::npos);
  EXPECT_NE(
      errorOf("<bsdf type=\"blendbsdf\"><bsdf type=\"diffuse\"/></bsdf>").find("holds 1 BSDFs"),
      std::string::npos);
}

TEST_F(MitsubaBsdf, MasksAndNothing) {
  const Scene scene = sceneOf(
      "<bsdf type=\"mask\"><float name=\"opacity\" value=\"0.25\"/><bsdf "
      "type=\"diffuse\"/></bsdf>");
  EXPECT_EQ(firstMaterial(scene).data.alpha, 0.25f);
  EXPECT_NE(firstMaterial(scene).data.flags & rl::RL_MATERIAL_ALPHA_BLEND, 0u);
  EXPECT_TRUE(sceneOf("<bsdf type=\"null\"/>").instances.empty());
  const Scene leaf =
      sceneOf("<bsdf type=\"difftrans\"><rgb name=\"transmittance\" value=\"0.1 0.6 0.2\"/></bsdf>",
              "0.6.0");
  EXPECT_NE(firstMaterial(leaf).data.flags & rl::RL_MATERIAL_DIFFUSE_TRANSMISSION, 0u);
  const Scene bumps = sceneOf(
      "<bsdf type=\"bumpmap\"><texture type=\"checkerboard\"/><bsdf type=\"diffuse\"/></bsdf>");
  EXPECT_TRUE(test::notes(bumps, "heights are drawn as a map of normals"));
  const rl::Material& bumped = bumps.materials.at(bumps.instances.at(0).material).data;
  EXPECT_NE(bumped.textures[rl::RL_TEX_NORMAL], rl::RL_INVALID);
}

// The colour of a use at texture coordinates, as kernels find the texel.
uint32_t texelAt(const Scene& scene, uint32_t use, double u, double v) {
  const TextureUse& t = scene.textureUses.at(use);
  const TextureImage& image = scene.images.at(t.image);
  const glm::vec3 h(u, v, 1.0);
  const double x = glm::dot(t.uvRow0, h), y = glm::dot(t.uvRow1, h);
  const auto index = [](double unit, uint32_t size) {
    return std::min(uint32_t((unit - std::floor(unit)) * size), size - 1);
  };
  return image.texels.at(index(y, image.height) * image.width + index(x, image.width)) & 0xffffffu;
}

TEST_F(MitsubaBsdf, CheckerboardsAreMitsubas) {
  const Scene scene = sceneOf(
      "<bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"checkerboard\"><rgb "
      "name=\"color0\" value=\"1 0 0\"/><rgb name=\"color1\" value=\"0 0 1\"/><transform "
      "name=\"to_uv\"><scale x=\"2\" y=\"4\"/><translate x=\"0.5\"/></transform></texture></bsdf>");
  const uint32_t use = firstMaterial(scene).data.textures[rl::RL_TEX_BASE_COLOR];
  ASSERT_NE(use, rl::RL_INVALID);
  for (double u = 0.03; u < 1.0; u += 0.06) {
    for (double v = 0.03; v < 1.0; v += 0.06) {
      const double x = 2.0 * u + 0.5, y = 4.0 * v;
      const bool isFirst = (x - std::floor(x) > 0.5) == (y - std::floor(y) > 0.5);
      EXPECT_EQ(texelAt(scene, use, u, v), isFirst ? 0x0000ffu : 0xff0000u) << u << " " << v;
    }
  }
}

// Row 0 of an image is at v = 0 of Mitsuba: at the top of an OBJ whose v points up, and at the
// bottom of a rectangle.
TEST_F(MitsubaBsdf, BitmapsAreTheRightWayUp) {
  Image image(2, 2);
  image.at(0, 0) = {1, 0, 0};
  image.at(1, 0) = {0, 1, 0};
  image.at(0, 1) = {0, 0, 1};
  image.at(1, 1) = {1, 1, 1};
  writePng(folder_.path() / "four.png", image);
  folder_.write("s.obj",
                "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                "f 1/1 2/2 3/3 4/4\n");
  const std::string bsdf =
      "<bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"bitmap\"><string "
      "name=\"filename\" value=\"four.png\"/><string name=\"filter_type\" value=\"nearest\"/>"
      "<string name=\"wrap_mode\" value=\"clamp\"/></texture></bsdf>";
  const auto colorNear = [](const Scene& scene, double x, double y) {
    const MeshGeometry& mesh = scene.geometries.at(0);
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
      if (glm::length(glm::dvec2(mesh.positions[i]) - glm::dvec2(x, y)) > 1e-6) continue;
      const glm::dvec2 inside = glm::clamp(glm::dvec2(mesh.uvs[0][i]), 0.1, 0.9);
      return texelAt(scene, firstMaterial(scene).data.textures[rl::RL_TEX_BASE_COLOR], inside.x,
                     inside.y);
    }
    return 0u;
  };
  const Scene obj = folder_.load("<shape type=\"obj\"><string name=\"filename\" value=\"s.obj\"/>" +
                                 bsdf + "</shape>");
  EXPECT_EQ(colorNear(obj, 0, 1), 0x0000ffu) << "red is the upper left texel";
  EXPECT_EQ(colorNear(obj, 1, 1), 0x00ff00u);
  EXPECT_EQ(colorNear(obj, 0, 0), 0xff0000u);
  const Scene square = folder_.load(rectangleWith(bsdf));
  EXPECT_EQ(colorNear(square, -1, -1), 0x0000ffu);
  EXPECT_EQ(colorNear(square, 1, 1), 0xffffffu);
  const TextureUse& use = square.textureUses.at(0);
  EXPECT_TRUE(use.srgb);
  EXPECT_TRUE(use.nearest);
  EXPECT_EQ(use.wrapU, rl::RL_WRAP_CLAMP);
  EXPECT_NE(obj.contentHash, square.contentHash);
}

// Four colours on a lamp that fills the film: sensor, texture and kernels together.
TEST_F(MitsubaBsdf, ALampWithABitmapIsSeenTheRightWayUp) {
  Image image(2, 2);
  image.at(0, 0) = {1, 0, 0};
  image.at(1, 0) = {0, 1, 0};
  image.at(0, 1) = {0, 0, 1};
  image.at(1, 1) = {1, 1, 1};
  writePng(folder_.path() / "four.png", image);
  const Scene scene = folder_.load(
      "<sensor type=\"perspective\"><float name=\"fov\" value=\"90\"/><transform "
      "name=\"to_world\"><lookat origin=\"0,0,1\" target=\"0,0,0\" up=\"0,1,0\"/></transform>"
      "<film type=\"hdrfilm\"><integer name=\"width\" value=\"64\"/><integer name=\"height\" "
      "value=\"64\"/></film></sensor>" +
      rectangleWith("<emitter type=\"area\"><texture name=\"radiance\" type=\"bitmap\"><string "
                    "name=\"filename\" value=\"four.png\"/><string name=\"filter_type\" "
                    "value=\"nearest\"/></texture></emitter>"));
  SessionConfig config;
  config.integrator = "path";
  config.width = config.height = 2;
  Session session(CompiledScene::build(scene), config);
  session.frame();
  const Image seen = session.radiance();
  // Row 0 of the bitmap is at the bottom of a rectangle.
  const glm::vec3 expected[] = {{0, 0, 1}, {1, 1, 1}, {1, 0, 0}, {0, 1, 0}};
  for (size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(glm::length(seen.pixels.at(i) - expected[i]), 0.0f, 1e-5f) << "pixel " << i;
}

TEST_F(MitsubaBsdf, ImagesOfFloatsAreRoundedAndSaid) {
  writeExr(folder_.path() / "a.exr", {{{"", Image(2, 2, glm::vec3(0.25f))}}, {}, {}, {}});
  const Scene scene = sceneOf(
      "<bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"bitmap\"><string "
      "name=\"filename\" value=\"a.exr\"/></texture></bsdf>");
  EXPECT_NEAR(firstMaterial(scene).data.baseColor.x, 0.25f, 1e-6f);
  EXPECT_TRUE(test::warns(scene, "rounded to sRGB of 8 bits"));
  folder_.write("b.png", "no image");
  EXPECT_NE(errorOf("<bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"bitmap\"><string "
                    "name=\"filename\" value=\"b.png\"/></texture></bsdf>")
                .find("a complete PNG, JPEG, EXR or HDR expected"),
            std::string::npos);
}

TEST_F(MitsubaBsdf, MasksOfTexturesAreCoverage) {
  const Scene scene = sceneOf(
      "<bsdf type=\"mask\"><texture name=\"opacity\" type=\"checkerboard\"><rgb name=\"color0\" "
      "value=\"1\"/><rgb name=\"color1\" value=\"0\"/></texture><bsdf type=\"diffuse\"/></bsdf>");
  const SceneMaterial& m = firstMaterial(scene);
  const TextureUse& use = scene.textureUses.at(m.data.textures[rl::RL_TEX_BASE_COLOR]);
  EXPECT_EQ(scene.images.at(use.image).texels,
            (std::vector<uint32_t>{0xffffffffu, 0x00ffffffu, 0x00ffffffu, 0xffffffffu}));
  EXPECT_EQ(m.data.baseColor, glm::vec3(0.5f));
}

TEST_F(MitsubaBsdf, LampsShineOnTheirFront) {
  const Scene scene = folder_.load(
      rectangleWith("<emitter type=\"area\"><rgb name=\"radiance\" value=\"3 2 1\"/></emitter>"));
  const SceneMaterial& m = firstMaterial(scene);
  EXPECT_EQ(m.data.emission, glm::vec3(3, 2, 1));
  EXPECT_EQ(m.data.flags & rl::RL_MATERIAL_DOUBLE_SIDED, 0u);
  const auto compiled = CompiledScene::build(scene);
  EXPECT_EQ(compiled->emissiveTriangleCount(), 2u);
}

TEST_F(MitsubaBsdf, LightsWithoutArea) {
  const Scene scene = folder_.load(
      "<emitter type=\"point\"><point name=\"position\" x=\"1\" y=\"2\" z=\"3\"/><rgb "
      "name=\"intensity\" value=\"4\"/></emitter>"
      "<emitter type=\"spot\"><transform name=\"to_world\"><lookat origin=\"0,5,0\" "
      "target=\"0,0,0\" up=\"1,0,0\"/></transform><float name=\"cutoff_angle\" value=\"40\"/>"
      "</emitter>"
      "<emitter type=\"directional\"><vector name=\"direction\" x=\"0\" y=\"-2\" z=\"0\"/><rgb "
      "name=\"irradiance\" value=\"2\"/></emitter>" +
      rectangleWith(""));
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.lights[0].posW, glm::dvec3(1, 2, 3));
  EXPECT_EQ(scene.lights[0].intensity, glm::vec3(4.0f));
  EXPECT_NEAR(scene.lights[1].dirW.y, -1.0, 1e-9);
  EXPECT_EQ(scene.lights[1].posW, glm::dvec3(0, 5, 0));
  EXPECT_NEAR(glm::degrees(scene.lights[1].outerConeAngle), 40.0f, 1e-4f);
  EXPECT_NEAR(glm::degrees(scene.lights[1].innerConeAngle), 30.0f, 1e-4f);
  EXPECT_EQ(scene.lights[2].dirW, glm::dvec3(0, -1, 0));
  EXPECT_EQ(scene.lights[2].kind, rl::RL_LIGHT_DIRECTIONAL);
}

// Radiance of the scene's map towards a direction, by the nearest texel (light/environment.glsl).
glm::vec3 radianceTowards(const EnvironmentMap& map, const glm::dvec3& dirW) {
  const double c = std::cos(-map.rotation), s = std::sin(-map.rotation);
  const glm::dvec3 d(c * dirW.x + s * dirW.z, dirW.y, c * dirW.z - s * dirW.x);
  double u = std::atan2(d.x, -d.z) / (2.0 * 3.14159265358979) + 0.5;
  u -= std::floor(u);
  const double v = std::acos(d.y) / 3.14159265358979;
  const uint32_t x = std::min(uint32_t(u * map.width), map.width - 1),
                 y = std::min(uint32_t(v * map.height), map.height - 1);
  return map.radiance.at(size_t(y) * map.width + x);
}

// Mitsuba's map: u = 0 towards -Z, u = 1/4 towards +X.
TEST_F(MitsubaBsdf, EnvironmentsAreTurnedLikeMitsubas) {
  Image sky(8, 4);
  for (uint32_t y = 0; y < 4; ++y)
    for (uint32_t x = 0; x < 8; ++x) sky.at(x, y) = glm::vec3(float(x), float(y), 1.0f);
  writeExr(folder_.path() / "sky.exr", {{{"", sky}}, {}, {}, {}});
  const auto mapOf = [&](const std::string& more) {
    const Scene scene = folder_.load(
        "<emitter type=\"envmap\"><string name=\"filename\" value=\"sky.exr\"/><float "
        "name=\"scale\" value=\"2\"/>" +
        more + "</emitter>" + rectangleWith(""));
    return *scene.environment;
  };
  const EnvironmentMap plain = mapOf("");
  EXPECT_EQ(plain.scale, 2.0f);
  const glm::dvec3 aside = glm::normalize(glm::dvec3(1.0, 0.2, -0.1));  // u just below 1/4
  EXPECT_EQ(radianceTowards(plain, aside), glm::vec3(1, 1, 1));
  EXPECT_EQ(radianceTowards(plain, glm::normalize(glm::dvec3(0.1, -0.2, -1.0))),
            glm::vec3(0, 2, 1));
  EXPECT_EQ(radianceTowards(plain, glm::normalize(glm::dvec3(-0.1, -0.2, -1.0))),
            glm::vec3(7, 2, 1));
  // A quarter turn about +Y brings what was towards -Z to -X.
  const EnvironmentMap turned =
      mapOf("<transform name=\"to_world\"><rotate y=\"1\" angle=\"90\"/></transform>");
  EXPECT_EQ(radianceTowards(turned, glm::normalize(glm::dvec3(-1.0, -0.2, -0.1))),
            glm::vec3(0, 2, 1));
  // Other axes: half a turn about X brings +Y down and -Z to +Z.
  const EnvironmentMap over =
      mapOf("<transform name=\"to_world\"><rotate x=\"1\" angle=\"180\"/></transform>");
  const glm::vec3 found = radianceTowards(over, glm::normalize(glm::dvec3(0.3, 0.25, 1.0)));
  EXPECT_NEAR(found.x, 0.0f, 0.01f);
  EXPECT_NEAR(found.y, 2.0f, 0.01f);
}

TEST_F(MitsubaBsdf, OtherSurroundings) {
  const Scene scene = folder_.load(
      "<emitter type=\"constant\"><rgb name=\"radiance\" value=\"0.5 1 2\"/></emitter>" +
      rectangleWith(""));
  ASSERT_TRUE(scene.environment.has_value());
  EXPECT_EQ(scene.environment->radiance.at(1), glm::vec3(0.5f, 1.0f, 2.0f));
  const Scene day = folder_.load(
      "<emitter type=\"sunsky\"><vector name=\"sun_direction\" x=\"0\" y=\"1\" "
      "z=\"1\"/></emitter>" +
      rectangleWith(""));
  EXPECT_TRUE(test::notes(day, "Preetham's sky"));
  EXPECT_NE(folder_.error("<emitter type=\"constant\"/><emitter type=\"constant\"/>")
                .find("a second one around the scene"),
            std::string::npos);
}

}  // namespace
}  // namespace restlab
