// Errors of the viewer beside the simple ones: maps that are computed at rest, SMAPE, two of them
// behind a divider, and insets with their own errors.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/image/metrics/metrics.h"
#include "core/image/metrics/ssim.h"
#include "tests/report/page.h"

namespace restlab::report_test {
namespace {

constexpr const char* kRestKinds[] = {"ssim", "flip_ldr", "flip_hdr"};

class ErrorMapsTest : public PageTest {
 protected:
  void SetUp() override {
    PageTest::SetUp();
    if (!browser_) return;
    open(sampleModel(folder_.path()));
    reference_ = readExr(folder_.path() / "images/reference.exr").layers.at("");
    path_ = readExr(folder_.path() / "images/path.exr").layers.at("");
    other_ = noisy(reference_, 0.4f, 3);
    // In place of the image with values that are not finite.
    page("images[2].data = new Float32Array(" + Json(values(other_)).dump() +
         "); images[2].nonfinite = []; ++images[2].version;");
  }
  static std::vector<float> values(const Image& image) {
    std::vector<float> all;
    for (const glm::vec3& pixel : image.pixels) all.insert(all.end(), {pixel.x, pixel.y, pixel.z});
    return all;
  }
  // Returns the value of the body of a function that can use the viewer, its painter and images.
  Json page(const std::string& body) {
    const Json value = browser_->evaluate(
        "(async () => { const viewer = document.querySelector('.viewer').viewer, {painter, images} "
        "= viewer;" +
        body + "})()");
    settle();
    return value;
  }
  // Waits until there is a map of both methods.
  void waitForMaps(const std::string& kind) {
    browser_->waitFor(
        fmt::format("(() => {{ const {{painter}} = document.querySelector('.viewer')"
                    ".viewer; return [1, 2].every(i => painter.plane('{0}', i) && "
                    "painter.rest.note('{0}', i, 0) === ''); }})()",
                    kind));
    settle();
  }
  // Returns the tags of the views without their numbers.
  std::vector<std::string> names() {
    std::vector<std::string> tags = texts(".tag");
    for (std::string& tag : tags) tag = tag.substr(0, tag.find("  ", 3));
    return tags;
  }
  double shownMean(int row) {
    return std::stod(text(fmt::format(".images tbody tr:nth-child({}) [data-part=mean]", row)));
  }
  void press(const std::string& key, const std::string& code, bool shift = false) {
    browser_->press(key, code, shift);
    settle();
  }

