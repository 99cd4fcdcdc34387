// Camera paths as TOML: parsed values, and the line of every error.
#include <gtest/gtest.h>

#include <numbers>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/scene/camera_path/camera_path.h"

namespace restlab {

namespace {

CameraPath parse(const std::string& text) {
  return parseCameraPath(ConfigTable::parseText(text, "a.toml").getTable("path"));
}

CameraPath parseInline(const std::string& keys) { return parse("path = { " + keys + " }"); }

TEST(CameraPathConfig, Kinds) {
  EXPECT_EQ(parseInline("kind = \"still\"").kind, CameraPathKind::still);

  const CameraPath orbit = parseInline("kind = \"orbit\", degrees_per_frame = -0.5");
  EXPECT_EQ(orbit.kind, CameraPathKind::orbit);
  EXPECT_EQ(orbit.degreesPerFrame, -0.5);
  EXPECT_FALSE(orbit.targetW.has_value());
  EXPECT_EQ(orbit.place, "a.toml:1:8");
  EXPECT_EQ(*parseInline("kind = \"orbit\", degrees_per_frame = 1, target = [1, 2.5, -3]").targetW,
            glm::dvec3(1, 2.5, -3));

  const CameraPath dolly = parseInline("kind = \"dolly\", metres_per_frame = 0.02");
  EXPECT_EQ(dolly.kind, CameraPathKind::dolly);
  EXPECT_EQ(dolly.metresPerFrame, 0.02);

  const CameraPath pan = parseInline("kind = \"pan\", degrees_per_frame = 2");
  EXPECT_EQ(pan.kind, CameraPathKind::pan);
  EXPECT_EQ(pan.degreesPerFrame, 2.0);
  EXPECT_EQ(pan.about, CameraAxis::scene);
  EXPECT_EQ(parseInline("kind = \"pan\", degrees_per_frame = 2, about = \"camera\"").about,
            CameraAxis::camera);
  EXPECT_EQ(parseInline("kind = \"orbit\", degrees_per_frame = 2, about = \"world\"").about,
            CameraAxis::y);
  EXPECT_EQ(parseInline("kind = \"back\", frame = 24, about = \"z\"").about, CameraAxis::z);

  const CameraPath cut = parseInline("kind = \"cut\", frame = 12, camera = \"back\"");
  EXPECT_EQ(cut.kind, CameraPathKind::cut);
  EXPECT_EQ(cut.cutFrame, 12u);
  EXPECT_EQ(cut.cutCamera, "back");
  const CameraPath jump = parseInline("kind = \"cut\", frame = 0, degrees = 30, target = [0,0,1]");
  EXPECT_EQ(jump.cutCamera, "");
  EXPECT_EQ(jump.cutDegrees, 30.0);
  EXPECT_EQ(*jump.targetW, glm::dvec3(0, 0, 1));

  const CameraPath back = parseInline("kind = \"back\", frame = 24, leave = 16, degrees = 90");
  EXPECT_EQ(back.leaveFrame, 16u);
  EXPECT_EQ(back.cutFrame, 24u);
  EXPECT_EQ(parseInline("kind = \"back\", frame = 24").leaveFrame, 0u);
}

TEST(CameraPathConfig, Keyframes) {
  const CameraPath path = parse(R"([path]
kind = "keyframes"
[[path.keyframe]]
frame = 0
camera = "main"
[[path.keyframe]]
frame = 60
position = [1, 2, 3]
target = [0, 1, 0.5]
yfov_degrees = 45
)");
  EXPECT_EQ(path.kind, CameraPathKind::keyframes);
  ASSERT_EQ(path.keyframes.size(), 2u);
  EXPECT_EQ(path.keyframes[0].camera, "main");
  EXPECT_FALSE(path.keyframes[0].yfov.has_value());
  EXPECT_EQ(path.keyframes[1].frame, 60u);
  EXPECT_EQ(path.keyframes[1].camera, "");
  EXPECT_EQ(path.keyframes[1].positionW, glm::dvec3(1, 2, 3));
  EXPECT_EQ(path.keyframes[1].targetW, glm::dvec3(0, 1, 0.5));
  EXPECT_NEAR(*path.keyframes[1].yfov, std::numbers::pi / 4.0, 1e-15);
  EXPECT_EQ(path.keyframes[1].place, "a.toml:6:1");
}

TEST(CameraPathConfig, KeysThatTheCallerAskedForAreHis) {
  const ConfigTable table =
      ConfigTable::parseText("[path]\nname = \"walk\"\nkind = \"dolly\"\nmetres_per_frame = 1",
                             "a.toml")
          .getTable("path");
  EXPECT_EQ(table.getString("name", ""), "walk");
  EXPECT_EQ(parseCameraPath(table).metresPerFrame, 1.0);
}

struct Wrong {
  const char* text;
  const char* message;
};

TEST(CameraPathConfig, CamerasByIndexAreNumbersOrStrings) {
  for (const char* camera : {"1", "\"1\""}) {
    const std::string key = std::string(", camera = ") + camera;
    EXPECT_EQ(parseInline("kind = \"cut\", frame = 12" + key).cutCamera, "1");
    EXPECT_EQ(parseInline("kind = \"keyframes\", keyframe = [{ frame = 0" + key + " }]")
                  .keyframes[0]
                  .camera,
              "1");
  }
}

TEST(CameraPathConfig, EveryErrorIsOneLineWithItsPlace) {
  const std::vector<Wrong> all = {
      {"path = {}",
       "a.toml:1:8: a camera path needs a 'kind' (still, orbit, dolly, pan, cut, back, "
       "keyframes)"},
      {"path = { kind = \"orbt\" }", "a.toml:1:17: unknown kind 'orbt', did you mean 'orbit'?"},
      {"path = { kind = 3 }", "a.toml:1:17: 'kind' must be a string, not an integer"},
      {"path = { kind = \"orbit\" }",
       "a.toml:1:8: a camera path of the kind 'orbit' needs 'degrees_per_frame'"},
      {"path = { kind = \"dolly\" }",
       "a.toml:1:8: a camera path of the kind 'dolly' needs 'metres_per_frame'"},
      {"path = { kind = \"orbit\", degrees_per_frame = 200 }",
       "a.toml:1:46: 'degrees_per_frame' must be in -180..180, not 200"},
      {"path = { kind = \"pan\", degrees_per_frame = nan }",
       "a.toml:1:44: 'degrees_per_frame' must be in -180..180, not nan"},
      {"path = { kind = \"pan\", degree_per_frame = 1, degrees_per_frame = 1 }",
       "a.toml:1:24: unknown key 'degree_per_frame', did you mean 'degrees_per_frame'?"},
      {"path = { kind = \"still\", degrees_per_frame = 1 }",
       "a.toml:1:26: unknown key 'degrees_per_frame' (known: 'about', 'kind')"},
      {"path = { kind = \"pan\", degrees_per_frame = 1, about = \"up\" }",
       "a.toml:1:55: unknown about 'up' (known: 'scene', 'camera', 'world', 'x', 'y', 'z')"},
      {"path = { kind = \"orbit\", degrees_per_frame = 1, target = [1, 2] }",
       "a.toml:1:58: 'target' must be an array of 3 numbers"},
      {"path = { kind = \"orbit\", degrees_per_frame = 1, target = 7 }",
       "a.toml:1:58: 'target' must be an array of 3 numbers"},
      {"path = { kind = \"orbit\", degrees_per_frame = 1, target = [1, \"x\", 3] }",
       "a.toml:1:62: 'target' must hold numbers in -1000000000..1000000000"},
      {"path = { kind = \"orbit\", degrees_per_frame = 1, target = [1, inf, 3] }",
       "a.toml:1:62: 'target' must hold numbers in -1000000000..1000000000"},
      {"path = { kind = \"cut\", camera = \"x\" }",
       "a.toml:1:8: a camera path of the kind 'cut' needs 'frame'"},
      {"path = { kind = \"cut\", frame = 2 }",
       "a.toml:1:8: a cut needs either 'camera' or 'degrees' (of an orbit), and not both"},
      {"path = { kind = \"cut\", frame = 2, camera = \"x\", degrees = 3 }",
       "a.toml:1:59: a cut needs either 'camera' or 'degrees' (of an orbit), and not both"},
      {"path = { kind = \"cut\", frame = 2, camera = \"x\", target = [1, 2, 3] }",
       "a.toml:1:58: a cut to another camera has no 'target'"},
      {"path = { kind = \"cut\", frame = 2, camera = \"\" }", "a.toml:1:44: 'camera' is empty"},
      {"path = { kind = \"cut\", frame = 2, camera = -1 }",
       "a.toml:1:44: 'camera' must be a string, not an integer"},
      {"path = { kind = \"cut\", frame = -1, camera = \"x\" }",
       "a.toml:1:32: 'frame' must be in 0..2147483648, not -1"},
      {"path = { kind = \"keyframes\" }",
       "a.toml:1:8: a camera path of the kind 'keyframes' needs [[keyframe]]"},
      {"path = { kind = \"keyframes\", keyframe = 3 }",
       "a.toml:1:41: 'keyframe' must be written as [[keyframe]]"},
      {"path = { kind = \"keyframes\", keyframe = [{ camera = \"x\" }] }",
       "a.toml:1:42: a keyframe needs 'frame'"},
      {"path = { kind = \"keyframes\", keyframe = [{ frame = 1 }] }",
       "a.toml:1:42: a keyframe needs either 'camera' or 'position' and 'target', and not both"},
      {"path = { kind = \"keyframes\", keyframe = [{ frame = 1, camera = \"x\", target = [1,2,3] "
       "}] }",
       "a.toml:1:64: a keyframe needs either 'camera' or 'position' and 'target', and not both"},
      {"path = { kind = \"keyframes\", keyframe = [{ frame = 1, position = [1,2,3] }] }",
       "a.toml:1:42: a keyframe without 'camera' needs 'target'"},
      {"path = { kind = \"keyframes\", keyframe = [{ frame = 1, target = [1,2,3] }] }",
       "a.toml:1:42: a keyframe without 'camera' needs 'position'"},
      {"path = { kind = \"keyframes\", keyframe = [{ frame = 1, camera = \"x\", yfov_degrees = 180 "
       "}] }",
       "a.toml:1:84: 'yfov_degrees' must be in 0.01..179, not 180"},
      {"path = { kind = \"keyframes\", keyframe = [{ frame = 1, camera = \"x\", yfov = 1 }] }",
       "a.toml:1:69: unknown key 'yfov', did you mean 'yfov_degrees'?"},
      {"[path]\nkind = \"keyframes\"\n[[path.keyframe]]\nframe = 9\ncamera = \"x\"\n"
       "[[path.keyframe]]\nframe = 9\ncamera = \"y\"\n",
       "a.toml:7:9: frame 9 comes after frame 9: keyframes stand in the order of their frames"},
  };
  for (const Wrong& wrong : all) {
    try {
      parse(wrong.text);
      ADD_FAILURE() << wrong.text << ": nothing was thrown";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::badUsage);
      EXPECT_EQ(std::string(error.what()), wrong.message) << wrong.text;
    }
  }
}

}  // namespace

}  // namespace restlab
