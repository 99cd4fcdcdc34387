// Tests of measuring a saved session by `restlab run`, and of saving the picture as a file.
#include <gtest/gtest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "experiments/runner/suite/suite.h"
#include "experiments/view/picture_file.h"
#include "experiments/view/view_session.h"
#include "tests/view/loop_fixture.h"

namespace restlab::view_test {
namespace {

namespace fs = std::filesystem;

class MeasureTest : public ViewLoopTest {
 protected:
  static Json waitForEnd(Page& page) {
    return page.waitFor("measure", [](const Json& m) { return m["state"] != "running"; });
  }
  std::string textOf(const fs::path& file) const {
    std::ifstream is(folder() / file);
    return {std::istreambuf_iterator<char>(is), {}};
  }
};

TEST_F(MeasureTest, RunsTheSessionAndShowsItsReport) {
  facts_.program = program(
      "echo \"$@\" > words\n"
      "echo '{\"event\":\"progress\",\"of\":\"runs\",\"suite_done\":3,\"suite_total\":12,"
      "\"suite_left_s\":9}' >&2\n"
      "while [ ! -e go ]; do sleep 0.02; done\nmkdir -p \"$4\"\necho '<p>done' > "
      "\"$4/report.html\"");
  start();
  Page page(url());
  page.say({{"do", "measure"}, {"name", "my suite"}});
  Json said = page.waitFor("measure", [](const Json& m) { return m["done"] > 0.0; });
  EXPECT_EQ(said["state"], "running");
  EXPECT_EQ(said["done"], 0.25);
  EXPECT_EQ(said["text"], "runs 3 of 12, 9 s left");
  EXPECT_EQ(said["folder"], "results/my-suite");
  // During a measurement nothing renders and nothing can be changed.
  const auto framesOf = [&] {
    page.say({{"do", "save"}});
    page.waitFor("saved");
    Json last;
    for (int i = 0; i < 2; ++i) {
      Page other(url());
      last = other.waitFor("numbers");
    }
    return last["panes"][0]["frame"].get<int>();
  };
  const int before = framesOf();
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(framesOf(), before);
  page.say({{"do", "light"}, {"name", "all"}, {"factor", 2.0}});
  EXPECT_NE(page.waitFor("error")["text"].get<std::string>().find("cancel it first"),
            std::string::npos);
  page.say({{"do", "measure"}});
  EXPECT_NE(page.waitFor("error")["text"].get<std::string>().find("under way"), std::string::npos);
  // A page opened now is told of the measurement.
  EXPECT_EQ(Page(url()).waitFor("measure")["state"], "running");
  std::ofstream(folder() / "go") << "";
  said = waitForEnd(page);
  EXPECT_EQ(said["state"], "finished") << said;
  EXPECT_EQ(textOf("words"), "run my-suite.toml -o results/my-suite --json\n");
  EXPECT_EQ(loadSuite(folder() / "my-suite.toml", {}).name, "my-suite");
  page.waitFor("numbers", [&](const Json& n) { return n["panes"][0]["frame"] > before; });
  // A second measurement replaces nothing.
  page.say({{"do", "measure"}, {"name", "my suite"}});
  page.waitFor("measure", [](const Json& m) { return m["folder"] == "results/my-suite-2"; });
  EXPECT_EQ(loadSuite(folder() / "my-suite-2.toml", {}).name, "my-suite-2");
}

// `run` without -o derives the folder of results from the suite's name.
TEST_F(MeasureTest, NamesOfSuitesAreThoseOfTheirFiles) {
  fs::create_directories(folder() / "results" / "old");
  start();
  Page page(url());
  for (const char* name : {"a", "a-2", "old-2"}) {
    page.say({{"do", "save"}, {"name", *name == 'o' ? "old" : "a"}});
    EXPECT_EQ(page.waitFor("saved")["name"], std::string(name) + ".toml");
    EXPECT_EQ(loadSuite(folder() / (std::string(name) + ".toml"), {}).name, name);
  }
}

// The stored reference has the first seed; the suite can only use it with the same seed.
TEST_F(MeasureTest, SuitesHaveTheFirstSeedWhateverBeganAnew) {
  start();
  Page page(url());
  const auto savedSeed = [&](const char* name) {
    page.say({{"do", "save"}, {"name", name}});
    page.waitFor("saved");
    return loadSuite(folder() / (std::string(name) + ".toml"), {}).seed;
  };
  const uint32_t first = savedSeed("before");
  page.say({{"do", "restart"}});
  page.say({{"do", "restart"}});
  page.waitFor("state", [&](const Json& s) { return s["panes"][0]["seed"] > first; });
  EXPECT_EQ(savedSeed("after"), first);
}

TEST_F(MeasureTest, IsCancelled) {
  facts_.program = program("echo $$ > child\nexec sleep 100");
  start();
  Page page(url());
  page.say({{"do", "cancel"}});
  EXPECT_NE(page.waitFor("error")["text"].get<std::string>().find("nothing is measured"),
            std::string::npos);
  page.say({{"do", "measure"}});
  page.waitFor("measure");
  page.say({{"do", "cancel"}});
  const Json said = waitForEnd(page);
  EXPECT_EQ(said["state"], "cancelled");
  EXPECT_NE(said["text"].get<std::string>().find("goes on"), std::string::npos) << said;
  page.waitFor("numbers");
}

TEST_F(MeasureTest, EndsWithTheViewer) {
  facts_.program = program("echo $$ > child.new\nmv child.new child\nexec sleep 100");
  start();
  {
    Page page(url());
    page.say({{"do", "measure"}});
    page.waitFor("measure");
    while (!fs::exists(folder() / "child"))
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  stop();
  loop_.reset();
  EXPECT_NE(kill(pid_t(std::stoi(textOf("child"))), 0), 0) << "its run goes on";
}

TEST_F(MeasureTest, EndsWithAViewerThatIsKilled) {
  const fs::path run = program("echo $$ > child.new\nmv child.new child\nexec sleep 100");
  const pid_t viewer = fork();
  if (viewer == 0) {
    Measurement measurement;
    measurement.begin(run, folder(), "suite.toml", "out");
    for (;;) pause();
  }
  while (!fs::exists(folder() / "child")) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  kill(viewer, SIGKILL);
  waitpid(viewer, nullptr, 0);
  const auto isRunning = [&] {
    std::ifstream stat("/proc/" + std::to_string(std::stoi(textOf("child"))) + "/stat");
    std::string number, name, state;
    return (stat >> number >> name >> state) && state != "Z";
  };
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  while (isRunning() && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_FALSE(isRunning());
}

// Ignores the first SIGINT, like a run whose driver compiles a kernel.
TEST_F(MeasureTest, EndsByTheSecondSignalWhereTheFirstOneIsNotHeard) {
  const fs::path run = program(
      "trap 'trap - INT' INT\necho $$ > child.new\nmv child.new child\n"
      "while :; do sleep 100; done");
  {
    Measurement measurement;
    measurement.begin(run, folder(), "suite.toml", "out");
    while (!fs::exists(folder() / "child"))
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_NE(kill(pid_t(std::stoi(textOf("child"))), 0), 0) << "its run goes on";
}

TEST_F(MeasureTest, SaysWhyItFailed) {
  facts_.program =
      program("echo '{\"event\":\"error\",\"text\":\"no memory for that\"}' >&2\nexit 3");
  start();
  Page page(url());
  page.say({{"do", "measure"}});
  Json said = waitForEnd(page);
  EXPECT_EQ(said["state"], "failed");
  EXPECT_EQ(said["text"], "no memory for that");
}

// The suite's reference gets as many samples as the page's.
TEST_F(MeasureTest, TakesTheSamplesOfThePage) {
  const LiveView few(cornellBox(), {smallPane("restir_gi"), smallPane("path")}, {});
  EXPECT_NE(sessionToml(facts_, few, "a").find("spp = 256\n"), std::string::npos);
  LiveView many(cornellBox(), {smallPane("restir_gi"), smallPane("path")}, {});
  for (int i = 0; i < 300; ++i) many.refineReference();
  EXPECT_NE(sessionToml(facts_, many, "a").find("spp = 300\n"), std::string::npos);
}

TEST_F(MeasureTest, PicturesAreWhatWasRendered) {
  LiveView view(cornellBox(), {smallPane("restir_gi"), smallPane("path", "accumulate")}, {});
  EXPECT_THROW(pictureBytes(view, 0), Error);
  EXPECT_THROW(pictureBytes(view, 2), Error);
  for (int i = 0; i < 3; ++i) view.renderFrames();
  for (int i = 0; i < 4; ++i) view.refineReference();
  const auto read = [&](size_t image) {
    std::ofstream(folder() / "picture.exr", std::ios::binary) << pictureBytes(view, image);
    return readExr(folder() / "picture.exr");
  };
  const LayeredImage frame = read(0);
  EXPECT_EQ(frame.layers.at("").pixels, view.session(0).radiance().pixels) << "to the last bit";
  EXPECT_EQ(frame.metadata.at("frame"), "2");
  EXPECT_EQ(frame.metadata.at("integrator"), "restir_gi");
  EXPECT_EQ(frame.metadata.at("kind"), "image");
  EXPECT_EQ(frame.metadata.count("history"), 0u);
  EXPECT_EQ(pictureName(view, 0), "cornell-box-A-restir_gi-unbiased.exr");
  read(2);
  const Reference reference = readReference(folder() / "picture.exr");
  EXPECT_EQ(reference.mean.pixels, view.reference().mean().pixels);
  EXPECT_EQ(reference.half1->pixels, view.reference().half1().pixels);
  EXPECT_EQ(reference.spp, 4u);
  EXPECT_EQ(reference.metadata.at("kind"), "reference");
  view.apply(SetLight{"all", 2.0});
  view.renderFrames();
  EXPECT_EQ(read(0).metadata.count("history"), 1u);
}

}  // namespace
}  // namespace restlab::view_test
