// NAME.scene.toml: what becomes of the base scene, and every error line.
#include "core/scene/scene_file/scene_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "core/base/error.h"
#include "core/dialect/features.h"
#include "core/scene/compiled/compiled_scene.h"
#include "core/scene/material_notes.h"
#include "core/shading/bsdf.h"
#include "tests/scene/gltf_builder.h"

namespace restlab {
namespace {

constexpr const char* kClay = R"([[material]]
name = "clay"
kind = "oren_nayar"
color = [0.7, 0.4, 0.2]
)";

class SceneFile : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& text, const std::string& name = "x.scene.toml") {
    directory_.write(name, text);
    return directory_.path() / name;
  }
  // The error line of a file, without the folder.
  std::string errorOf(const std::string& text) {
    const std::filesystem::path file = write(text);
    try {
      loadScene(file.string());
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::badInput);
      std::string line = error.what();
      const std::string folder = directory_.path().string() + "/";
      for (size_t at; (at = line.find(folder)) != std::string::npos;) line.erase(at, folder.size());
      return line;
    }
    return "no error";
  }
  test::TempDirectory directory_;
};

const SceneMaterial& materialOf(const Scene& scene, const std::string& mesh) {
  for (const MeshInstance& instance : scene.instances) {
    if (scene.geometries[instance.geometry].name == mesh) return scene.materials[instance.material];
  }
  throw std::runtime_error("no mesh " + mesh);
}

TEST_F(SceneFile, GivesAMaterialOfTheBaseAnotherKind) {
  const Scene base = makeBuiltinScene("cornell-box");
  const Scene scene = loadScene(write(std::string("base = \"cornell-box\"\n") + kClay +
                                      "[[assign]]\nmaterial = \"White\"\nto = \"clay\"\n")
                                    .string());
  EXPECT_EQ(scene.name, "x");
  EXPECT_NE(scene.contentHash, base.contentHash);
  size_t changed = 0;
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    const SceneMaterial& m = scene.materials[i];
    EXPECT_EQ(m.data.closure != rl::RL_CLOSURE_GLTF, m.name == "White") << m.name;
    if (m.name != "White") continue;
    ++changed;
    EXPECT_EQ(m.data.closure, rl::RL_CLOSURE_OREN_NAYAR);
    ASSERT_EQ(m.closure.size(), 3u);
    EXPECT_EQ(std::bit_cast<float>(m.closure[0].words.y), 0.4f);
    EXPECT_EQ(std::bit_cast<float>(m.closure[1].words.x), 0.5f) << "the default";
  }
  EXPECT_EQ(changed, 1u);
  const rl::FeatureMask features = CompiledScene::build(scene)->features();
  EXPECT_EQ(features & rl::RL_FEATURE_CLOSURES, rl::RL_FEATURE_CLOSURE_OREN_NAYAR);
}

// Meshes that share a material with others get one of their own.
TEST_F(SceneFile, AMeshGetsAMaterialOfItsOwn) {
  const Scene base = makeBuiltinScene("door-ajar");
  const Scene scene = loadScene(write(std::string("base = \"door-ajar\"\n") + kClay +
                                      "[[assign]]\nmesh = \"bo[wx]l\"\nto = \"clay\"\n")
                                    .string());
  EXPECT_EQ(scene.materials.size(), base.materials.size() + 1);
  EXPECT_EQ(materialOf(scene, "bowl").data.closure, rl::RL_CLOSURE_OREN_NAYAR);
  EXPECT_EQ(materialOf(scene, "vase").data.closure, rl::RL_CLOSURE_GLTF) << "was of one material";
}

TEST_F(SceneFile, LampsStayLamps) {
  const Scene scene = loadScene(write(std::string("base = \"cornell-box\"\n") + kClay +
                                      "[[assign]]\nmaterial = \"*\"\nto = \"clay\"\n")
                                    .string());
  const auto shines = [](const SceneMaterial& m) { return m.data.emission.x > 0.0f; };
  EXPECT_EQ(std::count_if(scene.materials.begin(), scene.materials.end(), shines), 1);
}

