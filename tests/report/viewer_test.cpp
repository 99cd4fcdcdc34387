// Image viewer of a report, driven by real events: it must show the numbers of the EXRs.
#include <algorithm>
#include <cmath>
#include <set>

#include "core/image/metrics/metrics.h"
#include "tests/report/page.h"

namespace restlab::report_test {
namespace {

class ViewerTest : public PageTest {
 protected:
  void SetUp() override {
    PageTest::SetUp();
    if (!browser_) return;
    open(sampleModel(folder_.path()));
    reference_ = readExr(folder_.path() / "images/reference.exr").layers.at("");
    path_ = readExr(folder_.path() / "images/path.exr").layers.at("");
    gi_ = readExr(folder_.path() / "images/gi.exr").layers.at("");
    EXPECT_EQ(state("mode"), "wipe") << "beside the reference at first";
    press("s", "KeyS");
  }
  void press(const std::string& key, const std::string& code, bool shift = false) {
    browser_->press(key, code, shift);
    settle();
  }
  double scale() { return std::stod(state("scale")); }
  // Turns the wheel at a position until the image is magnified enough. A busy browser may drop a
  // step.
  void zoomTo(Position at, double wanted) {
    for (int i = 0; i < 60 && scale() < wanted; ++i) browser_->wheel(at.x, at.y, -240.0);
    ASSERT_GE(scale(), wanted);
  }
  static std::vector<float> floats(const glm::vec3& pixel) { return {pixel.x, pixel.y, pixel.z}; }