  Image reference_, path_, other_;
};

TEST_F(ErrorMapsTest, MeansAreTheMetricsOfTheProgram) {
  for (const char* kind : kRestKinds) {
    page(fmt::format("viewer.set({{error: '{}'}});", kind));
    waitForMaps(kind);
    const double tolerance = std::string(kind) == "ssim" ? 1e-5 : 1e-4;
    for (const int i : {1, 2}) {
      const MetricValue metric = evaluateMetric(kind, i == 1 ? path_ : other_, reference_);
      const double mean = page(fmt::format("return painter.plane('{}', {}).mean;", kind, i));
      EXPECT_NEAR(mean, metric.value, tolerance) << kind << ", image " << i;
      EXPECT_NEAR(shownMean(i + 1), metric.value, 0.006) << kind;
    }
    EXPECT_NE(text(".legend").find("r = reference"), std::string::npos) << text(".legend");
    screenshot(std::string("error-") + kind);
  }
  EXPECT_NE(text(".legend").find("67.02 pixels per degree"), std::string::npos);
  page("viewer.set({error: 'smape'});");
  const double smape = evaluateMetric("smape", path_, reference_).value;
  EXPECT_NEAR(page("return painter.plane('smape', 1).mean;").get<double>(), smape, 1e-6);
}

// Images that take several bands, of numbers that both sides make exactly.
TEST_F(ErrorMapsTest, PixelsAreThoseOfTheProgramAcrossBands) {
  constexpr uint32_t kWidth = 1600, kHeight = 70;
  const auto value = [](uint32_t i, uint32_t seed) {
    return float(((i + seed) * 2654435761u >> 8) % 256u) / 256.0f;
  };
  Image image(kWidth, kHeight), reference(kWidth, kHeight);
  for (uint32_t i = 0; i < 3 * kWidth * kHeight; ++i) {
    reference.pixels[i / 3][int(i % 3)] = float(i / 3 / 37 % 64) / 64.0f;
    image.pixels[i / 3][int(i % 3)] = reference.pixels[i / 3][int(i % 3)] + 0.25f * value(i, 1);
  }
  const Json maps = page(R"(
    const width = 1600, height = 70, count = 3 * width * height;
    const value = (i, seed) => (Math.imul(i + seed, 2654435761) >>> 8) % 256 / 256;
    const made = fill => ({width, height, nonfinite: [],
                           data: Float32Array.from({length: count}, (_, i) => fill(i))});
    const base = i => Math.floor(Math.floor(i / 3) / 37) % 64 / 64;
    const reference = made(base), image = made(i => base(i) + 0.25 * value(i, 1));
    return ['ssim', 'flip_ldr'].map(kind => {
      const rest = new painter.rest.constructor([reference, image]);
      rest.begin(kind, 0, [1], 0);
      while (rest.work(rest.round)) {}
      return Array.from(rest.map(kind, 1, 0).values);
    });)");
  const std::vector<double> expected[] = {ssimPerPixel(image, reference),
                                          flipLdrPerPixel(image, reference)};
  for (size_t k = 0; k < 2; ++k) {
    const std::vector<double> map = maps[k];
    ASSERT_EQ(map.size(), expected[k].size());
    double worst = 0.0;
    for (size_t i = 0; i < map.size(); ++i)
      worst = std::max(worst, std::abs(map[i] - expected[k][i]));
    EXPECT_LT(worst, 1e-6) << kRestKinds[k];
  }
}

// The map is of the last rest until the new picture has rested, too.
TEST_F(ErrorMapsTest, MapsAreOfPicturesAtRest) {
  page("viewer.set({mode: 'single', current: 1, error: 'ssim'});");
  waitForMaps("ssim");
  EXPECT_EQ(names().front(), "2  path \u2013 SSIM");
  const double before = shownMean(2);
  page(R"(viewer.setImage(1, {data: images[1].data.map(value => 0.5 * value)});
    viewer.draw();)");
  EXPECT_EQ(names().front(), "2  path \u2013 SSIM (of the last rest)");
  EXPECT_EQ(shownMean(2), before);
  waitForMaps("ssim");
  EXPECT_EQ(names().front(), "2  path \u2013 SSIM");
  EXPECT_NE(shownMean(2), before);

  // A change stops what is computed; a picture of another epoch has no map of this one.
  const Json seen = page(R"(
    const {rest} = painter, notes = [];
    viewer.setImage(1, {data: Float32Array.from(images[0].data)});
    rest.begin('ssim', 0, [1], 0);
    rest.beginNext(rest.round);
    rest.round.steps.next();
    notes.push(rest.note('ssim', 1, 0));
    viewer.setImage(1, {data: images[1].data.map(value => 0.25 * value)});
    rest.work(rest.round);
    notes.push(rest.round.at, rest.map('ssim', 1, 0).version < images[1].version);
    images[0].epoch = images[1].epoch = 9;
    notes.push(rest.map('ssim', 1, 0), rest.note('ssim', 1, 0));
    return notes;)");
  EXPECT_EQ(seen,
            (Json{"of the last rest, computing 0 %", -1, true, nullptr, "once the picture rests"}));
}

TEST_F(ErrorMapsTest, WipeOfTwoErrors) {
  page("viewer.set({mode: 'wipe', current: 1, error: 'absolute', wipe: 0.5});");
  EXPECT_EQ(names(), (std::vector<std::string>{"1  reference", "2  path \u2013 absolute error"}))
      << "left is what is compared with";
  press("d", "KeyD");
  EXPECT_EQ(state("left"), "2") << "the next one that is not right of it";
  EXPECT_EQ(state("compare"), "0");
  EXPECT_EQ(names(), (std::vector<std::string>{"3  gi unbiased \u2013 absolute error",
                                               "2  path \u2013 absolute error"}));
  const auto error = [&](const Image& image, uint32_t x, uint32_t y) {
    const glm::vec3 d = image.at(x, y) - reference_.at(x, y);
    return (std::abs(d.x) + std::abs(d.y) + std::abs(d.z)) / 3.0f;
  };
  const auto colour = [&](float value) {
    return page(fmt::format("const {{map}} = painter.errorScale(), at = 3 * "
                            "painter.errorScale().index({}); return [map[at], map[at + 1], "
                            "map[at + 2]];",
                            value))
        .get<std::vector<int>>();
  };
  for (const auto& [x, y] : {std::pair(5u, 20u), std::pair(25u, 30u)}) {
    EXPECT_EQ(canvasColour(pixelPosition(x, y)), colour(error(other_, x, y))) << x;
    const uint32_t right = x + 34;
    EXPECT_EQ(canvasColour(pixelPosition(right, y)), colour(error(path_, right, y))) << right;
  }
  pointAt(25, 30);
  EXPECT_NEAR(status().error, error(other_, 25, 30), 0.006f * error(other_, 25, 30));
  EXPECT_EQ(status().values.count("gi unbiased"), 1u);
  EXPECT_EQ(status().values.count("path"), 0u);
  EXPECT_EQ(attribute(".stage canvas", "aria-label"),
            "gi unbiased, absolute error against reference left of the divider, path, absolute "
            "error against reference right of it");
  screenshot("wipe-errors");
  // By the table: what is compared with alone is a picture, on either side.
  click(".images tbody tr:nth-child(2) .compare");
  click(".images tbody tr:nth-child(1) .left");
  EXPECT_EQ(names(), (std::vector<std::string>{"1  reference \u2013 absolute error", "2  path"}));
  click(".images tbody tr:nth-child(2) .left");
  EXPECT_EQ(state("left"), "-1") << "the same as what is compared with";
}

TEST_F(ErrorMapsTest, InsetsHaveTheirOwnErrors) {
  page("viewer.set({mode: 'single', current: 1});");
  pointAt(40, 10);
  press("I", "KeyI", true);
  browser_->evaluate("document.querySelector('.viewer').viewer.zoom(4)");
  settle();
  press("I", "KeyI", true);
  press("f", "KeyF");
  EXPECT_EQ(texts(".inset code").size(), 2u);
  EXPECT_EQ(texts(".inset code")[0], "37,8,8,5");
  const std::vector<std::string> captions = texts(".inset-captions p");
  ASSERT_EQ(captions.size(), 6u);
  for (size_t k = 0; k < 2; ++k) {
    uint32_t x = 0, y = 0, width = 0, height = 0;
    ASSERT_EQ(std::sscanf(texts(".inset code")[k].c_str(), "%u,%u,%u,%u", &x, &y, &width, &height),
              4);
    MetricOptions options;
    options.mask.assign(reference_.pixels.size(), 0);
    for (uint32_t row = y; row < y + height; ++row)
      for (uint32_t column = x; column < x + width; ++column)
        options.mask[row * kSampleWidth + column] = 1;
    EXPECT_EQ(captions[3 * k], "reference") << "no error against itself";
    for (size_t i : {1u, 2u}) {
      const Image& image = i == 1 ? path_ : other_;
      double mse = 0.0, relmse = 0.0;
      const std::string& caption = captions[3 * k + i];
      ASSERT_EQ(
          std::sscanf(caption.c_str() + caption.find("MSE"), "MSE %lfrelMSE %lf", &mse, &relmse), 2)
          << caption;
      const double expected = evaluateMetric("mse", image, reference_, options).value;
      EXPECT_NEAR(mse, expected, 0.006 * expected) << caption;
      const double relative = evaluateMetric("relmse_e1e-2", image, reference_, options).value;
      EXPECT_NEAR(relmse, relative, 0.006 * relative) << caption;
    }
  }
  // The crop of an image is its pixels, and its frame is in the picture.
  const Json colours = page(R"(
    const canvas = document.querySelector('.inset canvas'), {views} = viewer.insets.boxes[0].stage;
    const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d');
    copy.drawImage(canvas, 0, 0);
    const ratio = canvas.width / viewer.insets.boxes[0].stage.width, {x, width, height} = views[2];
    const at = [x + width * 2.5 / 8, height * 1.5 / 5].map(value => Math.floor(ratio * value));
    const encoded = painter.pixelColour({image: 2, isError: false}, 64 * (8 + 1) + 37 + 2);
    return [Array.from(copy.getImageData(...at, 1, 1).data.slice(0, 3)),
            [encoded & 255, encoded >> 8 & 255, encoded >> 16 & 255]];)");
  EXPECT_EQ(colours[0], colours[1]);
  const std::vector<int> frame = canvasColour(pixelPosition(36.5, 9.5));
  EXPECT_GT(frame[0], 2 * frame[2]) << "red, between dark edges";
  screenshot("insets");
  for (int i = 0; i < 3; ++i) press("I", "KeyI", true);
  EXPECT_EQ(texts(".inset").size(), 4u) << "no more than four";
  page("viewer.insets.remove(3);");
  click(".inset button");
  EXPECT_EQ(texts(".inset").size(), 2u);
  EXPECT_NE(texts(".inset code")[0], "37,8,8,5") << "the first one was taken away";
  page("viewer.set({rectangle: [5, 3, 15, 9]});");
  press("I", "KeyI", true);
  EXPECT_EQ(texts(".inset code")[2], "5,3,10,6") << "the chosen rectangle";
}

}  // namespace
}  // namespace restlab::report_test
