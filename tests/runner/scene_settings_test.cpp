// Settings in a [[scene]] override [settings]: frames, runs and camera path, with the lights of
// that path; and known truths for these settings.
#include <gtest/gtest.h>

#include <fstream>

#include "core/base/error.h"
#include "experiments/runner/reference/truth.h"
#include "experiments/runner/run/suite_check.h"
#include "tests/runner/temporary_folder.h"

namespace restlab {

namespace {

class SceneSettings : public TemporaryFolder {
 protected:
  Suite load(const std::string& text) const {
    const std::filesystem::path file = folder() / "suite.toml";
    std::ofstream(file) << text << "[[method]]\nname = \"path\"\n";
    return loadSuite(file, {});
  }
  std::string errorOf(const std::string& text) const {
    try {
      checkSuites({load(text)});
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::badUsage);
      return error.what();
    }
    return "";
  }
  // Returns one pixel of the exact image of the suite's only scene.
  float truthOf(const std::string& text) const {
    const Suite whole = load(text);
    const SuiteScene& scene = whole.scenes.front();
    ReferenceConfig config;
    config.width = config.height = 2;
    config.maxBounces = 1;
    const PreparedScene plain =
        plainOf(ofScene(whole, scene), scene, prepareScene(scene.request), config);
    return exactReference(scene.request, plain, config).mean.pixels[0].x;
  }
};

constexpr const char* kPathSuite =
    "[settings]\nwarmup_frames = 8\nruns = 3\nwidth = 8\nheight = 8\n"
    "[[camera_path]]\nname = \"turning\"\nkind = \"pan\"\ndegrees_per_frame = 1.0\n"
    "[[camera_path]]\nname = \"dimmed\"\nkind = \"still\"\n"
    "[[event]]\nframe = 6\nlight = \"all\"\nfactor = 0.25\ncamera_path = \"dimmed\"\n";

std::string sceneWith(const std::string& lines) {
  return std::string(kPathSuite) + "[[scene]]\nscene = \"furnace\"\ntruth = \"exact\"\n" + lines;
}

TEST_F(SceneSettings, WinOverTheSuites) {
  const Suite suite =
      load(sceneWith("warmup_frames = 20\nruns = 2\ncamera_path = \"turning\"\n"
                     "[[scene]]\nscene = \"cornell-box\"\n"));
  const Suite own = ofScene(suite, suite.scenes[0]), other = ofScene(suite, suite.scenes[1]);
  EXPECT_EQ(own.warmupFrames, 20u);
  EXPECT_EQ(own.runs, 2u);
  EXPECT_EQ(own.cameraPathName, "turning");
  EXPECT_EQ(own.cameraPath.kind, CameraPathKind::pan);
  EXPECT_TRUE(own.events.empty());
  EXPECT_EQ(other.warmupFrames, 8u);
  EXPECT_EQ(other.runs, 3u);
  EXPECT_EQ(other.cameraPathName, "still");
  EXPECT_FALSE(other.hasMovingCamera());
}

// Results keep what each scene's file said of its bounces, also that it said nothing.
TEST_F(SceneSettings, KeepTheBouncesOfTheirFiles) {
  const auto write = [&](const std::string& name, const std::string& text) {
    std::ofstream(folder() / name) << text;
    return folder() / name;
  };
  const std::string limit = "<integer name=\"max_depth\" value=\"3\"/>";
  const auto sceneOf = [](const std::string& inside) {
    return "<scene version=\"3.0.0\"><integrator type=\"path\">" + inside + "</integrator></scene>";
  };
  const auto bouncesOf = [](const Suite& suite) {
    std::vector<uint32_t> bounces;
    for (const SuiteScene& scene : suite.scenes)
      bounces.push_back(ofScene(suite, scene).maxBounces);
    return bounces;
  };
  write("limited.xml", sceneOf(limit));
  write("free.xml", sceneOf(""));
  const Suite first = load("scenes = [\"limited.xml\", \"free.xml\", \"furnace\"]\n");
  EXPECT_EQ(bouncesOf(first), (std::vector<uint32_t>{2, 8, 8}));
  write("limited.xml", sceneOf(""));
  write("free.xml", sceneOf(limit));
  const Suite again = loadSuite(write("again.toml", first.resolved), {});
  EXPECT_EQ(bouncesOf(again), bouncesOf(first));
  EXPECT_EQ(again.resolved, first.resolved);
  // Scenes that the table leaves out have the bounces of their files.
  const std::string scenes = "scenes = [\"limited.xml\", \"free.xml\"]\n[scene_bounces]\n";
  EXPECT_EQ(bouncesOf(load(scenes + "limited = 5\n")), (std::vector<uint32_t>{5, 2}));
  const std::string unknown = errorOf(scenes + "limitd = 5\n");
  EXPECT_NE(unknown.find("unknown key 'limitd', did you mean 'limited'?"), std::string::npos)
      << unknown;
}

TEST_F(SceneSettings, TakeThePathsLights) {
  const Suite suite = load(sceneWith("camera_path = \"dimmed\"\n"));
  const Suite own = ofScene(suite, suite.scenes[0]);
  ASSERT_EQ(own.events.size(), 1u);
  EXPECT_EQ(own.events[0].frame, 6u);
  EXPECT_TRUE(suite.events.empty());
}

TEST_F(SceneSettings, WrongOnesAreNamedAtTheirPlace) {
  const auto expectError = [&](const std::string& lines, const std::string& words) {
    const std::string line = errorOf(sceneWith(lines));
    EXPECT_NE(line.find(words), std::string::npos) << line;
  };
  expectError("camera_path = \"turnin\"\n",
              "suite.toml:21:15: no [[camera_path]] is named 'turnin'; did you mean 'turning'?");
  expectError("camera_path = \"dimmed\"\nwarmup_frames = 5\n",
              "suite.toml:14:9: 'frame' is 6: the frames from 5 ('warmup_frames') on are measured");
  expectError("runs = 0\n", "suite.toml:21:8: 'runs'");
  EXPECT_EQ(errorOf(sceneWith("camera_path = \"dimmed\"\nwarmup_frames = 6\n")), "");
}

TEST_F(SceneSettings, TruthIsOfTheMeasuredFrame) {
  EXPECT_EQ(truthOf(sceneWith("")), 0.75f);
  EXPECT_EQ(truthOf(sceneWith("camera_path = \"turning\"\n")), 0.75f);
  EXPECT_EQ(truthOf(sceneWith("camera_path = \"dimmed\"\n")), 0.25f * 0.75f);
}

TEST_F(SceneSettings, TruthKnowsWhereTheCameraIs) {
  const std::string away =
      "[[camera_path]]\nname = \"away\"\nkind = \"dolly\"\nmetres_per_frame = -1.0\n";
  const std::string outside = errorOf(sceneWith("camera_path = \"away\"\n") + away);
  EXPECT_NE(outside.find("suite.toml:20:9: 'truth' is \"exact\", but furnace has no exact image "
                         "from a camera outside the room"),
            std::string::npos)
      << outside;
  const std::string scaled = errorOf(
      std::string(kPathSuite) +
      "[[scene]]\nscene = \"furnace?scale=2\"\ntruth = \"exact\"\ncamera_path = \"turning\"\n");
  EXPECT_NE(scaled.find("without 'scale' and 'move'"), std::string::npos) << scaled;
}

}  // namespace

}  // namespace restlab