// The lobes of glTF: a dielectric by the words of the field.
TEST_F(SceneFile, KindsThatTheLobesStandFor) {
  const Scene scene = loadScene(write(R"(base = "cornell-box"
[[material]]
name = "water"
kind = "dielectric"
ior = 1.33
alpha = 0.25
absorption = [1.0, 0.5, 0.0]
[[material]]
name = "hole"
kind = "black"
[[assign]]
material = "White"
to = "hole"
[[assign]]
mesh = "Tall*"
to = "water"
)")
                                    .string());
  size_t bodies = 0, holes = 0;
  for (const SceneMaterial& m : scene.materials) {
    holes += (m.data.flags & rl::RL_MATERIAL_BLACK) != 0;
    if (m.data.transmission != 1.0f) continue;
    ++bodies;
    EXPECT_EQ(m.data.ior, 1.33f);
    EXPECT_EQ(m.data.roughness, 0.5f);
    EXPECT_EQ(m.data.sigmaAbsorption, glm::vec3(1.0f, 0.5f, 0.0f));
  }
  EXPECT_EQ(bodies, 1u);
  EXPECT_EQ(holes, 2u) << "the lamp is one in the base scene";
}

TEST_F(SceneFile, LightsAndACamera) {
  const Scene scene = loadScene(write(R"(base = "cornell-box"
[[light]]
kind = "spot"
position = [0.0, 1.0, 0.0]
direction = [0.0, -2.0, 0.0]
intensity = [3.0, 2.0, 1.0]
outer_cone = 60.0
[camera]
position = [0.0, 1.0, 5.0]
target = [0.0, 1.0, 0.0]
yfov = 30.0
)")
                                    .string());
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].kind, rl::RL_LIGHT_SPOT);
  EXPECT_EQ(scene.lights[0].dirW, glm::dvec3(0.0, -1.0, 0.0));
  EXPECT_NEAR(scene.lights[0].outerConeAngle, 1.047198, 1e-5);
  ASSERT_EQ(scene.cameras.size(), 1u);
  EXPECT_EQ(positionOf(scene.cameras[0]), glm::dvec3(0.0, 1.0, 5.0));
  EXPECT_EQ(glm::dvec3(scene.cameras[0].cameraToWorld[2]), glm::dvec3(0.0, 0.0, 1.0));
}

TEST_F(SceneFile, BeginsWithAnother) {
  write(std::string("base = \"cornell-box\"\n") + kClay +
            "[[assign]]\nmaterial = \"White\"\nto = \"clay\"\n",
        "first.scene.toml");
  const Scene scene =
      loadScene(write("base = \"first.scene.toml\"\n", "second.scene.toml").string());
  EXPECT_NE(CompiledScene::build(scene)->features() & rl::RL_FEATURE_CLOSURES, 0u);
  for (const char* base : {"x.scene.toml", "."}) {
    std::filesystem::remove_all(directory_.path() / "first.scene.toml");
    std::filesystem::remove_all(directory_.path() / "second.scene.toml");
    EXPECT_NE(errorOf("base = \"" + std::string(base) + "\"\n")
                  .find("more than 8 scene files begin with one"),
              std::string::npos)
        << base;
  }
}

