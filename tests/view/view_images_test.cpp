// Panes that show images of files or the reference.
#include "experiments/view/view_images.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/image/metrics/metrics.h"
#include "experiments/view/view_session.h"
#include "tests/view/loop_fixture.h"

namespace restlab::view_test {
namespace {

namespace fs = std::filesystem;

Image imageOf(uint32_t width, uint32_t height, float value) {
  Image image(width, height, glm::vec3(value));
  image.pixels.front() = {2.0f * value, 0.0f, 0.1f};
  return image;
}

class ViewImagesTest : public ViewLoopTest {
 protected:
  fs::path write(const std::string& name, const Image& image, const std::string& kind = "image") {
    const fs::path file = folder() / name;
    fs::create_directories(file.parent_path());
    writeExr(file, {{{"", image}}, {{"kind", kind}}});
    return file;
  }

  // Returns two images and a reference with halves, 24x16.
  ViewImages small() {
    LayeredImage reference;
    reference.layers[""] = imageOf(24, 16, 1.0f);
    reference.layers["half0"] = imageOf(24, 16, 0.9f);
    reference.layers["half1"] = imageOf(24, 16, 1.1f);
    reference.metadata = {{"kind", "reference"}, {"spp", "64"}};
    writeExr(folder() / "r.exr", reference);
    write("a.exr", imageOf(24, 16, 0.5f));
    write("b.exr", imageOf(24, 16, 0.8f));
    return readViewImages({folder() / "a.exr", folder() / "r.exr", folder() / "b.exr"});
  }

  // Writes the images of two tables, without a record of the run.
  void writeTables() {
    for (const char* name : {"box-all-reference", "box-all-path", "box-all-gi-2"})
      write(std::string("images/") + name + ".exr", imageOf(8, 6, 1.0f));
    for (const char* name : {"box-all-2-reference", "box-all-2-path"})
      write(std::string("images/") + name + ".exr", imageOf(4, 3, 1.0f));
  }

  void showImages(ViewImages images) {
    const ViewSettings settings = settingsOf(images);
    view_.emplace(std::move(images), settings);
    loop_ = std::make_unique<ViewLoop>(*view_, facts_, ViewServerOptions{}, folder());
    thread_ = std::thread([this] { loop_->run(); });
  }

