// Materials of a scene file that are set in a viewer.
#include <gtest/gtest.h>

#include <fstream>

#include "core/base/error.h"
#include "experiments/view/live_view.h"
#include "experiments/view/view_session.h"
#include "tests/runner/temporary_folder.h"
#include "tests/view/small_panes.h"

namespace restlab::view_test {
namespace {

class ViewMaterialsTest : public TemporaryFolder {
 protected:
  std::string writeScene(double sigma, const std::string& name = "x") {
    const std::filesystem::path file = folder() / (name + ".scene.toml");
    std::ofstream(file) << "base = \"cornell-box\"\n[[material]]\nname = \"clay\"\n"
                           "kind = \"oren_nayar\"\nsigma = "
                        << sigma << "\n[[assign]]\nmaterial = \"White\"\nto = \"clay\"\n";
    return file.string();
  }
  static LiveView open(const std::string& scene) {
    SceneRequest request;
    request.scene = scene;
    return {prepareScene(request), {smallPane("path"), smallPane("restir_gi")}, {}};
  }
  static std::vector<glm::vec3> pictureOf(LiveView& view) {
    view.renderFrames();
    return view.session(0).radiance().pixels;
  }
};

TEST_F(ViewMaterialsTest, AreThoseOfTheFileWithTheSettings) {
  LiveView view = open(writeScene(0.3));
  const std::vector<glm::vec3> before = pictureOf(view);
  const uint64_t epoch = view.epoch(), hash = view.shown().contentHash;
  view.apply(SetMaterial{"clay", "sigma", "0.7"});
  EXPECT_GT(view.epoch(), epoch);
  EXPECT_NE(view.shown().contentHash, hash) << "another reference";
  EXPECT_EQ(view.frames(1), 0u) << "a history of another scene";
  const std::vector<glm::vec3> after = pictureOf(view);
  EXPECT_NE(after, before);
  LiveView other = open(writeScene(0.3) + "?material.clay.sigma=0.7");
  EXPECT_EQ(after, pictureOf(other));
  // A factor on the light stays when a material changes, and the other way round.
  view.apply(SetLight{kAllLights, 2.0});
  view.apply(SetMaterial{"clay", "sigma", "0.4"});
  LiveView lit = open(writeScene(0.4));
  lit.apply(SetLight{kAllLights, 2.0});
  EXPECT_EQ(pictureOf(view), pictureOf(lit));
  view.apply(SetLight{kAllLights, 1.0});
  view.apply(SetMaterial{"clay", "sigma", std::nullopt});
  EXPECT_EQ(view.shown().contentHash, hash);
  view.apply(Undo{});
  EXPECT_NE(view.shown().contentHash, hash);
  view.apply(Redo{});
  EXPECT_EQ(view.shown().contentHash, hash);
}

TEST_F(ViewMaterialsTest, WhatTheFileWouldRefuseChangesNothing) {
  LiveView view = open(writeScene(0.3));
  const uint64_t epoch = view.epoch();
  const auto refused = [&](const SetMaterial& command, const std::string& part) {
    try {
      view.apply(command);
      ADD_FAILURE() << part;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
    EXPECT_EQ(view.epoch(), epoch);
    EXPECT_TRUE(view.settings().materials.empty());
  };
  refused({"clay", "sigma", "9"}, "'sigma' must be");
  refused({"clay", "sgma", "0.3"}, "did you mean 'sigma'");
  refused({"caly", "sigma", "0.3"}, "did you mean 'clay'");
  refused({"clay", "sigma", "0.3&camera.yfov=3"}, "no '&'");
  LiveView builtin{cornellBox(), {smallPane("path")}, {}};
  EXPECT_THROW(builtin.apply(SetMaterial{"White", "color", "0.3"}), Error);
}

// Another kind drops what the one before had alone. Materials of a scene file that the file begins
// with are set, too.
TEST_F(ViewMaterialsTest, OtherKindsAndThoseOfTheBase) {
  writeScene(0.3);
  writeScene(0.7, "rough");
  const auto onTopOf = [&](const std::string& base) {
    const std::filesystem::path file = folder() / ("on-" + base + ".scene.toml");
    std::ofstream(file) << "base = \"" << base << ".scene.toml\"\n[[material]]\nname = \"paint\"\n"
                        << "kind = \"oren_nayar\"\nsigma = 0.2\n"
                           "[[assign]]\nmesh = \"ShortBlock\"\nto = \"paint\"\n";
    return file.string();
  };
  ViewFacts facts;
  facts.request.scene = onTopOf("x");
  LiveView view = open(facts.request.scene);
  ASSERT_EQ(view.fileMaterials().size(), 2u);
  EXPECT_EQ(view.fileMaterials()[1].material.name, "clay");
  EXPECT_EQ(view.fileMaterials()[1].bases, 1u);
  view.apply(SetMaterial{"clay", "sigma", "0.7", 1});
  LiveView other = open(onTopOf("rough"));
  const std::vector<glm::vec3> rough = pictureOf(other);
  EXPECT_EQ(pictureOf(view), rough);
  view.apply(SetMaterial{"clay", "kind", "phong", 1});
  EXPECT_EQ(view.settings().materials, (MaterialEdits{{"base.material.clay.kind", "phong"}}));
  EXPECT_EQ(view.fileMaterials()[1].material.kind->name, "phong");
  EXPECT_EQ(view.loadedMaterials()[1].material.kind->name, "oren_nayar");
  EXPECT_NE(pictureOf(view), rough);
  view.apply(SetMaterial{"clay", "power", "7", 1});
  view.apply(SetMaterial{"paint", "kind", "diffuse"});
  const std::filesystem::path file = folder() / "session.toml";
  std::ofstream(file) << sessionToml(facts, view, "session");
  EXPECT_EQ(startOfSuite(file).prepared.contentHash, view.shown().contentHash);
  EXPECT_THROW(view.apply(SetMaterial{"clay", "sigma", "0.7", 1}), Error) << "phong has none";
  EXPECT_THROW(view.apply(SetMaterial{"clay", "kind", "plaster", 1}), Error);
  EXPECT_THROW(view.apply(SetMaterial{"clay", "sigma", "0.7", 2}), Error) << "a built-in scene";
  for (int i = 0; i < 3; ++i) view.apply(Undo{});
  EXPECT_EQ(view.fileMaterials()[1].material.kind->name, "oren_nayar");
  EXPECT_EQ(pictureOf(view), rough);
}

// The session that is saved names them behind the scene's name.
TEST_F(ViewMaterialsTest, AreSavedWithTheSession) {
  ViewFacts facts;
  facts.request.scene = writeScene(0.3);
  LiveView view = open(facts.request.scene);
  view.apply(SetMaterial{"clay", "sigma", "0.7"});
  const std::filesystem::path file = folder() / "session.toml";
  std::ofstream(file) << sessionToml(facts, view, "session");
  const ViewStart again = startOfSuite(file);
  EXPECT_EQ(again.prepared.contentHash, view.shown().contentHash);
  std::ifstream saved(file);
  const std::string text{std::istreambuf_iterator<char>(saved), {}};
  EXPECT_NE(text.find("\nname = \"x\"\n"), std::string::npos)
      << "settings would be part of names of files: " << text;
}

}  // namespace
}  // namespace restlab::view_test
