// Tools of a report's viewer: histogram, rectangle, exposure, and links to what is shown.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/image/metrics/metrics.h"
#include "tests/report/page.h"

namespace restlab::report_test {
namespace {

class ViewerToolsTest : public PageTest {
 protected:
  void SetUp() override {
    PageTest::SetUp();
    if (!browser_) return;
    ReportModel model = sampleModel(folder_.path());
    model["blocks"][1]["images"] = model["blocks"][0]["images"];
    open(model);
    for (const char* name : {"reference", "path"}) {
      const auto file = folder_.path() / "images" / (std::string(name) + ".exr");
      images_.push_back(readExr(file).layers.at(""));
    }
  }
  // Returns the value of the body of an async function with `viewer`, the first one.
  Json page(const std::string& body) {
    const Json value = browser_->evaluate(
        "(async () => { const viewer = document.querySelector('.viewer').viewer; " + body + "})()");
    settle();
    return value;
  }
  void press(const std::string& key, const std::string& code, bool shift = false) {
    browser_->press(key, code, shift);
    settle();
  }
  // Loads the report anew with a fragment behind its address.
  void reopenAt(const std::string& fragment) {
    browser_->evaluate("void (window.isOld = true, location.hash = " + Json(fragment).dump() +
                       ", setTimeout(() => location.reload(), 0))");
    for (int i = 0;; ++i) {
      try {
        browser_->waitFor(
            "!window.isOld && [...document.querySelectorAll('.viewer')].some(one => one.viewer && "
            "one.dataset.drawn !== undefined)");
        break;
      } catch (const std::runtime_error&) {
        if (i == 3) throw;  // evaluation fails while the page goes away
      }
    }
    settle();
  }

