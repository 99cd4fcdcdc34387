// The live page's canvas shows the program's pixels.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/view/live_page.h"

namespace restlab::view_test {
namespace {

// Byte of an sRGB picture (IEC 61966-2-1).
int srgb(double linear) {
  if (!(linear > 0.0)) return 0;
  const double encoded =
      linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
  return int(std::min(255.0, encoded * 255.0 + 0.5));
}

class PagePixelsTest : public LivePageTest {
 protected:
  void SetUp() override {
    LivePageTest::SetUp();
    if (!browser_) return;
    open();
    page("await until(() => page.last.panes[0].frame > 2);");
    pause();
    stop();  // the page stays open; the test may use the view
  }
  // Reads the canvas at the centre of each image pixel, with the whole image in one view, and the
  // images that are shown.
  void readBack() {
    const Json read = page(R"(
      viewer.pointer = null;
      viewer.draw();
      const {canvas, images} = viewer, {width, height} = page.state;
      const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d');
      copy.drawImage(canvas, 0, 0);
      const {data} = copy.getImageData(0, 0, canvas.width, canvas.height);
      const scale = Math.min(canvas.width / width, canvas.height / height), colours = [];
      for (let y = 0; y < height; ++y) {
        for (let x = 0; x < width; ++x) {
          const column = Math.floor(canvas.width / 2 + scale * (x + 0.5 - width / 2));
          const row = Math.floor(canvas.height / 2 + scale * (y + 0.5 - height / 2));
          const at = 4 * (row * canvas.width + column);
          colours.push(data[at], data[at + 1], data[at + 2]);
        }
      }
      return {colours, exposure: viewer.painter.exposure, images: images.map(i => Array.from(i.data)),
              left: (width / 2 + (viewer.state.wipe - 0.5) * canvas.width / scale)};)");
    colours_ = read["colours"].get<std::vector<int>>();
    images_ = read["images"].get<std::vector<std::vector<double>>>();
    exposure_ = read["exposure"];
    divider_ = read["left"];
  }
  // Checks the pixels whose centre lies in [x0, x1) against the image, by exposure and sRGB.
  void expectShown(size_t image, double x0, double x1, double factor = 1.0) {
    int count = 0, wrong = 0;
    for (size_t k = 0; k < colours_.size(); ++k) {
      const double x = double(k / 3 % 64) + 0.5;
      // The divider is drawn as a line over the centre of a pixel.
      if (x < x0 + 0.2 || x > x1 - 0.2) continue;
      ++count;
      wrong += std::abs(colours_[k] - srgb(factor * exposure_ * images_[image][k])) > 1;
    }
    EXPECT_GT(count, 300) << "of image " << image;
    EXPECT_EQ(wrong, 0) << "of image " << image << " between " << x0 << " and " << x1;
  }
  std::string status() { return text(".status"); }
  // Returns R, G, B of an image in the status line.
  std::vector<float> saidOf(const std::string& name) {
    const std::string line = status();
    const size_t at = line.find(name + ": ");
    if (at == std::string::npos) return {};
    std::istringstream words(line.substr(at + name.size() + 2));
    std::vector<float> values;
    std::string word;
    for (int c = 0; c < 3 && words >> word; ++c)
      values.push_back(std::strtof(word.c_str(), nullptr));
    return values;
  }
  void pointAt(uint32_t x, uint32_t y) {
    const auto [left, top] = positionOf(x, y);
    browser_->moveMouse(left, top);
    page("await frame(); await frame();");
  }
  static std::vector<float> floats(const glm::vec3& p) { return {p.x, p.y, p.z}; }

