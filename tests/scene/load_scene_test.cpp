// Finding and loading of scenes and environments.
#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

#include "core/base/error.h"
#include "core/image/image.h"
#include "tests/scene/gltf_builder.h"

namespace restlab {
namespace {

namespace fs = std::filesystem;

const char kEmptyScene[] = "{\"asset\": {\"version\": \"2.0\"}}";

template <class Call>
std::string errorOf(Call call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::badInput);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "";
}

// RAII: sets an environment variable for a scope.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old, hadOld_ = true;
    setenv(name, value.c_str(), 1);
  }
  ~Variable() { hadOld_ ? setenv(name_, old_.c_str(), 1) : unsetenv(name_); }

 private:
  const char* name_;
  std::string old_;
  bool hadOld_ = false;
};

// A name that is found in the folder of scenes each time has no end of bases.
TEST(LoadScene, BouncesOfAFileThatBeginsWithItself) {
  test::TempDirectory directory;
  directory.write("sub/itself.scene.toml", "base = \"sub/itself.scene.toml\"\n");
  const Variable scenes("RESTLAB_SCENES", directory.path().string());
  EXPECT_EQ(suggestedBounces("sub/itself.scene.toml"), std::nullopt);
}

TEST(LoadScene, BouncesAndFilmsOfGltf) {
  test::TempDirectory directory;
  const auto bounces = [&](const std::string& extras, const std::string& film) {
    directory.write(
        "a.gltf",
        "{\"asset\": {\"version\": \"2.0\"}, \"scenes\": [{\"nodes\": [0], \"extras\": " + extras +
            "}], \"nodes\": [{\"camera\": 0}], \"cameras\": [{\"type\": "
            "\"perspective\", \"perspective\": {\"yfov\": 1, \"znear\": 1}, "
            "\"extras\": {\"restlab\": {\"film\": " +
            film + "}}}]}");
    return loadScene((directory.path() / "a.gltf").string());
  };
  const Scene scene = bounces("{\"restlab\": {\"max_bounces\": 5}}", "[18, 12]");
  EXPECT_EQ(scene.maxBounces, 5u);
  EXPECT_EQ(scene.cameras.at(0).film, glm::uvec2(18, 12));
  EXPECT_EQ(suggestedBounces((directory.path() / "a.gltf").string()), 5u);
  EXPECT_EQ(bounces("7", "[18, 12]").maxBounces, std::nullopt);
  for (const char* bad : {"-1", "1.5", "\"2\"", "2000"})
    EXPECT_NE(errorOf([&] {
                bounces(std::string("{\"restlab\": {\"max_bounces\": ") + bad + "}}", "[1, 1]");
              }).find("a.gltf: scenes[0].extras.restlab.max_bounces: "),
              std::string::npos)
        << bad;
  for (const char* bad : {"[0, 1]", "[1]", "3", "[1, 1.5]"})
    EXPECT_NE(errorOf([&] { bounces("{}", bad); }).find("cameras[0].extras.restlab.film: "),
              std::string::npos)
        << bad;
}

TEST(LoadScene, FileDirectoryAndStem) {
  test::TempDirectory directory;
  directory.write("room/room.gltf", kEmptyScene);
  directory.write("khronos/glTF/box.gltf", kEmptyScene);
  directory.write("khronos/glTF/notes.txt", "");
  directory.write("two/a.gltf", kEmptyScene);
  directory.write("two/b.glb", "");
  directory.write("none/readme.txt", "");
  directory.write("room/notes.xml", "<notes/>");
  directory.write("mitsuba/scene.xml", "<scene version=\"3.0.0\"><shape type=\"cube\"/></scene>");
  const fs::path root = directory.path();
  for (const fs::path& path : {root / "room/room.gltf", root / "room", root / "room/room"}) {
    EXPECT_EQ(loadScene(path.string()).source, root / "room/room.gltf") << path;
  }
  EXPECT_EQ(loadScene((root / "khronos").string()).name, "box");
  for (const fs::path& path : {root / "mitsuba/scene", root / "mitsuba"})
    EXPECT_EQ(loadScene(path.string()).source, root / "mitsuba/scene.xml") << path;
  EXPECT_NE(errorOf([&] { loadScene((root / "two").string()); }).find("name one of a.gltf, b.glb"),
            std::string::npos);
  EXPECT_NE(errorOf([&] {
              loadScene((root / "none").string());
            }).find("no .gltf, .glb, .scene.toml or .xml"),
            std::string::npos);
  EXPECT_NE(errorOf([&] { loadScene((root / "rom").string()); }).find("did you mean '"),
            std::string::npos);
}

