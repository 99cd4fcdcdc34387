// `distance-field`: a mesh becomes a grid that a solid reads.
#include "core/image/image.h"
#include "tests/cli/program.h"
#include "tests/cli/small_suite.h"

namespace restlab::cli_test {
namespace {

constexpr const char* kCube =
    "v -1 -1 -1\nv 1 -1 -1\nv -1 1 -1\nv 1 1 -1\nv -1 -1 1\nv 1 -1 1\nv -1 1 1\nv 1 1 1\n"
    "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

TEST_F(ProgramTest, DistanceFieldMakesAGridOfAMesh) {
  write("cube.obj", kCube);
  const ProgramResult made = run("distance-field cube.obj --cells 20 -o cube.vol");
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_NE(made.out.find("cube.vol: 21 x 21 x 21 samples, cells of 0.125"), std::string::npos)
      << made.out;
  EXPECT_EQ(read("cube.vol").size(), 48u + 4u * 21u * 21u * 21u);
  // A light cube in the dark: its outline on the image.
  const auto image = [&](const std::string& name, const std::string& shape) {
    write(name + ".scene.toml",
          "[[shape]]\n" + shape +
              "\nemission = 1\n[camera]\nposition = [3, 4, 5]\ntarget = [0, 0, 0]\nyfov = 40\n");
    const ProgramResult result = run("render " + name + ".scene.toml -o " + name +
                                     ".exr --width 48 --height 48 --spp 4 --max-bounces 0");
    EXPECT_EQ(result.code, 0) << result.err;
    return readExr(path(name + ".exr")).layers.at("");
  };
  const Image mesh = image("mesh", "file = \"cube.obj\"");
  const Image grid = image("grid", "kind = \"sdf\"\ntree = \"grid('cube.vol')\"");
  double sum = 0.0, differs = 0.0;
  for (uint32_t y = 0; y < 48; ++y)
    for (uint32_t x = 0; x < 48; ++x) {
      sum += double(mesh.at(x, y).x);
      differs += std::abs(double(mesh.at(x, y).x) - double(grid.at(x, y).x));
    }
  EXPECT_GT(sum, 300.0);
  EXPECT_LT(differs, 0.01 * sum);
  // The same from a scene that holds the mesh.
  ASSERT_EQ(run("distance-field mesh.scene.toml --cells 20 -o other.vol").code, 0);
  EXPECT_EQ(read("other.vol"), read("cube.vol"));
}

TEST_F(ProgramTest, DistanceFieldRefusesOpenSurfaces) {
  write("open.obj", std::string(kCube).substr(0, std::string(kCube).rfind("f 2")));
  expectError(run("distance-field open.obj -o open.vol"), 3,
              {"open.obj: the surface is not closed: 4 of its", "a closed surface expected"});
  EXPECT_FALSE(std::filesystem::exists(path("open.vol")));
  write("cube.obj", kCube);
  expectError(run("distance-field cube.obj -o cube.exr"), 2, {"cube.exr", ".vol"});
  expectError(run("distance-field cube.obj --cells 4 -o cube.vol"), 2, {"--cells"});
  expectError(run("distance-field nothing.obj -o cube.vol"), 3, {"nothing.obj"});
  expectError(run("distance-field cube.obj -o missing/cube.vol"), 3, {"missing"});
  // A disk that is full leaves the old file.
  write("cube.vol", "old");
  Circumstances full;
  full.maxFileBytes = 4096;
  EXPECT_NE(run("distance-field cube.obj -o cube.vol", full).code, 0);
  EXPECT_EQ(read("cube.vol"), "old");
}

}  // namespace
}  // namespace restlab::cli_test
