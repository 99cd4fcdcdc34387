// Mitsuba's XML: includes, $names, references, places of errors, and files that are damaged.
#include "core/scene/mitsuba/document.h"

#include <gtest/gtest.h>

#include "core/scene/compiled/compiled_scene.h"
#include "tests/scene/mitsuba_builder.h"

namespace restlab {
namespace {

using test::rectangleWith;

class MitsubaDocument : public ::testing::Test {
 protected:
  test::MitsubaFolder folder_;
};

constexpr const char* kGrey = "<bsdf type=\"diffuse\" id=\"grey\"/>";

const glm::vec3& colorOfFirst(const Scene& scene) {
  return scene.materials.at(scene.instances.at(0).material).data.baseColor;
}

TEST_F(MitsubaDocument, NamesOfVersion06BecomeThoseOf3) {
  EXPECT_EQ(mitsuba::snakeCase("toWorld"), "to_world");
  EXPECT_EQ(mitsuba::snakeCase("intIOR"), "int_ior");
  EXPECT_EQ(mitsuba::snakeCase("fovAxis"), "fov_axis");
  EXPECT_EQ(mitsuba::snakeCase("alphaU"), "alpha_u");
  EXPECT_EQ(mitsuba::snakeCase("to_world"), "to_world");
  EXPECT_EQ(mitsuba::snakeCase("color0"), "color0");
}

TEST_F(MitsubaDocument, DefaultsGiveWayToWhatIsDefined) {
  const std::string body =
      "<default name=\"grey\" value=\"0.25\"/>" +
      rectangleWith("<bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\"$grey\"/></bsdf>");
  const Scene plain = folder_.load(body), given = folder_.load(body, "grey=0.75");
  EXPECT_EQ(colorOfFirst(plain), glm::vec3(0.25f));
  EXPECT_EQ(colorOfFirst(given), glm::vec3(0.75f));
  EXPECT_NE(plain.contentHash, given.contentHash);
  EXPECT_EQ(given.name, "x?grey=0.75");
  EXPECT_EQ(folder_.error(body, "gray=0.75"),
            "x.xml: no <default> and no '$' has the name 'gray' that is defined; did you mean "
            "'grey'?");
  EXPECT_EQ(folder_.error(rectangleWith("<float name=\"a\" value=\"$b\"/>")),
            "x.xml:2:25: '$b' has no value; <default name=\"b\" value=\"...\"/> above or --define "
            "b=... expected");
  EXPECT_EQ(folder_.error(body, "grey"), "x.xml?grey: must be NAME=VALUE, the value of a $NAME");
}

TEST_F(MitsubaDocument, IncludesAliasesAndReferences) {
  folder_.write("parts/grey.xml",
                "<scene version=\"3.0.0\"><bsdf type=\"diffuse\" id=\"grey\"><rgb "
                "name=\"reflectance\" value=\"0.125\"/></bsdf></scene>");
  const std::string body =
      "<include filename=\"parts/grey.xml\"/><alias id=\"grey\" as=\"wall\"/>" +
      rectangleWith("<ref id=\"wall\"/>");
  const Scene scene = folder_.load(body);
  EXPECT_EQ(colorOfFirst(scene), glm::vec3(0.125f));
  const uint64_t before = scene.contentHash;
  folder_.write("parts/grey.xml",
                "<scene version=\"3.0.0\"><bsdf type=\"diffuse\" id=\"grey\"><rgb "
                "name=\"reflectance\" value=\"0.125\"/></bsdf>\n</scene>");
  EXPECT_NE(folder_.load(body).contentHash, before) << "one more byte in what is included";
  EXPECT_EQ(folder_.error(body + kGrey).substr(0, 42),
            "x.xml:2:113: the id 'grey' is already that");
  EXPECT_EQ(folder_.error(rectangleWith("<ref id=\"gray\"/>") + kGrey),
            "x.xml:2:25: nothing has the id 'gray'; did you mean 'grey'?");
}

TEST_F(MitsubaDocument, WhatHoldsItselfIsRefused) {
  folder_.write("x2.xml", "<scene version=\"3.0.0\"><include filename=\"x.xml\"/></scene>");
  EXPECT_NE(folder_.error("<include filename=\"x2.xml\"/>").find("includes itself"),
            std::string::npos);
  const std::string loop =
      "<bsdf type=\"twosided\" id=\"a\"><ref id=\"b\"/></bsdf>"
      "<bsdf type=\"twosided\" id=\"b\"><ref id=\"a\"/></bsdf>";
  EXPECT_NE(folder_.error(loop + rectangleWith("<ref id=\"a\"/>")).find("BSDFs hold each other"),
            std::string::npos);
  std::string deep, end;
  for (int i = 0; i < 100; ++i) deep += "<bsdf type=\"twosided\">", end += "</bsdf>";
  EXPECT_NE(folder_.error(deep + end).find("nested deeper than 64 levels"), std::string::npos);
}

// Ten values that name the one before ten times: 10^10 bytes.
TEST_F(MitsubaDocument, ValuesThatGrowAreRefused) {
  std::string body = "<default name=\"a\" value=\"0123456789\"/>";
  for (char c = 'b'; c < 'l'; ++c) {
    body += std::string("<default name=\"") + c + "\" value=\"";
    for (int i = 0; i < 10; ++i) body += std::string("$") + char(c - 1) + " ";
    body += "\"/>";
  }
  EXPECT_NE(folder_.error(body).find("more than 16777216 bytes in all"), std::string::npos);
  // Entities are not expanded.
  EXPECT_NE(folder_
                .errorOfText("<!DOCTYPE a [<!ENTITY b \"&c;&c;\"><!ENTITY c \"dd\">]>\n"
                             "<scene version=\"&b;\"/>")
                .find("version '&b;' is unknown"),
            std::string::npos);
}

TEST_F(MitsubaDocument, DamagedFilesHaveAPlace) {
  EXPECT_EQ(folder_.errorOfText("<scene version=\"3.0.0\">\n<shape type=\"cube\">"),
            "y.xml:2:19: start-end tags mismatch; complete XML expected");
  EXPECT_NE(folder_.errorOfText("").find("no document element found"), std::string::npos);
  EXPECT_EQ(folder_.errorOfText("<mesh/>"),
            "y.xml:1:1: the root is <mesh>; <scene version=\"3.0.0\"> of Mitsuba expected");
  EXPECT_EQ(folder_.errorOfText("<scene/>"),
            "y.xml:1:1: <scene> has no version; version=\"3.0.0\" expected");
  EXPECT_EQ(folder_.error(kGrey, "", "4.0.0"),
            "x.xml:1:1: version '4.0.0' is unknown; 0.4.0 to 3.x.x expected");
  folder_.write("large.xml", std::string());
  std::filesystem::resize_file(folder_.path() / "large.xml", (uint64_t(256) << 20) + 1);
  EXPECT_NE(folder_.error("<include filename=\"large.xml\"/>").find("at most 268435456 expected"),
            std::string::npos);
  EXPECT_NE(folder_.error("<include filename=\"../a.xml\"/>").find("leaves the scene's folder"),
            std::string::npos);
  EXPECT_NE(folder_.error("<include filename=\"/etc/passwd\"/>").find("leaves the scene's folder"),
            std::string::npos);
  EXPECT_EQ(
      folder_.error("<shape type=\"obj\"><string name=\"filename\" value=\"x.xmk\"/></shape>"),
      "x.xml:2:1: file 'x.xmk' does not exist; did you mean 'x.xml'?");
}

TEST_F(MitsubaDocument, WhatIsUnknownIsAnErrorOrGrey) {
  const std::string body = rectangleWith("<bsdf type=\"velvet\"/>") + "<shape type=\"hair\"/>" +
                           "<emitter type=\"projector\"/>";
  EXPECT_EQ(folder_.error(body).substr(0, 44), "x.xml:2:25: bsdf 'velvet' is unknown; one of");
  EXPECT_NE(folder_.error("<shape type=\"hair\"/>").find("shape 'hair' is unknown"),
            std::string::npos);
  EXPECT_NE(folder_.error("<emitter type=\"projector\"/>").find("emitter 'projector' is unknown"),
            std::string::npos);
  EXPECT_NE(
      folder_.error(rectangleWith("<bsdf type=\"measured\"/>")).find("'measured' is not read"),
      std::string::npos);
  const Scene scene = folder_.load(body, "allow_unknown=1");
  EXPECT_EQ(colorOfFirst(scene), glm::vec3(0.5f));
  EXPECT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.warnings.size(), 3u);
  EXPECT_TRUE(test::warns(scene, "drawn as mid grey"));
}

TEST_F(MitsubaDocument, ParametersThatAreNotReadAreNamed) {
  const Scene scene = folder_.load(
      rectangleWith("<bsdf type=\"diffuse\"><float name=\"shininess\" value=\"3\"/></bsdf>"));
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(
      scene.warnings[0].find("x.xml:2:46: parameter 'shininess' of bsdf 'diffuse' is not read"),
      std::string::npos)
      << scene.warnings[0];
  EXPECT_NE(folder_
                .error(rectangleWith("<boolean name=\"flip_normals\" value=\"true\"/>"
                                     "<boolean name=\"flipNormals\" value=\"true\"/>"))
                .find("'flip_normals' is given twice"),
            std::string::npos);
}

// The file of the repository renders without a warning.
TEST_F(MitsubaDocument, TheExampleIsReadWhole) {
  const Scene scene =
      loadScene(std::string(RESTLAB_SOURCE_DIR) + "/experiments/scenes/mitsuba.xml");
  for (const std::string& warning : scene.warnings) ADD_FAILURE() << warning;
  EXPECT_EQ(scene.instances.size(), 13u);
  const auto compiled = CompiledScene::build(scene);
  for (const std::string& warning : compiled->warnings()) ADD_FAILURE() << warning;
  EXPECT_EQ(compiled->features() & rl::RL_FEATURE_CLOSURES,
            rl::RL_FEATURE_CLOSURE_OREN_NAYAR | rl::RL_FEATURE_CLOSURE_CONDUCTOR |
                rl::RL_FEATURE_CLOSURE_DISNEY | rl::RL_FEATURE_CLOSURE_MIXTURE);
}

}  // namespace
}  // namespace restlab
