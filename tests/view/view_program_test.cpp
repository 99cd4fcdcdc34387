// Tests of `restlab view` as a user runs it.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <thread>

#include "experiments/view/capture.h"
#include "experiments/view/server.h"
#include "experiments/view/view_exposure.h"
#include "experiments/view/view_session.h"
#include "tests/cli/program.h"
#include "tests/view/page.h"
#include "tests/view/tev_server.h"

namespace restlab::view_test {
namespace {

using cli_test::Circumstances;
using cli_test::ProgramResult;
using Clock = std::chrono::steady_clock;

class ViewProgramTest : public cli_test::ProgramTest {
 protected:
  // Returns the first line that the running program has printed; "" before that.
  std::string printedUrl() const {
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      const std::string name = entry.path().filename().string();
      if (name.rfind(".stdout", 0) != 0 || before_.count(name) > 0) continue;
      const std::string text = read(name);
      if (text.find('\n') != std::string::npos) return text.substr(0, text.find('\n'));
    }
    return "";
  }

  // Runs the viewer; sends `signal` once a page is open and `when` holds for it.
  ProgramResult view(int signal, std::vector<std::string> arguments,
                     const std::function<bool(Page&)>& when) {
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
      before_.insert(entry.path().filename().string());
    std::unique_ptr<Page> page;
    Circumstances circumstances;
    circumstances.signal = signal;
    circumstances.maxCpuS = 100.0;
    circumstances.signalWhen = [&] {
      if (printedUrl().empty()) return false;
      if (!page) page = std::make_unique<Page>(printedUrl());
      if (!when(*page)) return false;
      signalled_ = Clock::now();
      return true;
    };
    arguments.insert(arguments.begin(), "view");
    const ProgramResult result = run(arguments, circumstances);
    ended_ = Clock::now();
    return result;
  }

  double secondsToEnd() const { return std::chrono::duration<double>(ended_ - signalled_).count(); }

  Clock::time_point signalled_, ended_;
  std::set<std::string> before_;  // files of earlier programs
};

void expectEnded(const ProgramResult& result) {
  EXPECT_EQ(result.code, 130) << result.err;
  EXPECT_TRUE(result.errors().empty()) << "it is how everyone ends it: " << result.err;
  EXPECT_NE(result.err.find("interrupted: the viewer ends"), std::string::npos) << result.err;
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1) << result.out;
  EXPECT_EQ(result.out.rfind("http://127.0.0.1:", 0), 0u) << result.out;
}

TEST_F(ViewProgramTest, EndsInTheMiddleOfAFrame) {
  // The first round would take half an hour.
  std::optional<Clock::time_point> begun;
  const ProgramResult result =
      view(SIGTERM, {"furnace", "--resolution", "2048x2048", "--max-bounces", "1024"}, [&](Page&) {
        if (!begun) begun = Clock::now();
        return Clock::now() - *begun > std::chrono::milliseconds(1500);
      });
  expectEnded(result);
  EXPECT_LT(secondsToEnd(), 3.0);
}

TEST_F(ViewProgramTest, ShowsTheDefaultsAndKeepsTheReference) {
  const ProgramResult result = view(SIGINT, {}, [](Page& page) {
    const Json hello = page.waitFor("hello");
    EXPECT_EQ(hello["scene"]["name"], "door-ajar");
    const Json state = page.waitFor("state");
    EXPECT_EQ(state["panes"][0]["integrator"], "restir_gi");
    EXPECT_EQ(state["panes"][1]["integrator"], "path");
    EXPECT_EQ(state["panes"][1]["denoiser"], "accumulate");
    EXPECT_EQ(state["width"], 320);
    EXPECT_EQ(state["height"], 180);
    page.waitFor("numbers", [](const Json& n) { return n["reference"]["spp"] >= 2; });
    return true;
  });
  expectEnded(result);
  EXPECT_LT(secondsToEnd(), 3.0);
  EXPECT_FALSE(entries("cache/restlab/references").empty());
}