TEST(LoadScene, SceneFolderOfTheEnvironment) {
  test::TempDirectory directory;
  directory.write("halls/nave/nave.gltf", kEmptyScene);
  const Variable variable("RESTLAB_SCENES", directory.path().string());
  EXPECT_EQ(loadScene("halls/nave").source, directory.path() / "halls/nave/nave.gltf");
  const std::string error = errorOf([] { loadScene("halls/nvae"); });
  EXPECT_NE(error.find("scene 'halls/nvae': neither a built-in scene nor a file"),
            std::string::npos)
      << error;
  EXPECT_NE(error.find("did you mean 'halls/nave'?"), std::string::npos) << error;
  const std::string bare = errorOf([] { loadScene("nave"); });
  EXPECT_NE(bare.find("did you mean 'halls/nave'?"), std::string::npos) << bare;
}

TEST(LoadScene, BuiltInNamesGoFirst) {
  ASSERT_FALSE(builtinSceneNames().empty());
  const std::string name = builtinSceneNames()[0];
  EXPECT_EQ(loadScene(name).name, name);
  std::string typo = name;
  std::swap(typo[0], typo[1]);
  EXPECT_NE(errorOf([&] { loadScene(typo); }).find("did you mean '" + name + "'?"),
            std::string::npos);
}

TEST(NearestName, FindsTyposOnly) {
  const std::vector<std::string> names = {"cornell", "gallery", "many-lights"};
  EXPECT_EQ(nearestName("cronell", names), "cornell");
  EXPECT_EQ(nearestName("Gallery", names), "gallery");
  EXPECT_EQ(nearestName("many", names), "many-lights");
  EXPECT_EQ(nearestName("teapot", names), "");
  EXPECT_EQ(didYouMean("cornel", names), "; did you mean 'cornell'?");
  EXPECT_EQ(didYouMean("xyz", names), "");
}

// A Radiance file of flat (not run-length coded) pixels, each R, G, B mantissas and an exponent.
std::string hdr(int width, int height, const std::string& pixels) {
  return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " +
         std::to_string(width) + "\n" + pixels;
}

TEST(Environment, ReadsHdr) {
  test::TempDirectory directory;
  // 128 x 2^(129 - 136) = 1, 64 -> 0.5, 0 -> 0; the second pixel is black.
  const std::string pixels("\x80\x40\x00\x81\x00\x00\x00\x00", 8);
  const EnvironmentMap map = loadEnvironment(directory.write("sky.hdr", hdr(2, 1, pixels)));
  ASSERT_EQ(map.width, 2u);
  ASSERT_EQ(map.height, 1u);
  EXPECT_EQ(map.radiance[0], glm::vec3(1, 0.5f, 0));
  EXPECT_EQ(map.radiance[1], glm::vec3(0));
  EXPECT_EQ(map.scale, 1.0f);
}

TEST(Environment, ReadsExrAndRefusesBadTexels) {
  test::TempDirectory directory;
  LayeredImage image;
  image.layers[""] = Image(4, 2, glm::vec3(0.25f, 2, 1e4f));
  const fs::path file = directory.path() / "sky.exr";
  writeExr(file, image);
  const EnvironmentMap map = loadEnvironment(file);
  EXPECT_EQ(map.radiance.at(7), glm::vec3(0.25f, 2, 1e4f));
  for (const float bad :
       {-1.0f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    image.layers[""].at(3, 1).y = bad;
    writeExr(file, image);
    EXPECT_NE(errorOf([&] { loadEnvironment(file); }).find("pixel (3, 1) is (0.25, "),
              std::string::npos);
  }
}

TEST(Environment, BadFiles) {
  test::TempDirectory directory;
  const std::string pixels(2 * 4, '\x7f');
  EXPECT_NE(errorOf([&] { loadEnvironment(directory.path() / "none.hdr"); }).find("no such file"),
            std::string::npos);
  EXPECT_NE(errorOf([&] { loadEnvironment(directory.path()); }).find("not a regular file"),
            std::string::npos);
  EXPECT_NE(errorOf([&] {
              loadEnvironment(directory.write("a.png", "x"));
            }).find(".hdr or .exr expected"),
            std::string::npos);
  EXPECT_NE(errorOf([&] {
              loadEnvironment(directory.write("a.hdr", "x"));
            }).find("not a Radiance HDR image"),
            std::string::npos);
  EXPECT_NE(errorOf([&] {
              loadEnvironment(directory.write("b.hdr", hdr(2, 2, pixels)));
            }).find("truncated"),
            std::string::npos);
  EXPECT_NE(errorOf([&] {
              loadEnvironment(directory.write("c.hdr", hdr(0, 1, pixels)));
            }).find("c.hdr: "),
            std::string::npos);
  EXPECT_NE(errorOf([&] {
              loadEnvironment(directory.write("d.hdr", hdr(20000, 1, pixels)));
            }).find("d.hdr: "),
            std::string::npos);
}

}  // namespace
}  // namespace restlab