TEST_F(SceneFile, EveryFaultIsOneLineWithItsPlace) {
  const std::string base = "base = \"cornell-box\"\n";
  const struct {
    std::string text, line;
  } cases[] = {
      {"", "x.scene.toml:1:1: no 'base'"},
      {"base = \"cornel-box\"\n", "x.scene.toml:1:8: scene 'cornel-box': neither a built-in"},
      {base + "[[materail]]\n",
       "x.scene.toml:2:3: unknown key 'materail', did you mean 'material'?"},
      {base + "[[material]]\nkind = \"mirror\"\n", "x.scene.toml:2:1: [[material]] has no 'name'"},
      {base + "[[material]]\nname = \"m\"\n",
       "x.scene.toml:2:1: [[material]] has no 'kind'; one of"},
      {base + "[[material]]\nname = \"m\"\nkind = \"miror\"\n",
       "x.scene.toml:4:8: unknown kind 'miror', did you mean 'mirror'?"},
      {base + "[[material]]\nname = \"m\"\nkind = \"mirror\"\ncolour = 1.0\n",
       "x.scene.toml:5:1: unknown key 'colour', did you mean 'color'?"},
      {base + "[[material]]\nname = \"m\"\nkind = \"mirror\"\ncolor = 1.5\n",
       "x.scene.toml:5:9: 'color' must be"},
      {base + "[[material]]\nname = \"m\"\nkind = \"mirror\"\ncolor = [0.5, 0.5]\n",
       "x.scene.toml:5:9: 'color' must be an array of 3 numbers"},
      {base + "[[material]]\nname = \"m\"\nkind = \"phong\"\ndiffuse = 0.8\n",
       "x.scene.toml:2:1: 'diffuse' + 'specular' is 1.3; at most 1 expected"},
      {base + "[[material]]\nname = \"m\"\nkind = \"mirror\"\ncolor_texture = \"none.png\"\n",
       "x.scene.toml:5:17: none.png: "},
      {base + "[[material]]\nname = \"m\"\nkind = \"mirror\"\ncolor_texture = \".\"\n",
       "x.scene.toml:5:17: .: is not a file"},
      {base + "[[material]]\nname = \"m\"\nkind = \"plastic\"\nalpha_texture = \"x.png\"\n",
       "x.scene.toml:5:1: unknown key 'alpha_texture'"},
      {base + "[[material]]\nname = \"m\"\nkind = \"power_lobe\"\npower_texture = \"x.png\"\n",
       "x.scene.toml:5:1: unknown key 'power_texture'"},
      {base + kClay + kClay, "a second [[material]] is named 'clay'"},
      {base + kClay + "[[assign]]\nmaterial = \"White\"\nto = \"caly\"\n",
       "x.scene.toml:8:6: no [[material]] is named 'caly'; did you mean 'clay'?"},
      {base + kClay + "[[assign]]\nmaterial = \"Whit\"\nto = \"clay\"\n",
       "x.scene.toml:7:12: no material is named 'Whit'; did you mean 'White'?"},
      {base + kClay + "[[assign]]\nmaterial = \"White\"\nmesh = \"floor\"\nto = \"clay\"\n",
       "x.scene.toml:8:8: 'mesh' beside 'material'"},
      {base + kClay + "[[assign]]\nto = \"clay\"\n",
       "x.scene.toml:6:1: [[assign]] has none of 'material', 'mesh', 'node'"},
      {base + "[[light]]\nkind = \"spot\"\ndirection = [0.0, 0.0, 0.0]\n",
       "x.scene.toml:4:13: 'direction' must not be 0"},
      {base + "[camera]\nposition = [0.0, 1.0, 0.0]\ntarget = [0.0, 0.0, 0.0]\n",
       "x.scene.toml:4:10: 'target' is at 'position', or straight above"},
      {base + "[environment]\nfile = \"sky.hdr\"\n", "x.scene.toml:3:8: sky.hdr"},
      {base + "[environment]\n", "x.scene.toml:2:1: [environment] takes 'file', an .hdr or .exr"},
      {base + "[[light]]\nkind = \"spot\"\nattenuation = [1.0, 0.0, 0.0]\n",
       "x.scene.toml:4:1: unknown key 'attenuation'"},
      {base + "[[light]]\nattenuation = [0.0, 0.0, 0.0]\n",
       "x.scene.toml:3:15: 'attenuation' is 0"},
      {base + "[[light]]\nkind = \"ambient\"\nintensity = 1.0\n",
       "x.scene.toml:4:1: unknown key 'intensity'"},
      {base + "[[material]]\nname = \"m\"\nkind = \"table\"\n",
       "x.scene.toml:2:1: kind 'table' has no 'file'"},
      {base + "[[material]]\nname = \"m\"\nkind = \"table\"\nfile = \"none.binary\"\n",
       "x.scene.toml:5:8: none.binary: "},
      {base + "[[material]]\nname = \"m\"\nkind = \"mixture\"\nfirst = \"clay\"\n",
       "x.scene.toml:5:9: no [[material]] above is named 'clay'"},
      {base + kClay + "[[material]]\nname = \"m\"\nkind = \"mixture\"\nfirst = \"caly\"\n",
       "x.scene.toml:9:9: no [[material]] above is named 'caly'; did you mean 'clay'?"},
      {base + kClay + "[[material]]\nname = \"m\"\nkind = \"mixture\"\nfirst = \"clay\"\n",
       "x.scene.toml:6:1: kind 'mixture' has no 'second'"},
      {base + kClay +
           "[[material]]\nname = \"m\"\nkind = \"mixture\"\nfirst = \"clay\"\n"
           "second = \"clay\"\nthird = \"clay\"\nsecond_share = 0.8\nthird_share = 0.3\n",
       "x.scene.toml:6:1: 'second_share' + 'third_share' + 'fourth_share' is 1.1; at most 1"},
      {base + kClay +
           "[[material]]\nname = \"m\"\nkind = \"mixture\"\nfirst = \"clay\"\n"
           "second = \"clay\"\nthird_share = 0.3\n",
       "x.scene.toml:11:15: 'third_share' without 'third'"},
      {base + "[[material]]\nname = \"glass\"\nkind = \"dielectric\"\n[[material]]\nname = \"m\"\n"
              "kind = \"mixture\"\nfirst = \"glass\"\nsecond = \"glass\"\n",
       "x.scene.toml:8:9: 'glass' is of kind 'dielectric': a mixture takes kinds that reflect"},
      {base + "[[material]]\nname = \"candle\"\nkind = \"wax\"\n[[material]]\nname = \"m\"\n"
              "kind = \"mixture\"\nfirst = \"candle\"\nsecond = \"candle\"\n",
       "x.scene.toml:8:9: 'candle' is of kind 'wax': a mixture takes kinds that reflect"},
  };
  for (const auto& c : cases) {
    const std::string line = errorOf(c.text);
    EXPECT_NE(line.find(c.line), std::string::npos) << c.text << "\n-> " << line;
    EXPECT_EQ(line.find('\n'), std::string::npos);
  }
}