// Every user of the machine can read a program's arguments.
TEST_F(ViewProgramTest, OpensABrowserWithoutTellingTheSecret) {
  write("xdg-open",
        "#!/bin/sh\necho \"$@\" > words\nstat -c %a \"$1\" > mode\ncat \"$1\" > page.new\n"
        "mv page.new page\n");
  std::filesystem::permissions(path("xdg-open"), std::filesystem::perms::owner_all);
  const std::string before = std::getenv("PATH");
  setenv("PATH", (folder_.string() + ":" + before).c_str(), 1);
  setenv("XDG_RUNTIME_DIR", folder_.c_str(), 1);
  std::string url;
  expectEnded(view(SIGINT, {"cornell-box", "--resolution", "16x16", "--open"}, [&](Page&) {
    url = printedUrl();
    return std::filesystem::exists(path("page"));
  }));
  setenv("PATH", before.c_str(), 1);
  unsetenv("XDG_RUNTIME_DIR");
  const std::string words = read("words");
  EXPECT_EQ(words.find("token"), std::string::npos) << words;
  EXPECT_EQ(words.find(url.substr(url.find("token=") + 6)), std::string::npos) << words;
  EXPECT_EQ(read("mode"), "600\n");
  EXPECT_NE(read("page").find("content=\"0;url=" + url + "\""), std::string::npos) << read("page");
  EXPECT_FALSE(std::filesystem::exists(words.substr(0, words.size() - 1))) << "it is gone again";
}

// The command of a probe, run by a shell, prints the values that the page got; also for a suite's
// scene with blanks in its name and for changed parameters.
TEST_F(ViewProgramTest, ProbeIsThatOfItsCommand) {
  write("a scene/a triangle.gltf", cli_test::triangleGltf({0, 0, 0, 1, 0, 0, 0, 1, 0}));
  write("a scene/suite.toml",
        "[[scene]]\nscene = \"a triangle.gltf\"\n[settings]\nwidth = 20\nheight = 12\nseed = 4\n"
        "max_bounces = 3\n[[method]]\nintegrator = \"restir_gi\"\ncache = \"voxel\"\n"
        "[[method]]\nintegrator = \"path\"\ndenoiser = \"accumulate\"\n");
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"cornell-box", "--resolution", "20x12", "--seed", "7"},
        {path("a scene/suite.toml").string()}}) {
    std::vector<Json> probes;
    view(SIGINT, arguments, [&](Page& page) {
      page.say(
          {{"do", "parameter"}, {"pane", 0}, {"name", "roughness_limit"}, {"value", 0.1 + 0.2}});
      page.say({{"do", "parameter"}, {"pane", 0}, {"name", "confidence_cap"}, {"value", 2}});
      page.say({{"do", "restart"}});
      const Json state = page.waitFor("state", [](const Json& s) { return s["can_undo"]; });
      page.waitFor("numbers", [](const Json& n) { return n["panes"][0]["frame"] >= 8; });
      page.say({{"do", "pause"}, {"on", true}});
      page.waitFor("state", [](const Json& s) { return s["paused"]; });
      for (const int pane : {0, 1}) {
        page.say({{"do", "probe"}, {"pane", pane}, {"x", 6}, {"y", 7}});
        probes.push_back(page.waitFor("probe"));
      }
      return true;
    });
    ASSERT_EQ(probes.size(), 2u);
    for (const Json& probe : probes) {
      const std::string command = probe["command"];
      SCOPED_TRACE(command);
      const std::string line =
          "cd / && " + command + " --json >'" + path("pixel.json").string() + "'";
      ASSERT_EQ(std::system(line.c_str()), 0);
      const Json printed = Json::parse(read("pixel.json"));
      for (const char* key : {"x", "y", "frame", "seed", "values", "donors"})
        EXPECT_EQ(printed[key], probe[key]) << key;
    }
  }
}

TEST_F(ViewProgramTest, EndsWhileNobodyLooks) {
  Circumstances circumstances;
  circumstances.maxCpuS = 20.0;
  circumstances.signalWhen = [&] { return !printedUrl().empty(); };
  expectEnded(run("view cornell-box", circumstances));
}