  std::vector<Image> images_;  // reference, path
};

double luminanceOf(const glm::vec3& p) { return 0.2126 * p.x + 0.7152 * p.y + 0.0722 * p.z; }

TEST_F(ViewerToolsTest, TheHistogramCountsBothImages) {
  EXPECT_EQ(page("return [viewer.tools.histogram.shown === undefined, "
                 "viewer.tools.histogram.element.offsetParent];"),
            (Json{true, nullptr}))
      << "nothing is counted while it is hidden";
  page("viewer.set({stops: 1});");
  press("H", "KeyH", true);
  browser_->waitFor("document.querySelector('.histogram').offsetHeight > 50");
  const Json shown = page(
      "return viewer.tools.histogram.shown.map(one => ({...one, "
      "bins: Array.from(one.bins)}));");
  const Json ends = page(
      "const {shown, scale} = viewer.tools.histogram.axis; "
      "return [shown.lo, shown.hi, scale.lo, scale.hi];");
  EXPECT_NEAR(ends[1], 0.25, 1e-12) << "white at exposure 2 and one stop";
  ASSERT_EQ(shown.size(), 2u);
  for (const Json& one : shown) {
    const Image& image = images_[one["image"] == 0 ? 0 : 1];
    std::vector<double> bins(128, 0.0);
    double white = 0.0, above = 0.0;
    const double share = 1.0 / double(image.pixels.size());
    for (const glm::vec3& pixel : image.pixels) {
      const double at = std::log2(luminanceOf(pixel) / double(ends[2])) /
                        std::log2(double(ends[3]) / double(ends[2]));
      (at < 1.0 ? bins.at(size_t(128.0 * at)) : above) += share;
      white += luminanceOf(pixel) > double(ends[1]) ? share : 0.0;
    }
    EXPECT_GT(white, 0.1);
    EXPECT_NEAR(one["white"], white, 1e-9);
    EXPECT_NEAR(one["above"], above, 1e-9);
    for (size_t i = 0; i < bins.size(); ++i)
      EXPECT_NEAR(one["bins"][i], bins[i], 1.5 * share) << one["image"] << " " << i;
  }
  EXPECT_NE(text(".histogram").find("0.25"), std::string::npos) << text(".histogram");
  screenshot("histogram");
  press("H", "KeyH", true);
  EXPECT_EQ(page("return viewer.tools.histogram.element.offsetParent;"), nullptr);
}

// Numbers of a dragged rectangle are those of the metrics on a crop.
TEST_F(ViewerToolsTest, ARectangleIsMeasured) {
  press("s", "KeyS");
  const Position from = pixelPosition(8, 4), to = pixelPosition(39, 27);
  browser_->drag(to.x, to.y, from.x, from.y, true);
  settle();
  EXPECT_EQ(page("return viewer.state.rectangle;"), (Json{8, 4, 40, 28}));
  EXPECT_EQ(page("return viewer.camera.fitted;"), true) << "the picture did not move";
  press("j", "KeyJ");
  press("ArrowLeft", "ArrowLeft");
  press("ArrowRight", "ArrowRight", true);
  EXPECT_EQ(page("return viewer.state.rectangle;"), (Json{7, 4, 40, 28}));
  EXPECT_EQ(state("current"), "1") << "arrows were the rectangle's";
  page("await new Promise(done => setTimeout(done, 260));");
  Image crop[2];
  for (int i = 0; i < 2; ++i) {
    crop[i] = Image(33, 24);
    for (uint32_t y = 0; y < 24; ++y)
      for (uint32_t x = 0; x < 33; ++x) crop[i].at(x, y) = images_[size_t(i)].at(7 + x, 4 + y);
  }
  const Json found = page("return viewer.tools.table.series[1].result().numbers;");
  const auto expectNear = [&](const char* kind, double expected) {
    EXPECT_NEAR(found[kind]["value"], expected, 1e-6 * expected) << kind;
    EXPECT_LT(found[kind]["lo"], expected) << kind;
    EXPECT_GT(found[kind]["hi"], expected) << kind;
  };
  expectNear("mse", evaluateMetric("mse", crop[1], crop[0]).value);
  expectNear("relmse", evaluateMetric("relmse_e1e-2", crop[1], crop[0]).value);
  expectNear("energy", evaluateMetric("energy_ratio", crop[1], crop[0]).value);
  double sum = 0.0;
  for (const glm::vec3& pixel : crop[1].pixels) sum += luminanceOf(pixel);
  expectNear("mean", sum / double(crop[1].pixels.size()));
  EXPECT_EQ(text(".rectangle code"), "--crop 7,4,33,24 --exposure 2");
  EXPECT_NE(text(".rectangle tbody").find("54 blocks of 4"), std::string::npos)
      << text(".rectangle tbody");
  screenshot("rectangle");
  press("Escape", "Escape");
  EXPECT_EQ(page("return [viewer.state.rectangle, viewer.tools.table.element.offsetParent];"),
            (Json{nullptr, nullptr}));
}

TEST_F(ViewerToolsTest, ALinkShowsTheSameAgain) {
  browser_->evaluate("document.querySelectorAll('.viewer')[1].scrollIntoView()");
  browser_->waitFor("Boolean(document.querySelectorAll('.viewer')[1].viewer)");
  const std::string second = "const viewer = document.querySelectorAll('.viewer')[1].viewer;";
  const std::string link = browser_->evaluate("(async () => {" + second + R"(
    viewer.set({mode: 'side', error: 'squared', stops: -1.5, channel: 'g', tone: 'false',
                histogram: true, rectangle: [2, 3, 20, 30]});
    viewer.zoom(3);
    viewer.setExposure(0.5);
    return viewer.data.link();
  })())");
  const size_t hash = link.find('#');
  ASSERT_NE(hash, std::string::npos) << link;
  const std::string read = "(() => {" + second +
                           "const {mode, error, stops, channel, tone, histogram, rectangle} = "
                           "viewer.state, {x, y, scale} = viewer.camera; return [mode, error, "
                           "stops, channel, tone, histogram, rectangle, viewer.painter.exposure, "
                           "[x, y, scale].map(value => value.toPrecision(6))]; })()";
  const Json before = browser_->evaluate(read);
  reopenAt(link.substr(hash));
  browser_->waitFor(
      "document.querySelectorAll('.viewer')[1].viewer && "
      "document.querySelectorAll('.viewer')[1].dataset.mode === 'side'");
  settle();
  EXPECT_EQ(browser_->evaluate(read), before);
  EXPECT_EQ(browser_->evaluate("(() => { const box = document.querySelectorAll('.viewer')[1]"
                               ".getBoundingClientRect(); return box.top < innerHeight && "
                               "box.bottom > 0; })()"),
            true);
}

TEST_F(ViewerToolsTest, ABadLinkIsSaidAndChangesNothing) {
  for (const char* fragment :
       {"#view=%7B%22block", "#view=7", "#view=%7B%22block%22%3A%22b-other%22%7D",
        "#view=%7B%22block%22%3A%22b-first%22%2C%22mode%22%3A%22upright%22%2C%22stops%22%3A1e9%2C"
        "%22rectangle%22%3A%5B0%2C0%2C9e9%2C1%5D%2C%22zoom%22%3A%5B1%2C2%2Cnull%5D%7D"}) {
    reopenAt(fragment);
    browser_->waitFor("Boolean(document.querySelector('.notice').textContent)");
    EXPECT_EQ(text(".notice").find("The address shows no view as it was: "), 0u) << fragment;
    EXPECT_EQ(page("const {mode, stops, rectangle} = viewer.state; return [mode, stops, rectangle, "
                   "viewer.camera.fitted];"),
              (Json{"wipe", 0, nullptr, true}))
        << fragment;
  }
}

}  // namespace
}  // namespace restlab::report_test