TEST_F(SceneFile, AmbientLightAttenuationAndWhatIsSeenBehind) {
  const Scene scene = loadScene(write(R"(base = "cornell-box"
[[light]]
kind = "ambient"
radiance = [0.1, 0.2, 0.3]
[[light]]
position = [0.0, 1.0, 0.0]
attenuation = [1.0, 0.5, 0.25]
[environment]
radiance = 0.5
[background]
radiance = [0.0, 0.0, 1.0]
)")
                                    .string());
  EXPECT_EQ(scene.ambient, glm::vec3(0.1f, 0.2f, 0.3f));
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_EQ(scene.lights[0].attenuation, glm::vec3(1.0f, 0.5f, 0.25f));
  ASSERT_TRUE(scene.environment);
  EXPECT_EQ(scene.environment->radiance[0], glm::vec3(0.5f));
  EXPECT_EQ(scene.background, glm::vec3(0.0f, 0.0f, 1.0f));
  const rl::FeatureMask features = CompiledScene::build(scene)->features();
  EXPECT_NE(features & rl::RL_FEATURE_AMBIENT, 0u);
}

// The kind `gltf` has the layers of its extensions. A mixture does not draw them, so it takes none.
TEST_F(SceneFile, GltfHasLayers) {
  const std::string velvet = R"(
[[material]]
name = "velvet"
kind = "gltf"
roughness = 0.7
clearcoat = 0.5
sheen = [0.1, 0.2, 0.3]
)";
  const Scene scene = loadScene(write("base = \"cornell-box\"\n" + velvet +
                                      "[[assign]]\nmaterial = \"White\"\nto = \"velvet\"\n")
                                    .string());
  const SceneMaterial& material = materialOf(scene, "TallBlock");
  EXPECT_EQ(material.data.closure, rl::RL_CLOSURE_GLTF);
  EXPECT_EQ(material.data.roughness, 0.7f);
  EXPECT_EQ(material.data.flags & rl::RL_MATERIAL_LAYERS,
            rl::RL_MATERIAL_CLEARCOAT | rl::RL_MATERIAL_SHEEN);
  ASSERT_EQ(material.closure.size(), rl::RL_LAYER_COUNT);
  EXPECT_EQ(std::bit_cast<float>(material.closure[rl::RL_LAYER_SHEEN_COLOR].words.z), 0.3f);
  EXPECT_EQ(CompiledScene::build(scene)->features() & rl::RL_FEATURE_LAYERS,
            rl::RL_FEATURE_CLEARCOAT | rl::RL_FEATURE_SHEEN);
  const std::string mixture =
      "[[material]]\nname = \"m\"\nkind = \"mixture\"\nfirst = \"velvet\"\nsecond = \"velvet\"\n";
  try {
    loadScene(write("base = \"cornell-box\"\n" + velvet + mixture).string());
    FAIL() << "a mixture of layers was read";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("without layers"), std::string::npos) << error.what();
  }
}