// tev is missing, then appears, disappears and returns. Each change is reported once, and the
// viewer goes on.
TEST_F(ViewProgramTest, GoesOnWithoutTev) {
  const auto tev = std::make_unique<TevServer>(false);
  const std::string address = "127.0.0.1:" + std::to_string(tev->port());
  const ProgramResult result =
      view(SIGINT, {"cornell-box", "--resolution", "16x16", "--tev", address}, [&](Page& page) {
        const auto isOlder = [&](int frames) {
          page.say({{"do", "restart"}});
          page.waitFor("numbers", [&](const Json& n) { return n["panes"][0]["frame"] > frames; });
        };
        std::this_thread::sleep_for(std::chrono::milliseconds(2500));  // two attempts were made
        isOlder(3);
        EXPECT_TRUE(isSaid("--tev " + address + ": Connection refused"));
        tev->listen();
        tev->accept();
        EXPECT_EQ(tev->next()->operation, 4);
        isOlder(3);
        tev->hangUp();
        tev->accept();
        EXPECT_EQ(tev->next()->operation, 4) << "it is another one, which has no image yet";
        isOlder(3);
        return true;
      });
  EXPECT_EQ(result.code, 130) << result.err;
  EXPECT_LT(secondsToEnd(), 2.0);
  std::istringstream lines(result.err);
  std::vector<std::string> warnings;
  for (std::string line; std::getline(lines, line);)
    if (line.find("warning") != std::string::npos) warnings.push_back(line);
  ASSERT_EQ(warnings.size(), 2u) << result.err;
  EXPECT_NE(warnings[0].find("Connection refused; the viewer goes on"), std::string::npos);
  EXPECT_NE(warnings[1].find("the connection was lost; the viewer goes on"), std::string::npos);
}

// Returns a PNG without its texts, which contain the time.
std::string pictureOnly(const std::string& png) {
  std::string kept = png.substr(0, 8);
  for (size_t at = 8; at + 12 <= png.size();) {
    size_t length = 0;
    for (size_t i = 0; i < 4; ++i) length = length << 8 | uint8_t(png[at + i]);
    const std::string type = png.substr(at + 4, 4);
    if (type != "tEXt" && type != "iTXt") kept += png.substr(at, length + 12);
    at += length + 12;
  }
  return kept;
}

TEST_F(ViewProgramTest, CapturesWhatAPageWouldShow) {
  write("suite.toml",
        "scenes = [\"cornell-box\"]\n[settings]\nwidth = 100\nheight = 60\nmax_bounces = 3\n"
        "[[method]]\nintegrator = \"restir_gi\"\n"
        "[[method]]\nintegrator = \"path\"\ndenoiser = \"accumulate\"\n");
  const ProgramResult result = run("view suite.toml --capture a.png --frames 3 --reference-spp 8");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.out, "") << "there is no page";
  EXPECT_EQ(entries(".").size(), 2u) << "the suite and the picture, and no cache";
  const ViewStart start = startOfSuite(path("suite.toml"));
  LiveView view(start.prepared, start.settings, {});
  const Figure figure = capture(view, {3, 8});
  EXPECT_TRUE(pictureOnly(read("a.png")) == figurePng(figure));
  for (const char* word :
       {"Software", "restlab:scene", "A.integrator", "B.denoiser", "restlab:frame", "restlab:width",
        "restlab:max_bounces", "restlab:reference_spp"})
    EXPECT_NE(read("a.png").find(word), std::string::npos) << word;
  // Each picture has the rendered size and the exposure of a page.
  EXPECT_EQ(view.frames(0), 3u);
  EXPECT_EQ(view.reference().spp(), 8u);
  const std::vector<const Image*> images = {&view.session(0).radiance(),
                                            &view.session(1).radiance(), &view.reference().mean()};
  ASSERT_EQ(figure.pictures.size(), 3u);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(figure.pictures[i].picture.bytes,
              pictureOf(*images[i], {0, 0, 100, 60}, float(exposureOf(view)), 1).bytes);
    EXPECT_EQ(figure.texts[i].x, figure.pictures[i].x + 50.0);
    if (i == 0) continue;
    EXPECT_GE(figure.pictures[i].x, figure.pictures[i - 1].x + 100.0);
  }
  EXPECT_EQ(figure.texts[0].text.rfind("A: restir_gi", 0), 0u) << figure.texts[0].text;
  EXPECT_EQ(figure.texts[1].text.rfind("B: path", 0), 0u) << figure.texts[1].text;
  EXPECT_EQ(figure.texts[2].text, "reference, 8 spp");
}

