// Report of a folder made by `run`, tested from the program to the browser: its numbers match
// summary.csv and the EXRs.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "core/image/image.h"
#include "tests/report/page.h"

namespace restlab::report_test {
namespace {

namespace fs = std::filesystem;

using Names = std::vector<std::string>;

constexpr const char* kSuite = R"(name = "left by run"
question = "Are these the numbers?"
scenes = ["cornell-box"]
[settings]
width = 64
height = 36  # fills the stage, as the sample does
max_bounces = 3
warmup_frames = 4
frames = 4
runs = 3
accumulate = true
metrics = ["ssim"]
[reference]
spp = 64
[[method]]
name = "path"
[[method]]
name = "gi"
integrator = "restir_gi"
[[method]]
name = "gi biased"
integrator = "restir_gi"
mode = "biased"
)";

class RunFolder : public PageTest {
 protected:
  void SetUp() override {
    PageTest::SetUp();
    if (!browser_) return;
    std::ofstream(folder_.path() / "suite.toml") << kSuite;
    const std::string command = "cd '" + folder_.path().string() +
                                "' && XDG_CACHE_HOME=cache '" RESTLAB_PROGRAM
                                "' run suite.toml -o out -q > table.txt";
    ASSERT_EQ(std::system(command.c_str()), 0);
    openFile(folder_.path() / "out/report.html");
  }
  // Returns a column of summary.csv with the methods. Requires that no column before it has quotes.
  std::vector<std::pair<double, std::string>> column(const std::string& name) const {
    std::ifstream in(folder_.path() / "out/summary.csv");
    const auto cells = [&] {
      Names all;
      std::string line, cell;
      std::getline(in, line);
      for (std::istringstream text(line); std::getline(text, cell, ',');) all.push_back(cell);
      return all;
    };
    const Names heads = cells();
    const auto at = [&](const std::string& head) {
      return size_t(std::find(heads.begin(), heads.end(), head) - heads.begin());
    };
    std::vector<std::pair<double, std::string>> values;
    for (Names row = cells(); !row.empty(); row = cells())
      values.emplace_back(std::stod(row.at(at(name))), row.at(at("method")));
    return values;
  }
  Names methods() { return texts(".block > .scroll:first-of-type tbody .method"); }
};

TEST_F(RunFolder, ShowsWhatWasMeasured) {
  EXPECT_EQ(text("h1"), "left by run");
  auto mse = column("mse");
  ASSERT_EQ(mse.size(), 3u);
  EXPECT_EQ(methods(), (Names{"path", "gi", "gi biased"}));
  const Names heads = texts(".results thead th");
  const auto sortBy = [&](const std::string& head) {
    const auto found = std::find_if(heads.begin(), heads.end(), [&](const std::string& text) {
      return text.rfind(head, 0) == 0;
    });
    ASSERT_NE(found, heads.end()) << head;
    click(".results thead th:nth-child(" + std::to_string(found - heads.begin() + 1) + ") button");
  };
  sortBy("MSE");
  std::sort(mse.begin(), mse.end());
  EXPECT_EQ(methods(), (Names{mse[0].second, mse[1].second, mse[2].second}));
}

TEST_F(RunFolder, PixelsAreThoseOfTheFiles) {
  EXPECT_NE(state("current"), "1") << "path has the largest error";
  browser_->press("s", "KeyS", false);
  browser_->press("2", "Digit2");
  settle();
  const fs::path images = folder_.path() / "out/images";
  const auto read = [&](const std::string& name) {
    return readExr(images / ("cornell-box-all-" + name + ".exr")).layers.at("");
  };
  const Image reference = read("reference"), path = read("path"), gi = read("gi");
  const auto floats = [](const glm::vec3& p) { return std::vector<float>{p.x, p.y, p.z}; };
  pointAt(17, 21);
  EXPECT_EQ(status().values.at("path"), floats(path.at(17, 21)));
  EXPECT_EQ(status().values.at("reference"), floats(reference.at(17, 21)));
  browser_->press("3", "Digit3");
  settle();
  EXPECT_EQ(status().values.at("gi"), floats(gi.at(17, 21)));
  browser_->press("w", "KeyW");
  settle();
  EXPECT_EQ(state("mode"), "wipe");
  ASSERT_EQ(texts(".tag").size(), 2u);
  EXPECT_EQ(texts(".tag")[0], "1  reference");
  EXPECT_EQ(texts(".tag")[1].rfind("3  gi  MSE ", 0), 0u) << texts(".tag")[1];
  browser_->press("s", "KeyS");
  settle();
  const Position at = pixelPosition(30, 12);
  browser_->moveMouse(at.x, at.y);
  const double before = std::stod(state("scale"));
  for (int i = 0; i < 60 && std::stod(state("scale")) < 8.0 * before; ++i)
    browser_->wheel(at.x, at.y, -240.0);
  EXPECT_GE(std::stod(state("scale")), 8.0 * before);
  EXPECT_EQ(status().x, 30) << "the pixel under the pointer stays there";
  EXPECT_EQ(status().y, 12);
  EXPECT_EQ(status().values.at("gi"), floats(gi.at(30, 12)));
  screenshot("run", true);
}

// The page's own rule finds the exposure that the program wrote down.
TEST_F(RunFolder, TheExposureIsThatOfThePage) {
  const std::string exposure = "document.querySelector('.viewer').viewer.painter.exposure";
  const double written = browser_->evaluate(exposure);
  browser_->evaluate("document.querySelector('.viewer').viewer.setExposure(1e-3)");
  browser_->press("a", "KeyA");
  settle();
  EXPECT_NEAR(browser_->evaluate(exposure), written, 1e-5 * written);
}

TEST_F(RunFolder, HasItsParts) {
  // Plots over time, over frames and of single frames; bars.
  EXPECT_EQ(browser_->evaluate("document.querySelectorAll('figure svg').length"), 4);
  const std::string page = text("body");
  for (const char* words : {"ssim", "Are these the numbers?", "bias^2 / MSE", "nonfinite",
                            "emissive_textures", "compiler"})
    EXPECT_NE(page.find(words), std::string::npos) << words;
}

}  // namespace
}  // namespace restlab::report_test
