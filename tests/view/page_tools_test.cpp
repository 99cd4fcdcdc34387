// Tools of the viewer on a live page: the exposure of all pages, a rectangle over frames, words in
// pictures.
#include <fmt/format.h>
#include <zlib.h>

#include <cmath>
#include <fstream>

#include "core/image/metrics/metrics.h"
#include "experiments/report/report_html.h"
#include "experiments/runner/tables/preview.h"
#include "experiments/statistics/intervals.h"
#include "tests/view/live_page.h"

namespace restlab::view_test {
namespace {

class PageToolsTest : public LivePageTest {
 protected:
  static Image imageOf(const Json& data, uint32_t width, uint32_t height) {
    Image image(width, height);
    for (size_t i = 0; i < data.size(); ++i)
      image.pixels.at(i / 3)[int(i % 3)] = data[i].get<float>();
    return image;
  }
  void write(const std::string& name, const Image& image) const {
    writeExr(folder() / name, {{{"", image}}, {}});
  }
  // Serves images of files instead of what was served, and opens the page.
  void serveFiles(const std::vector<std::filesystem::path>& files,
                  const std::filesystem::path& reference) {
    stop();
    loop_.reset();
    ViewImages images = readViewImages(files, reference);
    const ViewSettings settings = settingsOf(images);
    view_.emplace(std::move(images), settings);
    serveView();
    browser_ = std::make_unique<Browser>(1280, 800);
    browser_->evaluate("void (location.href = " + Json(url()).dump() + ")");
    waitUntilShown(*browser_, {0});
  }
  double exposure() { return page("return viewer.painter.exposure;"); }
  void exposeAnew() {
    page("viewer.setExposure(1e-3); viewer.root.focus();");
    press("a");
  }
};

// One image has one exposure: as a reference that converged on a live page, in a file, in a report;
// found by the page and by the program.
TEST_F(PageToolsTest, TheExposureIsThatOfAllPages) {
  open();
  const Json noisy = page(R"(const first = viewer.images[0];
    await until(() => first.data && viewer.images[2].data);
    const found = viewer.painter.exposure;
    page.commands.find(one => one.id === 'auto-exposure').run(viewer);
    return [Array.from(viewer.images[2].data), viewer.painter.exposure,
            Array.from(first.data)];)");
  const Image reference = imageOf(noisy[0], 64, 36), first = imageOf(noisy[2], 64, 36);
  const double wanted = previewExposure(reference);
  EXPECT_NEAR(noisy[1], wanted, 1e-5 * wanted) << "live";
  write("r.exr", reference);
  write("a.exr", first);

  serveFiles({folder() / "a.exr"}, folder() / "r.exr");
  EXPECT_NEAR(exposure(), wanted, 1e-6 * wanted) << "files";
  exposeAnew();
  EXPECT_NEAR(exposure(), wanted, 1e-5 * wanted) << "by the page";
  page("viewer.set({current: 1, compare: 0});");
  exposeAnew();
  EXPECT_NEAR(exposure(), wanted, 1e-5 * wanted) << "whatever is shown";

  const auto image = [](const char* name, const char* role) {
    return Json{{"name", name}, {"file", fmt::format("{}.exr", name)}, {"role", role}};
  };
  Json block = {{"id", "one"},
                {"title", "one"},
                {"columns", Json::array()},
                {"rows", Json::array()},
                {"plots", Json::array()}};
  block["images"] = Json::array({image("r", "reference"), image("a", "method")});
  writeReport(folder(), {{"schema", 1}, {"title", "one"}, {"blocks", Json::array({block})}});
  Browser report(1000, 700);
  report.open(folder() / "report.html");
  report.waitFor("document.querySelector('.viewer').dataset.drawn !== undefined");
  report.press("a", "KeyA");
  EXPECT_NEAR(report.evaluate("document.querySelector('.viewer').viewer.painter.exposure"), wanted,
              1e-5 * wanted)
      << "report";

  serveFiles({folder() / "a.exr", folder() / "r.exr"}, "");
  const double ofFirst = previewExposure(first);
  EXPECT_NEAR(exposure(), ofFirst, 1e-6 * ofFirst) << "no reference: the first image";
  page("viewer.set({current: 1, compare: 1});");
  exposeAnew();
  EXPECT_NEAR(exposure(), ofFirst, 1e-5 * ofFirst);
}

// Numbers of a rectangle over frames: the mean of single frames, and the interval of eight batches.
TEST_F(PageToolsTest, ARectangleIsMeasuredOverFrames) {
  Image reference(20, 12);
  for (size_t i = 0; i < reference.pixels.size(); ++i)
    reference.pixels[i] = glm::vec3(0.1f + 0.01f * float(i % 7), 0.2f, 0.3f);
  write("r.exr", reference);
  write("a.exr", Image(20, 12, glm::vec3(0.25f)));
  serveFiles({folder() / "a.exr"}, folder() / "r.exr");
  constexpr size_t kFrames = 83;
  std::vector<double> frames, batches;
  Image crop(8, 6), beside(8, 6);
  for (uint32_t y = 0; y < 6; ++y)
    for (uint32_t x = 0; x < 8; ++x) beside.at(x, y) = reference.at(x + 4, y + 3);
  Json values = Json::array();
  for (size_t f = 0; f < kFrames; ++f) {
    values.push_back(0.25f + 0.05f * std::sin(float(f * f)));
    crop = Image(8, 6, glm::vec3(values.back().get<float>()));
    frames.push_back(evaluateMetric("relmse_e1e-2", crop, beside).value);
  }
  for (size_t b = 0; b < 8; ++b) {
    double sum = 0.0;
    const size_t from = b * kFrames / 8, to = (b + 1) * kFrames / 8;
    for (size_t f = from; f < to; ++f) sum += frames[f];
    batches.push_back(sum / double(to - from));
  }
  const Json found = page("viewer.set({compare: 1, rectangle: [4, 3, 12, 9]});" +
                          fmt::format("const values = {};", values.dump()) + R"(
    values.forEach((value, i) => {
      const change = {data: new Float32Array(720).fill(value), frame: 1000 + i};
      viewer.setImage(0, change);
      if (i % 7 === 0) viewer.setImage(0, change);  // sent again, it counts once
    });
    return viewer.tools.table.series[0].result();)");
  EXPECT_EQ(found["text"], "83 frames: 8 batches of them");
  double mean = 0.0;
  for (const double frame : frames) mean += frame / double(kFrames);
  const Json relmse = found["numbers"]["relmse"];
  EXPECT_NEAR(relmse["value"], mean, 1e-5 * mean);
  const Interval interval = meanInterval(batches);
  const double half = 0.5 * (interval.hi - interval.lo);
  EXPECT_NEAR(double(relmse["hi"]) - double(relmse["lo"]), 2.0 * half, 2e-3 * half);
  EXPECT_NEAR(0.5 * (double(relmse["hi"]) + double(relmse["lo"])), mean, 1e-5 * mean);
  page(
      "viewer.root.focus(); navigator.clipboard.writeText = async text => { window.copied = text; "
      "};");
  press("m");
  EXPECT_EQ(page("await until(() => window.copied); return copied.split(' --exp')[0];"),
            "--crop 4,3,8,6");
}

// Shift makes a moved camera faster, and chooses a rectangle otherwise; neither probes.
TEST_F(PageToolsTest, ShiftIsTheCamerasWhileItIsMoved) {
  open();
  press("s");
  press("c");
  const auto [x, y] = positionOf(20, 10);
  browser_->drag(x, y, x + 100.0, y + 60.0, true);
  EXPECT_EQ(page("await until(() => page.state.can_undo); return viewer.state.rectangle;"), nullptr)
      << "it looked around";
  press("c");
  browser_->drag(x, y, x + 100.0, y + 60.0, true);
  EXPECT_EQ(page("const [x0, y0, x1, y1] = viewer.state.rectangle; return [x0, y0, x1 > x0 + 2, "
                 "y1 > y0 + 2, page.probe.pixel];"),
            (Json{20, 10, true, true, nullptr}));
  page("viewer.root.focus();");
  press("Escape");
  EXPECT_EQ(page("return viewer.state.rectangle;"), nullptr);
}

// Returns the words of a PNG; a failure if a chunk is not as it must be.
std::map<std::string, std::string> wordsOf(const std::string& png) {
  std::map<std::string, std::string> words;
  const auto number = [&](size_t at) {
    uint32_t value = 0;
    for (size_t i = 0; i < 4; ++i) value = value << 8 | uint8_t(png.at(at + i));
    return value;
  };
  for (size_t at = 8; at < png.size();) {
    const size_t length = number(at);
    const std::string type = png.substr(at + 4, 4), content = png.substr(at + 8, length);
    EXPECT_EQ(number(at + 8 + length),
              crc32(0, reinterpret_cast<const Bytef*>(png.data() + at + 4), uInt(length + 4)))
        << type;
    at += 12 + length;
    if (type != "tEXt" && type != "iTXt") continue;
    const size_t end = content.find('\0');
    words[content.substr(0, end)] = content.substr(end + (type == "tEXt" ? 1 : 5));
  }
  return words;
}

TEST_F(PageToolsTest, PicturesSayWhatTheyShow) {
  open();
  page("await until(() => page.last.panes[1].frame > 2);");
  pause();
  page(R"(viewer.set({error: 'squared', mode: 'wipe', current: 0, channel: 'g'});
    viewer.setExposure(0.5);
    viewer.set({stops: 2});
    viewer.setImage(1, {name: 'B: \u00e9t\u00e9'});
    const made = URL.createObjectURL;
    URL.createObjectURL = blob => {
      window.saved = blob.arrayBuffer();
      return made.call(URL, blob);
    };
    HTMLAnchorElement.prototype.click = function() { window.savedAs = this.download; };
    viewer.root.focus();)");
  press("x");
  const Json bytes = page(
      "await until(() => window.saved); return Array.from(new Uint8Array(await window.saved));");
  EXPECT_EQ(page("return window.savedAs;"), "cornell-box.png");
  std::string png;
  for (const Json& byte : bytes) png += char(byte.get<int>());
  ASSERT_EQ(png.substr(1, 3), "PNG");
  const std::map<std::string, std::string> words = wordsOf(png);
  const std::map<std::string, std::string> expected = {
      {"kind", "screenshot"},
      {"scene", "cornell-box"},
      {"exposure", "2"},
      {"exposure_stops", "1"},
      {"error", "squared"},
      {"channel", "g"},
      {"A.integrator", "restir_gi"},
      {"B.integrator", "path"},
      {"compared_with", "reference"},
      {"width", "64"},
      {"height", "36"},
      {"images", "A: restir_gi, pixel, B: \u00e9t\u00e9, reference"}};
  for (const auto& [key, value] : expected)
    EXPECT_EQ(words.count(key) ? words.at(key) : "nothing", value) << key;
  EXPECT_EQ(words.at(words.count("frame") ? "frame" : "A.frame"),
            page("return String(page.last.panes[0].frame - 1);").get<std::string>());
  EXPECT_EQ(words.at("address"), page("return location.hash;").get<std::string>());
  EXPECT_EQ(words.at("address").find("http"), std::string::npos) << "no secret";
  EXPECT_EQ(words.at("version"), page("return page.hello.version;").get<std::string>());
  // It is still a picture.
  EXPECT_GT(page("return (await createImageBitmap(new Blob([await saved], {type: 'image/png'})))"
                 ".width;"),
            100);
}

}  // namespace
}  // namespace restlab::view_test