// Parts of a mixture are materials that no mesh has; what they need, the scene needs.
TEST_F(SceneFile, MixesMaterials) {
  const Scene scene = loadScene(write(std::string("base = \"cornell-box\"\n") + kClay + R"(
[[material]]
name = "metal"
kind = "conductor"
anisotropic = 0.5
[[material]]
name = "rusty"
kind = "mixture"
first = "metal"
second = "clay"
[[assign]]
material = "White"
to = "rusty"
)")
                                    .string());
  const SceneMaterial& mixed = materialOf(scene, "TallBlock");
  EXPECT_EQ(mixed.data.closure, rl::RL_CLOSURE_MIXTURE);
  EXPECT_NE(mixed.data.flags & rl::RL_MATERIAL_ANISOTROPIC, 0u) << "a part looks at the tangent";
  EXPECT_EQ(scene.materials.at(mixed.closure[0].words.x).name, "metal");
  EXPECT_EQ(scene.materials.at(mixed.closure[1].words.x).name, "clay");
  EXPECT_EQ(mixed.closure[2].words.x, rl::RL_INVALID);
  EXPECT_EQ(CompiledScene::build(scene)->features() & rl::RL_FEATURE_CLOSURES,
            rl::RL_FEATURE_CLOSURE_MIXTURE | rl::RL_FEATURE_CLOSURE_CONDUCTOR |
                rl::RL_FEATURE_CLOSURE_OREN_NAYAR);
}

// An assignment means materials of the base, not the parts of a mixture that have their names.
TEST_F(SceneFile, AssignmentsLeavePartsAlone) {
  const Scene scene = loadScene(write(std::string("base = \"cornell-box\"\n") + kClay + R"(
[[material]]
name = "White"
kind = "conductor"
[[material]]
name = "rusty"
kind = "mixture"
first = "White"
second = "clay"
[[assign]]
material = "*"
to = "rusty"
)")
                                    .string());
  const SceneMaterial& mixed = materialOf(scene, "TallBlock");
  EXPECT_EQ(mixed.data.closure, rl::RL_CLOSURE_MIXTURE);
  EXPECT_EQ(scene.materials.at(mixed.closure[0].words.x).data.closure, rl::RL_CLOSURE_CONDUCTOR);
  EXPECT_EQ(scene.materials.at(mixed.closure[1].words.x).data.closure, rl::RL_CLOSURE_OREN_NAYAR);
}

// Settings behind the '?' of a name take the place of the file's.
TEST_F(SceneFile, SettingsBehindItsName) {
  const std::string file =
      write(std::string("base = \"cornell-box\"\n") + kClay +
            "[[assign]]\nmaterial = \"White\"\nto = \"clay\"\n[camera]\nyfov = 30.0\n")
          .string();
  const Scene plain = loadScene(file);
  const Scene scene = loadScene(file + "?material.clay.sigma=0.25&camera.yfov=60");
  EXPECT_EQ(scene.name, "x?material.clay.sigma=0.25&camera.yfov=60");
  EXPECT_EQ(std::bit_cast<float>(materialOf(scene, "TallBlock").closure[1].words.x), 0.25f);
  EXPECT_NEAR(scene.cameras[0].yfov, 2.0 * plain.cameras[0].yfov, 1e-12);
  EXPECT_NE(scene.contentHash, plain.contentHash);
  const struct {
    const char *settings, *line;
  } cases[] = {
      {"material.caly.sigma=0.3", "no [[material]] is named 'caly'; did you mean 'clay'?"},
      {"material.clay.sgma=0.3", "unknown key 'sgma'"},
      {"material.clay.sigma=9", "'sigma' must be"},
      {"material.sigma=0.3", "material.NAME.KEY"},
      {"light.lamp.intensity=2", "no [[light]] is named 'lamp'"},
      {"environment.scale=2", "the file has no [environment]"},
      {"sigma", "must be KEY=VALUE"},
  };
  for (const auto& c : cases) {
    try {
      loadScene(file + "?" + c.settings);
      ADD_FAILURE() << c.settings;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::badInput) << c.settings;
      EXPECT_NE(std::string(error.what()).find(c.line), std::string::npos) << error.what();
    }
  }
}

