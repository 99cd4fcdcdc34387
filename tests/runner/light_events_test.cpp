// [[event]] of suites: parsing, errors, the scene of each frame, and the part in keys.
#include "experiments/runner/suite/light_events.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "core/base/error.h"
#include "core/scene/compiled/light_factor.h"
#include "experiments/runner/run/job.h"
#include "experiments/runner/suite/suite.h"
#include "tests/runner/temporary_folder.h"

namespace restlab {

namespace {

constexpr const char* kPaths =
    "[[camera_path]]\nname = \"lamp switched\"\nkind = \"still\"\n"
    "[[camera_path]]\nname = \"orbit\"\nkind = \"orbit\"\ndegrees_per_frame = 1.0\n";

std::string eventOf(int frame, const std::string& light, double factor,
                    const std::string& path = "") {
  std::string text = "[[event]]\nframe = " + std::to_string(frame) + "\nlight = \"" + light +
                     "\"\nfactor = " + std::to_string(factor) + "\n";
  if (!path.empty()) text += "camera_path = \"" + path + "\"\n";
  return text;
}

class LightEventsTest : public TemporaryFolder {
 protected:
  Suite load(const std::string& events, const std::string& settings = "",
             const std::string& path = "still") const {
    const std::filesystem::path file = folder() / "suite.toml";
    std::ofstream(file) << "scenes = [\"glossy-gallery\"]\n[settings]\nwarmup_frames = 8\n"
                        << "camera_path = \"" << path << "\"\n"
                        << settings << kPaths << events
                        << "[[method]]\nname = \"gi\"\nintegrator = \"restir_gi\"\n"
                           "[[method]]\nname = \"path\"\n"
                           "[[method]]\nname = \"average\"\ndenoiser = \"accumulate\"\n";
    return loadSuite(file, {});
  }
  std::string errorOf(const std::string& events, const std::string& settings = "") const {
    try {
      load(events, settings);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::badUsage);
      const std::string text = error.what();
      return text.substr(text.find("suite.toml"));
    }
    return "";
  }
  static PreparedScene gallery() {
    SceneRequest request;
    request.scene = "glossy-gallery";
    return prepareScene(request);
  }
};

TEST_F(LightEventsTest, AreThoseOfTheCameraPathByFrame) {
  const std::string events = eventOf(6, "light-left", 0.5) + eventOf(2, "all", 0, "lamp switched") +
                             eventOf(3, "light-left", 0, "orbit");
  const Suite still = load(events), lamp = load(events, "", "lamp switched");
  ASSERT_EQ(still.events.size(), 1u);
  EXPECT_EQ(still.events[0].frame, 6u);
  EXPECT_EQ(still.events[0].light, "light-left");
  EXPECT_EQ(still.events[0].factor, 0.5);
  ASSERT_EQ(lamp.events.size(), 2u);
  EXPECT_EQ(lamp.events[0].light, "all");
  EXPECT_EQ(lamp.events[1].frame, 6u);
  EXPECT_EQ(eventsText(lamp.events, 8), "all x0 from frame 2, light-left x0.5 from frame 6");
  EXPECT_EQ(eventsText(lamp.events, 5), "all x0 from frame 2");
  EXPECT_EQ(eventsText(lamp.events, 1), "");
  EXPECT_TRUE(load("").events.empty());
}

TEST_F(LightEventsTest, ErrorsNameThePlace) {
  const auto expect = [&](const std::string& text, const std::vector<std::string>& parts) {
    EXPECT_EQ(text.find('\n'), std::string::npos);
    for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  expect(errorOf("[[event]]\nframe = 1\nlight = \"all\"\n"), {"suite.toml:12:1", "'factor'"});
  expect(errorOf(eventOf(1, "all", -1.0)), {"suite.toml:15:10", "factor"});
  expect(errorOf(eventOf(-1, "all", 1.0)), {"suite.toml:13:9", "frame"});
  expect(errorOf(eventOf(9, "all", 1.0)), {"suite.toml:13:9", "'frame' is 9", "at 8"});
  expect(errorOf(eventOf(1, "all", 0.0) + "fram = 3\n"), {"suite.toml:16:1", "'fram'", "'frame'"});
  expect(errorOf(eventOf(1, "all", 0.0, "orbt")), {"suite.toml:16:15", "'orbt'", "'orbit'"});
  expect(errorOf(eventOf(1, "all", 0.0) + eventOf(1, "all", 1.0)),
         {"suite.toml:16:1", "two events"});
  expect(errorOf(eventOf(1, "all", 0.0) + eventOf(1, "all", 1.0, "orbit")), {"two events"});
  EXPECT_EQ(errorOf(eventOf(1, "all", 0.0, "still") + eventOf(1, "all", 1.0, "orbit")), "");
  EXPECT_EQ(errorOf(eventOf(1, "all", 0.0) + eventOf(1, "light-left", 1.0)), "");
  // `accumulate` rejects changing light, but accepts a lamp that is off from the first frame on.
  expect(errorOf(eventOf(1, "all", 0.0), "accumulate = true\n"),
         {"suite.toml:5:14", "'accumulate'", "all x0 from frame 1"});
  EXPECT_EQ(errorOf(eventOf(0, "light-left", 0.0), "accumulate = true\n"), "");
}

TEST_F(LightEventsTest, AgesCountFromTheSwitch) {
  EXPECT_EQ(load("", "ages = [1, 8]\n").frameOfAge(1), 0u);
  const Suite suite = load(eventOf(2, "all", 0.5) + eventOf(5, "all", 1.0), "ages = [1, 8]\n");
  EXPECT_EQ(suite.frameOfAge(1), 5u);
  EXPECT_EQ(suite.frameOfAge(8), 12u);
  EXPECT_NE(errorOf(eventOf(5, "all", 0.5), "ages = [1, 12]\n").find("frame 16"),
            std::string::npos);
}

TEST_F(LightEventsTest, AnUnknownLightIsFoundInTheScene) {
  const Suite suite = load(eventOf(2, "light-lft", 0.0));
  try {
    lightPhases(suite, gallery());
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    const std::string text = error.what();
    for (const char* part : {"suite.toml:14:9", "'light-lft'", "did you mean 'light-left'"})
      EXPECT_NE(text.find(part), std::string::npos) << text;
  }
}

TEST_F(LightEventsTest, AFrameShowsTheLightOfItsPhase) {
  const PreparedScene loaded = gallery();
  EXPECT_TRUE(lightPhases(load(""), loaded).empty());
  EXPECT_EQ(&sceneAt({}, loaded, 5), &loaded);
  const auto phases = lightPhases(
      load(eventOf(0, "all", 0.5) + eventOf(3, "all", 0.0) + eventOf(3, "light-left", 1.0) +
           eventOf(5, "all", 1.0) + eventOf(6, "all", 0.5)),
      loaded);
  const auto factors = [&](uint32_t frame) {
    std::vector<float> all = lightFactors(sceneAt(phases, loaded, frame).scene->source());
    return std::set<float>(all.begin(), all.end());
  };
  EXPECT_EQ(factors(0), (std::set<float>{0.5f, 1.0f})) << "what shines not has no factor";
  EXPECT_EQ(factors(2), (std::set<float>{0.5f, 1.0f}));
  EXPECT_EQ(factors(3), (std::set<float>{0.0f, 1.0f})) << "light-left comes after all";
  EXPECT_EQ(factors(5), (std::set<float>{})) << "as loaded";
  EXPECT_EQ(sceneAt(phases, loaded, 5).scene, loaded.scene);
  EXPECT_EQ(sceneAt(phases, loaded, 7).scene, sceneAt(phases, loaded, 1).scene) << "compiled once";
}

TEST_F(LightEventsTest, KeysHoldTheLight) {
  const PreparedScene loaded = gallery();
  const auto phases = lightPhases(
      load(eventOf(2, "all", 0.5) + eventOf(4, "light-left", 0.0) + eventOf(6, "all", 1.0)),
      loaded);
  ReferenceConfig config;
  config.width = config.height = 8;
  std::set<std::string> keys;
  for (const uint32_t frame : {0u, 2u, 4u})
    EXPECT_TRUE(keys.insert(referenceKey(sceneAt(phases, loaded, frame), config)).second) << frame;
  EXPECT_EQ(referenceKey(sceneAt(phases, loaded, 6), config), referenceKey(loaded, config));
  SessionConfig session;
  EXPECT_EQ(describe(sceneAt(phases, loaded, 2), session).at("lights"), "all x0.5 from frame 2");
  EXPECT_FALSE(describe(sceneAt(phases, loaded, 6), session).contains("lights"));
  // A job's key includes events of every frame, not only of the measured one.
  BlockResult block;
  block.width = block.height = 8;
  const auto key = [&](const std::string& events) {
    return jobIdentity(load(events), loaded, block, 0, buildInfo(), "reference", {}).key();
  };
  EXPECT_EQ(key(eventOf(2, "all", 0.5)), key(eventOf(2, "all", 0.5)));
  EXPECT_NE(key(""), key(eventOf(2, "all", 0.5)));
  EXPECT_NE(key(eventOf(2, "all", 0.25)), key(eventOf(2, "all", 0.5)));
  EXPECT_NE(key(eventOf(3, "all", 0.5)), key(eventOf(2, "all", 0.5)));
  EXPECT_NE(key(eventOf(2, "light-left", 0.5)), key(eventOf(2, "all", 0.5)));
}

// Any history under changing light is biased, however it is weighted.
TEST_F(LightEventsTest, HistoriesAreBiasedByThem) {
  const auto biases = [&](const std::string& events) {
    const Suite suite = load(events);
    std::vector<BiasClass> all;
    for (const SuiteMethod& method : suite.methods) all.push_back(method.bias(suite));
    return all;
  };
  const BiasClass unbiased = BiasClass::unbiased, biased = BiasClass::biased;
  EXPECT_EQ(biases(""), biases(eventOf(0, "all", 0.5))) << "no light of the history is another";
  EXPECT_EQ(biases("")[0], unbiased);
  EXPECT_EQ(biases("")[2], unbiased);
  EXPECT_EQ(biases(eventOf(2, "all", 0.5)), (std::vector<BiasClass>{biased, unbiased, biased}));
}

}  // namespace

}  // namespace restlab