  std::vector<int> colours_;
  std::vector<std::vector<double>> images_;
  double exposure_ = 0.0, divider_ = 0.0;
};

TEST_F(PagePixelsTest, PanesAreTheSessionsToTheLastBit) {
  for (size_t i : {0u, 1u}) {
    EXPECT_EQ(page(fmt::format("return seen[{}].frame;", i)), view_->frames(i));
    const Json words =
        page(fmt::format("return Array.from(new Uint32Array(viewer.images[{}].data.buffer));", i));
    const Image& image = view_->session(i).radiance();
    ASSERT_EQ(words.size(), 3 * image.pixels.size());
    size_t wrong = 0;
    for (size_t k = 0; k < words.size(); ++k) {
      uint32_t bits = 0;
      std::memcpy(&bits, &image.pixels[k / 3][int(k % 3)], sizeof bits);
      wrong += bits != words[k].get<uint32_t>();
    }
    EXPECT_EQ(wrong, 0u) << "pane " << i;
  }
}

TEST_F(PagePixelsTest, WipeIsTheReferenceLeftAndThePaneRight) {
  press("w");
  press("1");
  readBack();
  EXPECT_NEAR(divider_, 32.0, 1e-9);
  expectShown(2, 0.0, divider_);
  expectShown(0, divider_, 64.0);
  EXPECT_NE(text(".legend").find("as sRGB"), std::string::npos);

  const auto [x0, y0] = positionOf(31, 5);
  const auto [x1, y1] = positionOf(15, 5);
  const Json box = page(
      "const b = viewer.divider.getBoundingClientRect();"
      "return [b.x + b.width / 2, b.width];");
  browser_->drag(box[0], y0, double(box[0]) + x1 - x0, y0);
  EXPECT_TRUE(page("return document.activeElement === viewer.root;").get<bool>());
  press("2");
  readBack();
  EXPECT_NEAR(divider_, 16.0, 0.3);
  expectShown(2, 0.0, divider_);
  expectShown(1, divider_, 64.0);

  press("e");
  press("e");
  readBack();
  expectShown(2, 0.0, divider_, 2.0);
  expectShown(1, divider_, 64.0, 2.0);
  // The other image on the left.
  press("Shift+1");
  press("r");
  readBack();
  expectShown(0, 0.0, divider_);
}

TEST_F(PagePixelsTest, KeysFlip) {
  press("s");
  for (const size_t i : {2u, 0u, 1u}) {
    press(std::to_string(i + 1));
    readBack();
    expectShown(i, 0.0, 64.0);
  }
  press("4");
  readBack();
  expectShown(1, 0.0, 64.0);
}

TEST_F(PagePixelsTest, TabShowsTheReferenceWhileItIsHeld) {
  press("s");
  press("1");
  page("viewer.root.focus();");
  for (const char* key : {"Tab", "Space"}) {
    keyDown(key);
    readBack();
    expectShown(2, 0.0, 64.0);
    keyUp(key);
    readBack();
    expectShown(0, 0.0, 64.0);
  }
  EXPECT_EQ(page("return document.activeElement === viewer.root;"), true) << "Tab does not leave";
  press("Escape");
  EXPECT_EQ(page("return document.activeElement === viewer.root;"), false);
}

TEST_F(PagePixelsTest, PointerReadsValues) {
  press("s");
  press("1");
  for (const auto& [x, y] : {std::pair(0u, 0u), std::pair(63u, 35u), std::pair(20u, 30u)}) {
    pointAt(x, y);
    EXPECT_EQ(status().rfind(fmt::format("x {}  y {} ", x, y), 0), 0u) << status();
    EXPECT_EQ(saidOf("A: restir_gi, pixel"), floats(view_->session(0).radiance().at(x, y)));
    EXPECT_EQ(saidOf("reference").size(), 3u);
  }
  press("2");
  page("await frame();");
  EXPECT_EQ(saidOf("B: path + accumulate"), floats(view_->session(1).radiance().at(20, 30)));
}

TEST_F(PagePixelsTest, ZoomedPixelsHoldTheirNumbers) {
  press("s");
  press("1");
  const auto [x, y] = positionOf(20, 30);
  browser_->moveMouse(x, y);
  // Counts the colours near the pointer: one, unless numbers are drawn there.
  const auto colours = [&, x = x, y = y] {
    return page(fmt::format(R"(await frame();
      await frame();
      const box = viewer.canvas.getBoundingClientRect(), found = new Set();
      const copy = new OffscreenCanvas(9, 9).getContext('2d');
      copy.drawImage(viewer.canvas, {} - box.x - 4, {} - box.y - 4, 9, 9, 0, 0, 9, 9);
      const {{buffer}} = copy.getImageData(0, 0, 9, 9).data;
      for (const word of new Uint32Array(buffer)) found.add(word);
      return found.size;)",
                            std::floor(x), std::floor(y)))
        .get<int>();
  };
  EXPECT_EQ(colours(), 1);
  for (int i = 0; i < 60 && page("return viewer.camera.scale < 60;") == true; ++i)
    browser_->wheel(x, y, -240.0);
  EXPECT_GT(colours(), 1);
  browser_->moveMouse(x, y);
  page("await frame(); await frame();");
  EXPECT_EQ(status().rfind("x 20  y 30 ", 0), 0u) << status();
  EXPECT_EQ(saidOf("A: restir_gi, pixel"), floats(view_->session(0).radiance().at(20, 30)));
  press("f");
  EXPECT_EQ(colours(), 1);
}

}  // namespace
}  // namespace restlab::view_test