  static std::string lineOf(const std::function<void()>& step, ExitCode code) {
    try {
      step();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code) << error.what();
      return error.what();
    }
    ADD_FAILURE() << "nothing is refused";
    return "";
  }
};

ViewCommand shows(uint32_t pane, const std::string& source) {
  return SetSetting{pane, "source", source};
}

TEST_F(ViewImagesTest, AreMeasuredAgainstTheirReference) {
  LiveView view(small(), settingsOf(small()));
  EXPECT_EQ(view.sources(), (std::vector<std::string>{"reference", "a", "b"}));
  EXPECT_FALSE(view.rendersAny());
  const Image half0 = imageOf(24, 16, 0.9f), half1 = imageOf(24, 16, 1.1f);
  for (size_t i : {0u, 1u}) {
    const Image expected = imageOf(24, 16, i == 0 ? 0.5f : 0.8f);
    ASSERT_NE(view.picture(i), nullptr);
    EXPECT_EQ(view.picture(i)->pixels, expected.pixels);
    ASSERT_EQ(view.error(i).frames(), 1u);
    EXPECT_DOUBLE_EQ(view.error(i).mse().value, mseAgainstHalves(expected, half0, half1));
  }
  view.renderFrames();
  EXPECT_EQ(view.age(0), 0u) << "nothing renders";
}

TEST_F(ViewImagesTest, RefuseWhatNeedsAMethodInOneLine) {
  LiveView view(small(), settingsOf(small()));
  for (const ViewCommand& command : std::vector<ViewCommand>{
           MoveCamera{}, Resize{8, 8}, SetLight{"all", 2.0}, SetSetting{0, "integrator", "path"},
           SetParameter{0, "confidence_cap", ParameterValue(int64_t(3))}, ShowLayer{0, "depth"},
           CopyMethod{1, 0}, shows(0, "reference")}) {
    const std::string line = lineOf([&] { view.apply(command); }, ExitCode::badUsage);
    EXPECT_NE(line.find("nothing to change"), std::string::npos) << line;
  }
  EXPECT_NE(lineOf([&] { view.apply(Restart{}); }, ExitCode::badUsage).find("no pane"),
            std::string::npos);
  EXPECT_NE(lineOf([&] { view.apply(ShowTable{"a"}); }, ExitCode::badUsage).find("no folder"),
            std::string::npos);
  EXPECT_FALSE(view.history().canUndo());
}

TEST_F(ViewImagesTest, AreOfOneSizeAndThere) {
  const fs::path a = write("a.exr", imageOf(24, 16, 1.0f)),
                 b = write("b.exr", imageOf(24, 12, 1.0f));
  std::string line = lineOf([&] { readViewImages({a, b}); }, ExitCode::badInput);
  EXPECT_NE(line.find("b.exr: is 24x12"), std::string::npos) << line;
  EXPECT_NE(line.find("a.exr is 24x16"), std::string::npos) << line;
  line = lineOf([&] { readViewImages({a}, b); }, ExitCode::badInput);
  EXPECT_NE(line.find("b.exr: is 24x12"), std::string::npos) << line;
  line = lineOf([&] { readViewImages({a, folder() / "none.exr"}); }, ExitCode::badInput);
  EXPECT_NE(line.find("none.exr"), std::string::npos) << line;
  line = lineOf([&] { readResultsImages(folder(), ""); }, ExitCode::badInput);
  EXPECT_NE(line.find("no images of `restlab run`"), std::string::npos) << line;
}

// Applies the rule of `compare`: scene and settings in both files' metadata must agree.
TEST_F(ViewImagesTest, AreOfTheSceneOfTheirReference) {
  const auto writeOf = [&](const char* name, const char* kind, const char* scene,
                           const char* bounces) {
    const fs::path file = folder() / name;
    writeExr(file, {{{"", imageOf(24, 16, 0.5f)}},
                    {{"kind", kind}, {"scene_hash", scene}, {"max_bounces", bounces}}});
    return file;
  };
  const fs::path a = writeOf("a.exr", "image", "one", "4"),
                 b = writeOf("b.exr", "image", "two", "4"),
                 c = writeOf("c.exr", "image", "one", "5"),
                 r = writeOf("r.exr", "reference", "one", "4");
  EXPECT_NO_THROW(readViewImages({a}, r));
  EXPECT_NO_THROW(readViewImages({write("else.exr", imageOf(24, 16, 0.5f))}, r)) << "says nothing";
  for (const auto& [files, reference] : {std::pair(std::vector<fs::path>{a, b}, r), {{r, b}, {}}}) {
    const std::string line = lineOf([&] { readViewImages(files, reference); }, ExitCode::badInput);
    EXPECT_NE(line.find("r.exr: the reference is of another configuration: scene_hash is one, not "
                        "two as in "),
              std::string::npos)
        << line;
    EXPECT_NE(line.find("b.exr (--any-reference"), std::string::npos) << line;
    EXPECT_NO_THROW(readViewImages(files, reference, true, true));
  }
  EXPECT_NE(lineOf([&] { readViewImages({c}, r); }, ExitCode::badInput).find("max_bounces"),
            std::string::npos);
}

// Beside methods, images must be of the methods' scene: the reference is made for it.
TEST_F(ViewImagesTest, BesideMethodsAreOfTheirScene) {
  ViewStart start;
  start.prepared = cornellBox();
  start.settings = settingsOf(start.prepared, {smallPane("path"), smallPane("path")});
  std::map<std::string, std::string> words =
      describe(start.prepared, start.settings.panes.front().config);
  FileImage one{"a", "a.exr", imageOf(24, 16, 0.5f), words};
  start.images.list = {one};
  EXPECT_NO_THROW(requireImagesOf(start));
  start.images.list[0].metadata["scene_hash"] = "another";
  EXPECT_NE(lineOf([&] { requireImagesOf(start); }, ExitCode::badInput)
                .find("scene cornell-box: the reference is of another configuration: scene_hash"),
            std::string::npos);
  start.images.list = {one};
  start.settings.camera.yfov *= 1.5;
  EXPECT_NE(lineOf([&] { requireImagesOf(start); }, ExitCode::badInput).find("camera_yfov"),
            std::string::npos);
  start.settings.camera.yfov /= 1.5;
  start.settings.camera.shift.x = 0.25;
  EXPECT_NE(lineOf([&] { requireImagesOf(start); }, ExitCode::badInput)
                .find("camera_shift is 0.25 0, not 0 0"),
            std::string::npos);
}

TEST_F(ViewImagesTest, AreBounded) {
  const fs::path a = write("a.exr", imageOf(8, 6, 1.0f));
  const std::string line = lineOf(
      [&] { readViewImages(std::vector<fs::path>(kMostImages + 1, a)); }, ExitCode::badUsage);
  EXPECT_NE(line.find("at most 64"), std::string::npos) << line;
  const ViewImages most = readViewImages(std::vector<fs::path>(kMostImages, a));
  LiveView view(most, settingsOf(most));
  EXPECT_EQ(view.panes(), kMostImages);
  EXPECT_LE(kReferenceSlot + 1, kFirstLayerSlot);
}

TEST_F(ViewImagesTest, ATableIsShownOnAllPages) {
  writeTables();
  showImages(readResultsImages(folder(), ""));
  Page one(url()), other(url());
  EXPECT_EQ(one.waitFor("hello")["tables"], (Json{"box-all", "box-all-2"}));
  EXPECT_EQ(one.waitFor("state")["table"], "box-all");
  other.waitFor("numbers");
  one.say({{"do", "table"}, {"name", "box-all-2"}});
  for (Page* page : {&one, &other}) {
    const Json state =
        page->waitFor("state", [](const Json& s) { return s["table"] == "box-all-2"; });
    ASSERT_EQ(state["panes"].size(), 1u);
    EXPECT_EQ(state["panes"][0]["source"], "path");
    EXPECT_EQ(state["width"], 4);
    EXPECT_GT(state["exposure"], 0.0);
    for (const uint32_t slot : {0u, kReferenceSlot}) {
      page->waitForImage([&](const ShownImage& image) {
        return image.header.slot == slot && image.header.epoch == state["epoch"] &&
               image.header.width == 4 && image.header.format == PixelFormat::floats;
      });
    }
  }
  for (const auto& [name, says] : {std::pair("box-al", "did you mean 'box-all'"),
                                   {"../box-all", "no such table"},
                                   {"", "the name is empty"}}) {
    one.say({{"do", "table"}, {"name", name}});
    const std::string line = one.waitFor("error")["text"];
    EXPECT_NE(line.find(says), std::string::npos) << line;
  }
  // A file that is gone leaves the view as it is.
  fs::remove(folder() / "images/box-all-path.exr");
  std::ofstream(folder() / "images/box-all-path.exr") << "no image";
  one.say({{"do", "table"}, {"name", "box-all"}});
  EXPECT_NE(one.waitFor("error")["text"].get<std::string>().find("box-all-path.exr"),
            std::string::npos);
  stop();
  EXPECT_EQ(view_->images().table, "box-all-2");
  EXPECT_EQ(view_->panes(), 1u);
}

TEST_F(ViewImagesTest, OfResultsAreThoseOfOneTable) {
  writeTables();
  const auto namesOf = [&](const std::string& table) {
    std::vector<std::string> names;
    for (const FileImage& one : readResultsImages(folder(), table).list) names.push_back(one.name);
    return names;
  };
  EXPECT_EQ(tablesOfResults(folder()), (std::vector<std::string>{"box-all", "box-all-2"}));
  EXPECT_EQ(namesOf(""), (std::vector<std::string>{"gi-2", "path"}));
  EXPECT_EQ(namesOf("box-all-2"), (std::vector<std::string>{"path"}));
  EXPECT_TRUE(readResultsImages(folder(), "").reference.has_value());
  const std::string line =
      lineOf([&] { readResultsImages(folder(), "box-al"); }, ExitCode::badUsage);
  EXPECT_NE(line.find("did you mean 'box-all'"), std::string::npos) << line;
}

TEST_F(ViewImagesTest, SessionsKeepTheChoice) {
  {
    LiveView view(small(), settingsOf(small()));
    const std::string toml = sessionToml(facts_, view, "a-name");
    // Older files said which two of the images were shown.
    for (const char* older : {"", "a = \"reference\"\n"}) {
      std::ofstream(folder() / "images.toml") << toml + older;
      const ViewStart start = startOfSuite(folder() / "images.toml");
      EXPECT_EQ(start.prepared.scene, nullptr);
      EXPECT_TRUE(isSame(start.settings, view.settings()));
      EXPECT_TRUE(start.images.reference.has_value());
    }
  }
  {
    writeTables();
    const ViewImages images = readResultsImages(folder(), "box-all-2");
    const LiveView view(images, settingsOf(images));
    std::ofstream(folder() / "results.toml") << sessionToml(facts_, view, "a-name");
    const ViewStart start = startOfSuite(folder() / "results.toml");
    EXPECT_EQ(start.images.table, "box-all-2");
    EXPECT_TRUE(isSame(start.settings, view.settings()));
  }
  ViewImages images = readViewImages({write("c.exr", imageOf(24, 16, 0.3f))});
  LiveView view(cornellBox(), settingsOf(cornellBox(), {smallPane("restir_gi"), smallPane("path")}),
                {}, images);
  view.apply(shows(0, "c"));
  view.apply(shows(1, "reference"));
  std::ofstream(folder() / "methods.toml") << sessionToml(facts_, view, "a-name");
  const ViewStart start = startOfSuite(folder() / "methods.toml");
  ASSERT_NE(start.prepared.scene, nullptr);
  EXPECT_TRUE(isSame(start.settings, view.settings())) << sessionToml(facts_, view, "a-name");
  // Methods make their own reference: a reference file beside them is an ordinary image.
  small();
  const ViewImages beside = readViewImages({folder() / "a.exr", folder() / "r.exr"}, {}, false);
  EXPECT_EQ(beside.list.size(), 2u);
  EXPECT_FALSE(beside.reference.has_value());
  std::ofstream(folder() / "wrong.toml")
      << "[view]\nimages = [\"" << (folder() / "c.exr").string() << "\"]\na = \"d.exr\"\n";
  const std::string line =
      lineOf([&] { startOfSuite(folder() / "wrong.toml"); }, ExitCode::badUsage);
  EXPECT_NE(line.find("wrong.toml:3"), std::string::npos) << line;
}

// An image belongs to the picture that was set when it was opened.
TEST_F(ViewImagesTest, StandBesideMethods) {
  ViewImages images = readViewImages({write("c.exr", imageOf(24, 16, 0.3f))});
  LiveView view(cornellBox(), settingsOf(cornellBox(), {smallPane("restir_gi"), smallPane("path")}),
                {}, images);
  view.renderFrames();
  view.apply(shows(1, "c"));
  for (int i = 0; i < 2; ++i) view.renderFrames();
  EXPECT_EQ(view.frames(0), 3u);
  EXPECT_EQ(view.frames(1), 0u) << "the other pane's method rests";
  view.refineReference();
  view.refineReference();
  EXPECT_EQ(view.error(1).frames(), 1u);
  EXPECT_EQ(view.epochOf(1), view.epoch());
  view.apply(SetLight{"all", 2.0});
  view.refineReference();
  view.refineReference();
  EXPECT_EQ(view.epochOf(1), 0u);
  EXPECT_EQ(view.error(1).frames(), 0u) << "it is of another light";
  view.apply(Undo{});
  EXPECT_EQ(view.epochOf(1), view.epoch());
  EXPECT_NE(lineOf([&] { view.apply(shows(1, "referense")); }, ExitCode::badUsage)
                .find("did you mean 'reference'"),
            std::string::npos);
  view.apply(shows(1, ""));
  EXPECT_EQ(view.picture(1), nullptr) << "what it showed is no frame of the method";
  view.renderFrames();
  EXPECT_EQ(view.frames(1), 1u);
  // The method's frame is as if it had rendered from the start.
  Session again(view.loaded().scene, view.settings().panes[1].config);
  again.frame();
  EXPECT_EQ(view.picture(1)->pixels, again.radiance().pixels);
}

TEST_F(ViewImagesTest, GoToPagesAsImagesDo) {
  showImages(small());
  Page page(url());
  const Json hello = page.waitFor("hello");
  EXPECT_EQ(hello["has_scene"], false);
  EXPECT_EQ(hello["sources"], (Json{"reference", "a", "b"}));
  EXPECT_EQ(page.waitFor("state")["panes"][1]["source"], "b");
  const Json numbers = page.waitFor("numbers");
  EXPECT_GT(numbers["panes"][0]["mse"]["value"], numbers["panes"][1]["mse"]["value"]);
  EXPECT_EQ(numbers["panes"][0]["ms"], nullptr);
  EXPECT_EQ(numbers["reference"]["spp"], 64);
  ASSERT_EQ(page.images().size(), 3u);
  EXPECT_EQ(page.images().count(kReferenceSlot), 1u);
  // Images that stand still are sent once: a page that opens gets all of them, the others nothing.
  const uint64_t bytes = page.bytes();
  Page late(url());
  late.waitFor("numbers");
  ASSERT_EQ(late.images().size(), 3u);
  EXPECT_EQ(late.images().at(1).pixels, page.images().at(1).pixels);
  page.say({{"do", "probe"}, {"pane", 0}, {"x", 1}, {"y", 1}});
  EXPECT_NE(page.waitFor("error")["text"].get<std::string>().find("no method"), std::string::npos);
  EXPECT_LT(page.bytes() - bytes, page.images().at(0).pixels.size()) << "texts alone";
}

TEST_F(ViewImagesTest, APaneShowsTheReferenceAsItConverges) {
  start();
  Page page(url());
  page.say({{"do", "set"}, {"pane", 1}, {"key", "source"}, {"value", "reference"}});
  const Json state =
      page.waitFor("state", [](const Json& s) { return s["panes"][1]["source"] != ""; });
  for (const uint32_t least : {2u, 8u}) {
    page.waitForImage([&](const ShownImage& image) {
      return image.header.slot == 1 && image.header.epoch == state["epoch"] &&
             image.header.frame >= least;
    });
  }
  const Json numbers = page.waitFor("numbers");
  EXPECT_EQ(numbers["panes"][1]["mse"], nullptr);
  EXPECT_GT(numbers["panes"][0]["frame"], 0);
}

}  // namespace
}  // namespace restlab::view_test
