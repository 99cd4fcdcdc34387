// [[shape]] of scene files: instances of one geometry, meshes of files, normals of meshes.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/scene/compiled/compiled_scene.h"
#include "core/scene/field/grid_file.h"
#include "core/scene/scene.h"
#include "core/scene/scene_file/scene_file.h"
#include "core/scene/shapes/shape_info.h"
#include "tests/scene/gltf_builder.h"

namespace restlab {
namespace {

constexpr const char* kRoof =
    "v -1 0 1\nv 1 0 1\nv -1 1 0\nv 1 1 0\nv -1 0 -1\nv 1 0 -1\nvt 0 0\nvt 1 0.25\n"
    "f 1/1 2/2 4/2 3/1\nf 3/1 4/2 6/2 5/1\n";

class SceneFileShapes : public ::testing::Test {
 protected:
  Scene load(const std::string& text) {
    return loadScene(directory_.write("x.scene.toml", text).string());
  }
  std::string errorOf(const std::string& text) {
    try {
      load(text);
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

TEST_F(SceneFileShapes, InstancesShareOneGeometry) {
  const Scene scene = load(R"(
[[material]]
name = "clay"
kind = "diffuse"
color = [0.7, 0.4, 0.2]
[[shape]]
kind = "sphere"
name = "pearl"
scale = 0.5
emission = 2
instances = [{ translate = [1, 0, 0] }, { translate = [0, 2, 0], scale = 2, material = "clay" },
             { rotate = [0, 0, 1, 90], name = "third", emission = 3 }]
)");
  ASSERT_EQ(scene.geometries.size(), 1u);
  ASSERT_EQ(scene.instances.size(), 3u);
  EXPECT_EQ(scene.instances[0].name, "pearl 0");
  EXPECT_EQ(scene.instances[2].name, "third");
  // The shape's own transform comes first.
  EXPECT_EQ(scene.instances[0].objectToWorld * glm::dvec4(1, 0, 0, 1), glm::dvec4(1.5, 0, 0, 1));
  EXPECT_EQ(scene.instances[1].objectToWorld * glm::dvec4(0, 1, 0, 1), glm::dvec4(0, 3, 0, 1));
  const auto materialOfInstance = [&](size_t i) {
    return scene.materials[scene.instances[i].material];
  };
  EXPECT_EQ(materialOfInstance(0).data.emission.x, 2.0f);
  EXPECT_EQ(materialOfInstance(1).data.emission.x, 0.0f);
  EXPECT_EQ(materialOfInstance(2).data.emission.x, 3.0f);
  EXPECT_EQ(CompiledScene::build(scene)->lampCount(), 2u);
}

TEST_F(SceneFileShapes, MeshesComeFromFiles) {
  directory_.write("roof.obj", kRoof);
  const Scene scene = load("[[shape]]\nfile = \"roof.obj\"\ninstances = [{}, { scale = 2 }]\n");
  ASSERT_EQ(scene.geometries.size(), 1u);
  EXPECT_EQ(scene.instances.size(), 2u);
  const MeshGeometry& mesh = scene.geometries[0];
  EXPECT_EQ(mesh.shape, nullptr);
  EXPECT_EQ(mesh.triangles.size(), 4u);
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_EQ(mesh.uvs[0][1].y, 0.75f);  // rows of images begin at the top
  const uint64_t hash = scene.contentHash;
  directory_.write("roof.obj", std::string(kRoof) + "# more\n");
  EXPECT_NE(load("[[shape]]\nfile = \"roof.obj\"\ninstances = [{}, { scale = 2 }]\n").contentHash,
            hash);
}

// The roof's ridge is an edge of 90 degrees.
TEST_F(SceneFileShapes, NormalsFollowTheAngleOfCreases) {
  directory_.write("roof.obj", kRoof);
  const auto ridge = [&](const std::string& normals, const std::string& more = "") {
    const Scene scene =
        load("[[shape]]\nfile = \"roof.obj\"\nname = \"roof\"\n" + normals + "\n" + more);
    const MeshGeometry& mesh = scene.geometries[0];
    float least = 2.0f;
    for (size_t i = 0; i < mesh.normals.size(); ++i)
      if (mesh.positions[i].y == 1.0f) least = std::min(least, mesh.normals[i].y);
    return least;
  };
  EXPECT_EQ(ridge("normals = \"flat\""), 2.0f);
  EXPECT_EQ(ridge("normals = \"file\""), 2.0f);
  EXPECT_NEAR(ridge("normals = 60"), std::sqrt(0.5f), 1e-6f);
  EXPECT_NEAR(ridge("normals = 120"), 1.0f, 1e-6f);
  EXPECT_NEAR(ridge("normals = \"smooth\""), 1.0f, 1e-6f);
  EXPECT_NEAR(ridge("", "[[assign]]\nmesh = \"ro*\"\nnormals = 120.0\n"), 1.0f, 1e-6f);
  EXPECT_EQ(ridge("normals = 120", "[[assign]]\nmesh = \"roof\"\nnormals = \"flat\"\n"), 2.0f);
}

TEST_F(SceneFileShapes, FieldsAreReadFromTheirTexts) {
  const Scene scene = load(
      "[[shape]]\nkind = \"implicit\"\nexpression = \"x^2 + y^2 + z^2 - 0.25\"\n"
      "[[shape]]\nkind = \"sdf\"\ntree = \"plane(0, 0, 1, 0.5)\"\nbox = [-2, -2, 0, 2, 2, 1]\n");
  ASSERT_EQ(scene.geometries.size(), 2u);
  const ShapeGeometry& ball = *scene.geometries[0].shape;
  EXPECT_TRUE(ball.info->isClosed(ball));
  EXPECT_TRUE(ball.info->isInside(ball, {0.0, 0.4, 0.0}));
  EXPECT_FALSE(ball.info->isInside(ball, {0.0, 0.6, 0.0}));
  const ShapeGeometry& sheet = *scene.geometries[1].shape;
  EXPECT_FALSE(sheet.info->isClosed(sheet));
  EXPECT_EQ(sheet.info->box(sheet)[1], glm::vec3(2.0f, 2.0f, 1.0f));
  const std::string implicit = "[[shape]]\nkind = \"implicit\"\n";
  EXPECT_EQ(errorOf(implicit + "expression = \"x + foo\"\n").substr(0, 59),
            "x.scene.toml:3:14: 'expression': column 5, 'foo': 'foo' is ");
  EXPECT_EQ(
      errorOf(implicit + "expression = \"x - 1/y\"\n"),
      "x.scene.toml:3:14: 'expression': column 5: '1/y' divides by 0 or by nearly 0 somewhere "
      "in the box");
  EXPECT_EQ(
      errorOf(implicit + "expression = \"x^2 + 1\"\n"),
      "x.scene.toml:3:14: 'expression' has no surface in the box: nowhere it changes its sign");
  EXPECT_EQ(errorOf(implicit + "expression = \"x\"\nbox = [1, 0, 0, 0, 1, 1]\n").substr(0, 25),
            "x.scene.toml:4:7: 'box' i");
  EXPECT_EQ(errorOf(implicit).substr(0, 17), "x.scene.toml:1:1:");
  EXPECT_EQ(errorOf("[[shape]]\nkind = \"sdf\"\ntree = \"ball(1)\"\n").substr(0, 46),
            "x.scene.toml:3:8: 'tree': column 1, 'ball(1)':");
}

TEST_F(SceneFileShapes, ErrorsSayWhatIsWrong) {
  const std::string sphere = "[[shape]]\nkind = \"sphere\"\nname = \"ball\"\n";
  EXPECT_EQ(errorOf(sphere + "instances = [{ translat = [0, 0, 0] }]\n"),
            "x.scene.toml:4:16: unknown key 'translat', did you mean 'translate'?");
  EXPECT_EQ(errorOf(sphere + "file = \"a.obj\"\n"),
            "x.scene.toml:2:8: 'kind' beside 'file': a shape or a mesh, one of them");
  EXPECT_EQ(errorOf("[[shape]]\nfile = \"a.stl\"\n"),
            "x.scene.toml:2:8: 'a.stl' is no mesh that is read; an .obj or a .ply expected");
  EXPECT_EQ(errorOf(sphere + "[[assign]]\nmesh = \"ball\"\nnormals = 30\n"),
            "x.scene.toml:6:11: 'ball' is a shape, which has the normals of its equation; a mesh "
            "expected");
  EXPECT_EQ(errorOf(sphere + "[[assign]]\nnode = \"ball\"\nnormals = 30\n"),
            "x.scene.toml:6:11: 'normals' are of a mesh; name it by 'mesh'");
  directory_.write("roof.obj", kRoof);
  EXPECT_NE(errorOf("[[shape]]\nfile = \"roof.obj\"\nnormals = 200\n").find("x.scene.toml:3:11"),
            std::string::npos);
  EXPECT_NE(errorOf("[[shape]]\nfile = \"roof.obj\"\nnormals = \"round\"\n").find("smooth"),
            std::string::npos);
  EXPECT_NE(errorOf("[[shape]]\nfile = \"../roof.obj\"\n").find("x.scene.toml:2:8"),
            std::string::npos);
}

TEST_F(SceneFileShapes, SolidsReadGridsBelowTheirFolder) {
  SampledGrid grid{glm::ivec3(9), glm::dvec3(-1.0), glm::dvec3(1.0), {}};
  for (int i = 0; i < 9 * 9 * 9; ++i)
    grid.values.push_back(
        float(glm::length(glm::dvec3(i % 9, i / 9 % 9, i / 81) / 4.0 - 1.0) - 0.6));
  const auto writeGrid = [&] {
    const std::vector<uint8_t> bytes = gridBytes(grid);
    directory_.write("ball.vol", std::string(bytes.begin(), bytes.end()));
  };
  writeGrid();
  const auto sdf = [](const std::string& tree) {
    return "[[shape]]\nkind = \"sdf\"\ntree = \"" + tree + "\"\n";
  };
  const Scene ball = load(sdf("grid('ball.vol')"));
  const ShapeGeometry& shape = *ball.geometries.at(0).shape;
  EXPECT_TRUE(shape.info->isClosed(shape));
  EXPECT_TRUE(shape.info->isInside(shape, {0.0, 0.0, 0.5}));
  EXPECT_FALSE(shape.info->isInside(shape, {0.4, 0.4, 0.4}));
  load(sdf("smooth_union(0.1, grid('ball.vol'), translate(0.5, 0, 0, grid('./ball.vol')))"));
  grid.values[0] += 1.0f;
  writeGrid();
  EXPECT_NE(load(sdf("grid('ball.vol')")).contentHash, ball.contentHash);
  const auto expectError = [&](const std::string& tree, const std::string& part) {
    const std::string line = errorOf(sdf(tree));
    EXPECT_EQ(line.rfind("x.scene.toml:3:8: 'tree': ", 0), 0u) << line;
    EXPECT_NE(line.find(part), std::string::npos) << line;
  };
  expectError("grid('bell.vol')", "file 'bell.vol' does not exist; did you mean 'ball.vol'?");
  expectError("grid('../ball.vol')", "leaves the scene's folder");
  expectError("grid(ball.vol)", "column 6, 'ball.vol)': a name between ' and ' is missing");
  expectError("grid('ball.vol)", "the ' that ends it is missing");
  directory_.write("ball.vol", "VOL\3 cut off");
  expectError("grid('ball.vol')", "ball.vol: ends within its header");
  grid.values.assign(grid.values.size(), 1.0f);
  writeGrid();
  expectError("grid('ball.vol')", "no sample of a grid is 0 or below");
}

}  // namespace
}  // namespace restlab