TEST_F(ViewProgramTest, InterruptedCaptureLeavesNothing) {
  for (const char* what : {"--frames 100000000", "--reference-spp 1000000"}) {
    const auto begun = Clock::now();
    const ProgramResult result =
        runUntil([&] { return Clock::now() - begun > std::chrono::seconds(1); },
                 std::string("view door-ajar --resolution 64x36 --capture a.png ") + what);
    EXPECT_EQ(result.code, 130) << result.err;
    ASSERT_EQ(result.errors().size(), 1u) << result.err;
    EXPECT_NE(result.errors()[0].find("nothing was written"), std::string::npos) << result.err;
    for (const auto& entry : std::filesystem::directory_iterator(folder_))
      EXPECT_EQ(entry.path().filename().string().rfind(".std", 0), 0u) << entry.path();
  }
}

// Shows files, a folder of results and a session of images: nothing renders.
TEST_F(ViewProgramTest, ShowsImagesOfFiles) {
  write("suite.toml",
        "name = \"s\"\nscenes = [\"cornell-box\"]\n[settings]\nwidth = 16\nheight = 12\n"
        "max_bounces = 2\nruns = 2\nwarmup_frames = 1\nframes = 1\n[reference]\nspp = 4\n"
        "[[method]]\nname = \"the new: one\"\nintegrator = \"restir_gi\"\n"
        "[[method]]\nname = \"a path\"\nintegrator = \"path\"\n");
  const ProgramResult made = run("run suite.toml");
  ASSERT_EQ(made.code, 0) << made.err;
  const std::string images = "results/s/images/";
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(path(images)))
    if (entry.path().extension() == ".exr") files.push_back(entry.path().string());
  ASSERT_EQ(files.size(), 3u);
  std::sort(files.begin(), files.end());
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{path("results/s").string()},
        files,
        {path("session.toml").string()}}) {
    SCOPED_TRACE(arguments.front());
    const ProgramResult result = view(SIGINT, arguments, [&](Page& page) {
      const Json hello = page.waitFor("hello");
      EXPECT_EQ(hello["has_scene"], false);
      EXPECT_EQ(hello["has_reference"], true);
      Json names = Json::array();
      const Json state = page.waitFor("state");
      for (const Json& pane : state["panes"]) names.push_back(pane["source"]);
      const Json numbers = page.waitFor("numbers");
      EXPECT_GT(numbers["panes"][0]["mse"]["value"], 0.0);
      EXPECT_EQ(numbers["reference"]["spp"], 4);
      EXPECT_EQ(page.images().size(), 3u);
      if (arguments.size() == 1) {
        // As in the suite, with the times of the run.
        EXPECT_EQ(names, (Json{"the new: one", "a path"}));
        EXPECT_GT(numbers["panes"][1]["ms"], 0.0);
      }
      if (!std::filesystem::exists(path("session.toml"))) {
        page.say({{"do", "save"}});
        page.waitFor("saved");
      }
      return true;
    });
    expectEnded(result);
  }
  // Without a record they stand in the order of their names, and the page says why.
  write("results/s/run.json", "{}");
  expectEnded(view(SIGINT, {path("results/s").string()}, [&](Page& page) {
    const Json warnings = page.waitFor("hello")["warnings"];
    EXPECT_EQ(warnings.size(), 1u) << warnings;
    EXPECT_NE(warnings.dump().find("run.json: "), std::string::npos) << warnings;
    EXPECT_EQ(page.waitFor("state")["panes"][0]["source"], "a-path");
    page.waitFor("numbers");
    return true;
  }));
  const ProgramResult captured = run("view results/s --capture a.png");
  EXPECT_EQ(captured.code, 0) << captured.err;
  EXPECT_TRUE(std::filesystem::exists(path("a.png")));
}

// The command `measure` runs this program.
TEST_F(ViewProgramTest, MeasuresItsSession) {
  const ProgramResult result =
      view(SIGINT, {"cornell-box", "--resolution", "12x8", "--max-bounces", "2"}, [&](Page& page) {
        page.waitFor("numbers", [](const Json& n) { return n["reference"]["spp"] >= 2; });
        page.say({{"do", "measure"}, {"name", "box"}});
        const Json end =
            page.waitFor("measure", [](const Json& m) { return m["state"] != "running"; });
        EXPECT_EQ(end["state"], "finished") << end;
        return true;
      });
  expectEnded(result);
  EXPECT_NE(read("results/box/report.html").find("<html"), std::string::npos);
  EXPECT_NE(read("results/box/table.md").find("restir_gi (unbiased)"), std::string::npos);
}