// Included text is a part of the scene.
// Materials are drawn as they are; a run says what they break or approximate.
TEST_F(SceneFile, NotesOnMaterialsThatAreUsed) {
  const auto notesOf = [&](const std::string& material, const std::string& to = "m") {
    return materialNotes(
        loadScene(write("base = \"cornell-box\"\n" + material + kClay +
                        "[[material]]\nname = \"mix\"\nkind = \"mixture\"\nfirst = \"clay\"\n"
                        "second = \"m\"\n[[assign]]\nmaterial = \"White\"\nto = \"" +
                        to + "\"\n")
                      .string()));
  };
  const std::string raw = "[[material]]\nname = \"m\"\nkind = \"phong\"\n";
  const std::vector<std::string> said = notesOf(raw);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0],
            "x: material 'm' (phong, model = raw) breaks laws of a BSDF: energy and "
            "reciprocity");
  EXPECT_EQ(notesOf(raw, "mix").size(), 1u) << "a part";
  EXPECT_TRUE(notesOf(raw, "clay").empty()) << "not used";
  EXPECT_TRUE(notesOf(raw + "model = \"modified\"\n").empty());
}

TEST_F(SceneFile, ADiffusionProfileIsSaidToBeBiased) {
  const Scene scene =
      loadScene(write("base = \"cornell-box\"\n[[material]]\nname = \"m\"\nkind = \"wax\"\nmodel = "
                      "\"diffusion\"\n[[assign]]\nmesh = \"ShortBlock\"\nto = \"m\"\n")
                    .string());
  const std::vector<std::string> said = materialNotes(scene);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("is biased"), std::string::npos) << said[0];
}

TEST_F(SceneFile, IncludedFilesAreInTheHash) {
  const std::string text =
      "include = [\"library.toml\"]\nbase = \"cornell-box\"\n"
      "[[assign]]\nmaterial = \"White\"\nto = \"clay\"\n";
  write(kClay, "library.toml");
  const uint64_t before = loadScene(write(text).string()).contentHash;
  EXPECT_EQ(loadScene(write(text).string()).contentHash, before);
  write(std::string(kClay) + "sigma = 0.9\n", "library.toml");
  EXPECT_NE(loadScene(write(text).string()).contentHash, before);
}

// Copies that a mesh got keep the name of their material.
TEST_F(SceneFile, LaterAssignmentsWin) {
  const Scene scene = loadScene(write(std::string("base = \"cornell-box\"\n") + kClay +
                                      "[[material]]\nname = \"glossy\"\nkind = \"phong\"\n"
                                      "[[assign]]\nmesh = \"TallBlock\"\nto = \"clay\"\n"
                                      "[[assign]]\nmaterial = \"White\"\nto = \"glossy\"\n"
                                      "[[assign]]\nnode = \"ShortBlock\"\nto = \"clay\"\n")
                                    .string());
  EXPECT_EQ(materialOf(scene, "TallBlock").data.closure, rl::RL_CLOSURE_PHONG);
  EXPECT_EQ(materialOf(scene, "ShortBlock").data.closure, rl::RL_CLOSURE_OREN_NAYAR);
}

// A directory or a stem finds a scene file as it finds a glTF file.
TEST_F(SceneFile, IsFoundByItsStem) {
  write("base = \"cornell-box\"\n", "hall.scene.toml");
  EXPECT_EQ(loadScene((directory_.path() / "hall").string()).name, "hall");
  EXPECT_EQ(loadScene(directory_.path().string()).name, "hall");
}

}  // namespace
}  // namespace restlab