  Image reference_, path_, gi_;
};

// Byte of an sRGB picture (IEC 61966-2-1).
int srgb(float linear) {
  if (!(linear > 0.0f)) return 0;
  const double encoded =
      linear <= 0.0031308f ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
  return int(std::min(255.0, encoded * 255.0 + 0.5));
}

TEST_F(ViewerTest, HoldsEveryBitOfTheFiles) {
  const Image* files[] = {&reference_, &path_, &gi_};
  for (int i = 0; i < 3; ++i) {
    const Json words = browser_->evaluate(
        "Array.from(new Uint32Array(document.querySelector('.viewer').viewer.images[" +
        std::to_string(i) + "].data.buffer))");
    ASSERT_EQ(words.size(), 3u * kSampleWidth * kSampleHeight);
    for (size_t at = 0; at < words.size(); ++at) {
      uint32_t bits = 0;
      std::memcpy(&bits, &files[i]->pixels[at / 3][int(at % 3)], sizeof(bits));
      ASSERT_EQ(words[at].get<uint32_t>(), bits) << "image " << i << ", value " << at;
    }
  }
}

TEST_F(ViewerTest, StatusLineSaysTheFilesNumbers) {
  for (const auto& [x, y] : {std::pair(0, 0), std::pair(63, 35), std::pair(51, 11)}) {
    pointAt(x, y);
    const Status status = this->status();
    EXPECT_EQ(status.x, x);
    EXPECT_EQ(status.y, y);
    // Exactly equal: the text is the shortest that names the float.
    EXPECT_EQ(status.values.at("path"), floats(path_.at(uint32_t(x), uint32_t(y))));
    EXPECT_EQ(status.values.at("reference"), floats(reference_.at(uint32_t(x), uint32_t(y))));
  }
}

TEST_F(ViewerTest, SpecialNumbersAreSaidAndMarked) {
  press("3", "Digit3");
  const std::vector<glm::vec3> special = specialPixels();
  for (uint32_t i = 0; i < special.size(); ++i) {
    pointAt(3 + i, 5);
    const std::vector<float> values = status().values.at("gi unbiased");
    for (int c = 0; c < 3; ++c) {
      const float expected = special[i][c];
      if (std::isnan(expected)) {
        EXPECT_TRUE(std::isnan(values[size_t(c)])) << i;
      } else {
        EXPECT_EQ(values[size_t(c)], expected) << i;
        EXPECT_EQ(std::signbit(values[size_t(c)]), std::signbit(expected)) << i;
      }
    }
  }
  EXPECT_EQ(canvasColour(pixelPosition(3, 5)), (std::vector<int>{255, 0, 255})) << "NaN";
  EXPECT_EQ(canvasColour(pixelPosition(4, 5)), (std::vector<int>{0, 255, 0})) << "infinite";
  EXPECT_NE(text(".images").find("3 non-finite"), std::string::npos);
  screenshot("special");
}

TEST_F(ViewerTest, KeysFlip) {
  EXPECT_EQ(state("current"), "1") << "the first method";
  EXPECT_EQ(state("compare"), "0") << "the reference";
  press("3", "Digit3");
  EXPECT_EQ(state("current"), "2");
  pointAt(20, 20);
  EXPECT_EQ(status().values.count("gi unbiased"), 1u);
  press("1", "Digit1");
  EXPECT_EQ(state("current"), "0");
  press("9", "Digit9");
  EXPECT_EQ(state("current"), "0") << "there is no ninth image";
  press("ArrowRight", "ArrowRight");
  EXPECT_EQ(state("current"), "1");
  press("ArrowLeft", "ArrowLeft");
  press("ArrowLeft", "ArrowLeft");
  EXPECT_EQ(state("current"), "2");
  press("\"", "Digit2", true);
  EXPECT_EQ(state("compare"), "1");
  EXPECT_EQ(state("current"), "2");
}

TEST_F(ViewerTest, FlippingChangesThePicture) {
  const Position at = pixelPosition(30, 30);
  const auto expected = [](const glm::vec3& pixel) {
    return std::vector<int>{srgb(2.0f * pixel.x), srgb(2.0f * pixel.y), srgb(2.0f * pixel.z)};
  };
  EXPECT_EQ(canvasColour(at), expected(path_.at(30, 30))) << "radiance x exposure 2 as sRGB";
  press("1", "Digit1");
  EXPECT_EQ(canvasColour(at), expected(reference_.at(30, 30)));
}

TEST_F(ViewerTest, SpaceShowsTheReferenceWhileHeld) {
  press("3", "Digit3");
  browser_->evaluate("document.querySelector('.viewer').focus()");
  const Position at = pixelPosition(30, 30);
  const std::vector<int> before = canvasColour(at);
  browser_->keyDown(" ", "Space");
  settle();
  EXPECT_NE(canvasColour(at), before);
  EXPECT_EQ(text(".tag"), "1  reference");
  browser_->keyUp(" ", "Space");
  settle();
  EXPECT_EQ(canvasColour(at), before);
}

TEST_F(ViewerTest, ExposureGoesUpAndDown) {
  const Position at = pixelPosition(30, 30);
  const std::vector<int> before = canvasColour(at);
  press("e", "KeyE");
  press("e", "KeyE");
  EXPECT_EQ(state("stops"), "1");
  EXPECT_EQ(canvasColour(at)[0], srgb(4.0f * path_.at(30, 30).x)) << "twice as bright";
  press("E", "KeyE", true);
  EXPECT_EQ(state("stops"), "0.5");
  press("r", "KeyR");
  EXPECT_EQ(state("stops"), "0");
  EXPECT_EQ(canvasColour(at), before);
  EXPECT_NE(text(".legend").find("2 as sRGB"), std::string::npos);
  press("t", "KeyT");
  EXPECT_EQ(state("tone"), "false");
  EXPECT_NE(canvasColour(at), before);
  EXPECT_NE(text(".legend").find("luminance"), std::string::npos);
  screenshot("false-colour");
}

TEST_F(ViewerTest, WheelZoomsAboutThePointer) {
  const Position at = pixelPosition(40, 10);
  browser_->moveMouse(at.x, at.y);
  const double before = scale();
  const Json scrolled = browser_->evaluate("scrollY");
  zoomTo(at, 1.1 * before);
  EXPECT_EQ(status().x, 40);
  EXPECT_EQ(status().y, 10);
  EXPECT_EQ(browser_->evaluate("scrollY"), scrolled) << "the page stays";
  zoomTo(at, 100.0);
  EXPECT_EQ(status().x, 40) << "the pixel under the pointer stays there";
  EXPECT_EQ(status().y, 10);
  press("f", "KeyF");
  EXPECT_NEAR(scale(), before, 1e-9);
  EXPECT_EQ(status().x, 40);
}

TEST_F(ViewerTest, NumbersStandInLargePixels) {
  // Counts the colours inside one image pixel: one, until its numbers are drawn there.
  const auto colours = [&](Position at) {
    std::set<std::vector<int>> found;
    const std::vector<int> bytes = canvasBytes(at, 4);
    for (size_t i = 0; i < bytes.size(); i += 4)
      found.insert({bytes[i], bytes[i + 1], bytes[i + 2]});
    return found.size();
  };
  const Position at = pixelPosition(40, 10);
  EXPECT_EQ(colours(at), 1u);
  zoomTo(at, 56.0);
  EXPECT_GT(colours(at), 1u);
  screenshot("values");
}

TEST_F(ViewerTest, DragMovesThePicture) {
  const Position at = pixelPosition(32, 18);
  browser_->moveMouse(at.x, at.y);
  zoomTo(at, 80.0);
  const Status before = status();
  browser_->drag(at.x, at.y, at.x + 160.0, at.y - 80.0);
  EXPECT_EQ(status().x, before.x) << "the picture came along";
  EXPECT_EQ(status().y, before.y);
  browser_->moveMouse(at.x, at.y);
  EXPECT_LT(status().x, before.x);
  EXPECT_GT(status().y, before.y);
}

TEST_F(ViewerTest, WipeFollowsTheDivider) {
  press("w", "KeyW");
  EXPECT_EQ(state("mode"), "wipe");
  EXPECT_EQ(texts(".tag"), (std::vector<std::string>{"1  reference", "2  path  MSE 0.9  70 ms"}))
      << "the row's error and time";
  const auto colourOf = [](const Image& image, uint32_t x, uint32_t y) {
    const glm::vec3& p = image.at(x, y);
    return std::vector<int>{srgb(2.0f * p.x), srgb(2.0f * p.y), srgb(2.0f * p.z)};
  };
  EXPECT_EQ(canvasColour(pixelPosition(25, 30)), colourOf(reference_, 25, 30));
  EXPECT_EQ(canvasColour(pixelPosition(40, 30)), colourOf(path_, 40, 30));
  const Position from = pixelPosition(31.5, 8), to = pixelPosition(15.5, 8);
  browser_->drag(from.x, from.y, to.x, to.y);
  settle();
  EXPECT_EQ(attribute(".divider", "aria-valuenow"), "25");
  EXPECT_EQ(canvasColour(pixelPosition(25, 30)), colourOf(path_, 25, 30)) << "right of it now";
  EXPECT_EQ(canvasColour(pixelPosition(10, 30)), colourOf(reference_, 10, 30));
  pointAt(10, 30);
  EXPECT_EQ(status().values.count("path"), 0u) << "the pointer is over the reference";
  screenshot("wipe");
  // By keyboard, too.
  browser_->evaluate("document.querySelector('.divider').focus()");
  press("End", "End");
  EXPECT_EQ(attribute(".divider", "aria-valuenow"), "100");
}

TEST_F(ViewerTest, SideBySideIsOneZoom) {
  press("b", "KeyB");
  EXPECT_EQ(texts(".tag").size(), 3u);
  const auto views = [&] {
    return browser_->evaluate(
        "(() => { const v = document.querySelector('.viewer').viewer; const b = "
        "v.canvas.getBoundingClientRect(); return v.stage.views.map(w => [b.x + w.x, b.y + w.y, "
        "w.width, w.height]); })()");
  };
  const Json first = views()[0], last = views()[2];
  // Position at 3/4 and 1/2 of the first view.
  const Position at = {double(first[0]) + 0.75 * double(first[2]),
                       double(first[1]) + 0.5 * double(first[3])};
  zoomTo(at, 60.0);
  browser_->moveMouse(at.x, at.y);
  const Status here = status();
  EXPECT_EQ(here.values.size(), 1u) << "the reference alone";
  browser_->moveMouse(double(last[0]) + 0.75 * double(last[2]),
                      double(last[1]) + 0.5 * double(last[3]));
  const Status there = status();
  EXPECT_EQ(there.values.count("gi unbiased"), 1u);
  EXPECT_EQ(here.x, there.x) << "the same place in every view";
  EXPECT_EQ(here.y, there.y);
  press("f", "KeyF");
  screenshot("side");
}

TEST_F(ViewerTest, ErrorViewsHaveTheirNumbers) {
  struct Kind {
    const char* name;
    double (*pixel)(double d, double r);
    const char* metric;
  };
  const Kind kinds[] = {
      {"signed", [](double d, double) { return d; }, ""},
      {"absolute", [](double d, double) { return std::abs(d); }, "mae"},
      {"squared", [](double d, double) { return d * d; }, "mse"},
      {"relative", [](double d, double r) { return std::abs(d) / (std::abs(r) + 1e-2); },
       "mape_e1e-2"}};
  for (const Kind& kind : kinds) {
    press("n", "KeyN");
    EXPECT_EQ(state("error"), kind.name);
    EXPECT_EQ(text(".legend b"), std::string(kind.name) + " error");
    EXPECT_GE(texts(".numbers span").size(), 5u) << "the legend has numbers";
    pointAt(22, 17);
    double expected = 0.0;
    for (int c = 0; c < 3; ++c) {
      const double r = reference_.at(22, 17)[c];
      expected += kind.pixel(double(path_.at(22, 17)[c]) - r, r) / 3.0;
    }
    EXPECT_NEAR(status().error, expected, 0.006 * std::abs(expected)) << kind.name;
    if (*kind.metric) {
      const double mean = std::stod(text(".images tbody tr:nth-child(2) [data-part=mean]"));
      const double metric = evaluateMetric(kind.metric, path_, reference_).value;
      EXPECT_NEAR(mean, metric, 0.006 * metric) << kind.metric;
      EXPECT_EQ(text(".images tbody tr:nth-child(3) [data-part=mean]"), "NaN")
          << "values that are not finite are never skipped";
    }
    screenshot(std::string("error-") + kind.name);
  }
  for (const char* kind : {"smape", "ssim", "flip_ldr", "flip_hdr", "none"}) {
    press("n", "KeyN");
    EXPECT_EQ(state("error"), kind);
  }
  press("N", "KeyN", true);
  EXPECT_EQ(state("error"), "flip_hdr");
}

TEST_F(ViewerTest, SignedErrorIsBlueBelowAndOrangeAbove) {
  press("n", "KeyN");
  uint32_t dark = 0, light = 0;
  for (uint32_t i = 0; i < kSampleWidth * kSampleHeight; ++i) {
    const glm::vec3 d = path_.pixels[i] - reference_.pixels[i];
    if (d.x < 0.0f && i > kSampleWidth * 8) dark = i;
    if (d.x > 0.0f && i > kSampleWidth * 8) light = i;
  }
  const auto colour = [&](uint32_t i) {
    const uint32_t x = i % kSampleWidth, y = i / kSampleWidth;
    return canvasColour(pixelPosition(x, y));
  };
  EXPECT_LT(colour(dark)[0], colour(dark)[2]);
  EXPECT_GT(colour(light)[0], colour(light)[2]);
}

TEST_F(ViewerTest, ErrorScaleIsLinearOrLogarithmicAndFollowsTheExposure) {
  press("n", "KeyN");
  press("n", "KeyN");
  const auto last = [&] { return std::stod(texts(".numbers span").back()); };
  const double linear = last();
  EXPECT_EQ(texts(".numbers span").front(), "0");
  press("l", "KeyL");
  EXPECT_NEAR(std::stod(texts(".numbers span").front()), 1e-4 * linear, 1e-6 * linear);
  press("e", "KeyE");
  press("e", "KeyE");
  EXPECT_NEAR(last(), 0.5 * linear, 1e-6);
}

TEST_F(ViewerTest, ButtonsDoWhatKeysDo) {
  click(".viewer [data-value=wipe]");
  EXPECT_EQ(state("mode"), "wipe");
  EXPECT_EQ(attribute(".viewer [data-value=wipe]", "aria-pressed"), "true");
  browser_->evaluate(
      "(() => { const list = document.querySelector('.toolbar select'); list.value = 'squared'; "
      "list.dispatchEvent(new Event('change')); })()");
  EXPECT_EQ(state("error"), "squared");
  click(".images tbody tr:nth-child(3) .name");
  EXPECT_EQ(state("current"), "2");
  click(".images tbody tr:nth-child(2) .compare");
  EXPECT_EQ(state("compare"), "1");
  EXPECT_NE(text(".legend").find("r = path"), std::string::npos);
}

TEST_F(ViewerTest, HelpOpensAndCloses) {
  press("?", "Slash", true);
  EXPECT_EQ(browser_->evaluate("document.querySelector('.help').open"), true);
  screenshot("help");
  press("2", "Digit2");
  EXPECT_EQ(state("current"), "1") << "keys are the help's while it is open";
  press("Escape", "Escape");
  EXPECT_EQ(browser_->evaluate("document.querySelector('.help').open"), false);
}

}  // namespace
}  // namespace restlab::report_test