TEST_F(ViewProgramTest, SaysWhatIsWrongInOneLine) {
  const ViewServer taken({},
                         {[](ClientId) {}, [](ClientId) {}, [](ClientId, const std::string&) {}});
  const auto port = std::to_string(taken.port());
  write("suite.toml", "scenes = [\"cornell-box\"]\n[[method]]\nintegrator = \"pth\"\n");
  const std::pair<std::string, std::vector<std::string>> cases[] = {
      {"view cornell-box --resolution 8x8 --port " + port, {"--port " + port, "is taken"}},
      {"view cornell-box --resolution 8x8 --listen everywhere", {"--listen everywhere"}},
      {"view cornell-box --integrator pth", {"'path'"}},
      {"view cornell-box --b-denoiser acumulate", {"'accumulate'"}},
      {"view cornell-box --b-set foo=1", {"error: --b-set foo=1: ", "'foo'"}},
      {"view cornell-box --b-set accumulate_cap=-1", {"error: --b-set accumulate_cap=-1"}},
      {"view cornell-box --resolution 8x8 --listen 192.0.2.1",
       {"--listen 192.0.2.1: is no address of this machine", "127.0.0.1"}},
      {"view cornell-box --set confidence_cup=3", {"confidence_cap"}},
      {"view suite.toml", {"suite.toml:3", "'path'"}},
      {"view suite.toml --seed 3", {"--seed", "suite"}},
      {"view cornell-box --port 70000", {"70000"}},
      {"view cornell-box --capture a.exr", {"--capture a.exr", "*.png"}},
      {"view suite.toml --capture a.exr", {"--capture a.exr", "*.png"}},
      {"view cornell-box --capture a.png --port 80", {"--capture", "--port"}},
      {"view cornell-box --tev :80", {"--tev :80", "HOST:PORT"}},
      {"view cornell-box --tev here:99999", {"--tev here:99999", "65535"}},
      {"view cornell-box --tev here --capture a.png", {"--capture", "--tev"}},
      {"view cornell-box --frames 3", {"--frames", "--capture"}},
      {"view cornell-box --capture a.png --reference-spp 1", {"from 2"}},
      {"view cornell-box --capture a.png --resolution 16384x16384",
       {"49152x16384", "--resolution"}},
  };
  for (const auto& [arguments, says] : cases) {
    SCOPED_TRACE(arguments);
    cli_test::expectError(run(arguments), 2, says);
  }
  cli_test::expectError(run("view nowhere.gltf"), 3, {"nowhere.gltf"});
  for (const auto& [name, width] : {std::pair("a.exr", 8u), {"b.exr", 9u}})
    writeExr(path(name), {{{"", Image(width, 8, glm::vec3(1.0f))}}, {}});
  std::filesystem::create_directory(path("empty"));
  const std::pair<std::string, std::vector<std::string>> images[] = {
      {"view a.exr b.exr", {"b.exr: is 9x8", "a.exr is 8x8"}},
      {"view a.exr none.exr", {"none.exr"}},
      {"view a.exr --ref b.exr", {"b.exr: is 9x8"}},
      {"view empty", {"empty: has no images of `restlab run`"}},
      {"view cornell-box a.exr --resolution 16x16", {"a.exr: is 8x8", "16x16"}},
  };
  for (const auto& [arguments, says] : images) {
    SCOPED_TRACE(arguments);
    cli_test::expectError(run(arguments), 3, says);
  }
  cli_test::expectError(run("view a.exr --integrator path"), 2, {"--integrator", "images"});
  cli_test::expectError(run("view empty --ref a.exr"), 2, {"--ref", "folder of results"});
  cli_test::expectError(run("view cornell-box --ref a.exr"), 2, {"--ref"});
  cli_test::expectError(run("view suite.toml a.exr"), 2, {"images", "suite"});
}

}  // namespace
}  // namespace restlab::view_test
