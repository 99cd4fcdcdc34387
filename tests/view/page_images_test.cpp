// Live page that shows images of files, and a session's measurement and saved files.
#include <fmt/format.h>

#include "core/image/metrics/metrics.h"

#include <algorithm>
#include "tests/view/live_page.h"

namespace restlab::view_test {
namespace {

double mse(const Image& image, const Image& reference) {
  return mseAgainstHalves(image, reference, reference);
}

class PageImagesTest : public LivePageTest {
 protected:
  static Image striped(float value) {
    Image image(20, 12, glm::vec3(value));
    for (uint32_t x = 0; x < 20; ++x) image.at(x, 5) = {value, 0.5f * value, float(x) / 20.0f};
    return image;
  }
  // Opens a.exr, b.exr and, if wanted, the reference r.exr.
  void openImages(bool hasReference = true) {
    for (const char* name : {"a", "b"}) {
      writeExr(folder() / (std::string(name) + ".exr"),
               {{{"", striped(*name == 'a' ? 0.25f : 0.5f)}}, {}});
    }
    writeExr(folder() / "r.exr", {{{"", striped(0.75f)}}, {{"spp", "16"}}});
    openFiles(readViewImages({folder() / "a.exr", folder() / "b.exr"},
                             hasReference ? folder() / "r.exr" : ""));
  }
  // Opens a folder of results: the table t has m1 to m5, t-2 has m1 and m2, without a record.
  void openResults() {
    std::filesystem::create_directory(folder() / "images");
    const auto write = [&](const std::string& name, uint32_t width, float value) {
      writeExr(folder() / "images" / (name + ".exr"),
               {{{"", Image(width, 6, glm::vec3(value))}}, {}});
    };
    for (int i = 1; i <= 5; ++i) write("t-m" + std::to_string(i), 20, float(i) / 8.0f);
    write("t-reference", 20, 6.0f / 8.0f);
    write("t-2-m1", 10, 1.5f);
    write("t-2-m2", 10, 2.0f);
    write("t-2-reference", 10, 3.0f);
    openFiles(readResultsImages(folder(), ""));
  }
  std::string panel(const std::string& tab) {
    return page(
        fmt::format("page.openTab('{0}'); return document.querySelector('#panel-{0}')"
                    ".innerText;",
                    tab));
  }
};

TEST_F(PageImagesTest, ShowsThemAsItShowsMethods) {
  openImages();
  EXPECT_EQ(page("return viewer.images.map(image => image.name);"), (Json{"a", "b", "reference"}));
  for (int i : {0, 1}) {
    const double expected = mse(striped(i == 0 ? 0.25f : 0.5f), striped(0.75f));
    const double shown = page(fmt::format(
        "viewer.set({{error: 'squared', compare: 2}}); return viewer.painter.plane('squared', "
        "{}).mean;",
        i));
    EXPECT_NEAR(shown, expected, 1e-6 * expected);
    const double told = page(fmt::format("return page.last.panes[{}].mse.value;", i));
    EXPECT_NEAR(told, expected, 1e-6 * expected);
  }
  page("viewer.set({error: 'ssim'}); await until(() => viewer.painter.plane('ssim', 1));");
  EXPECT_NEAR(page("return viewer.painter.plane('ssim', 1).mean;").get<double>(),
              evaluateMetric("ssim", striped(0.5f), striped(0.75f)).value, 1e-5);
  // All pixels are exact.
  const Image b = striped(0.5f);
  const Json data = page("return Array.from(viewer.images[1].data);");
  ASSERT_EQ(data.size(), 3 * b.pixels.size());
  for (size_t i = 0; i < data.size(); ++i)
    ASSERT_EQ(data[i].get<float>(), b.pixels[i / 3][int(i % 3)]) << i;
}

TEST_F(PageImagesTest, SaysWhereThereIsNothingToChange) {
  openImages();
  EXPECT_NE(panel("methods").find("nothing to change"), std::string::npos) << panel("methods");
  EXPECT_NE(panel("scene").find("no camera"), std::string::npos) << panel("scene");
  EXPECT_NE(panel("plots").find("no frames to plot"), std::string::npos) << panel("plots");
  EXPECT_NE(panel("plots").find("nothing to measure"), std::string::npos) << panel("plots");
  EXPECT_EQ(panel("plots").find("on its way"), std::string::npos) << panel("plots");
  EXPECT_EQ(page("const ink = name => getComputedStyle([...document.querySelectorAll('.measure "
                 "button')].find(one => one.textContent === name)).color; const rule = "
                 "getComputedStyle(document.querySelector('.tabs')).borderBottomColor; "
                 "return [ink('measure') === rule, ink('cancel') === rule];"),
            (Json{true, true}))
      << "what does nothing looks so";
  EXPECT_NE(panel("probe").find("no pane shows one"), std::string::npos) << panel("probe");
  press("s");
  const auto [x, y] = positionOf(3, 4);
  browser_->click(x, y);
  page("await until(() => page.tabs.current === 'probe');");
  EXPECT_NE(panel("probe").find("no pane shows one"), std::string::npos) << panel("probe");
  for (const char* key : {"c", "o", "h", "R", "p", "M"}) press(key);
  page("await frame();");
  EXPECT_EQ(page("return [page.camera.isOn, page.camera.isOrbit, page.state.paused];"),
            (Json{false, false, false}));
  EXPECT_EQ(page("return document.querySelectorAll('.message.error').length;"), 0);
}

// Images have no times, no counts and no interval to wait for.
TEST_F(PageImagesTest, NumbersAreErrorsAlone) {
  openImages();
  EXPECT_EQ(page("return Array.from(document.querySelectorAll('.numbers-table th')).filter(one => "
                 "one.offsetParent).map(one => one.textContent);"),
            (Json{"image", "MSE", "relMSE", "energy", "a", "b"}))
      << "no file says a time";
  EXPECT_EQ(text("[data-number=energy]").size(), text("tr:last-child [data-number=energy]").size());
  page("page.last.busy = 9; page.numbers.show(page.last);");
  const std::string box = page("return document.querySelector('.numbers-box').innerText;");
  for (const char* word : {"yet", "counted", "load", "quiet", "spp,  ", "/spp"})
    EXPECT_EQ(box.find(word), std::string::npos) << word << " in " << box;
  EXPECT_NE(box.find("16 spp"), std::string::npos) << box;
}

TEST_F(PageImagesTest, NumbersOfAnImageBesideAMethod) {
  open();
  page(R"(send({do: 'set', pane: 1, key: 'source', value: 'reference'});
    await until(() => page.last.panes[1].ms === null && page.last.panes[0].frame > 1);
    await frame();)");
  const Json texts = page(
      "return ['frames', 'health', 'mse'].map(key => "
      "document.querySelectorAll(`[data-number=${key}]`)[1].innerText.trim());");
  EXPECT_EQ(texts, (Json{"\u2013", "\u2013", "\u2013"}));
  EXPECT_GT(page("return document.querySelector('[data-row=ms]').offsetHeight;"), 0);
}

// All images have keys, tables a choice; the chosen method stays.
TEST_F(PageImagesTest, OfResultsAreShownByKeysAndTables) {
  openResults();
  EXPECT_EQ(page("return viewer.images.map(image => image.name);"),
            (Json{"m1", "m2", "m3", "m4", "m5", "reference"}));
  press("s");
  for (int i = 1; i <= 6; ++i) {
    press(std::to_string(i));
    const Json shown = page(
        "await frame(); await frame(); return [viewer.stage.views.length, "
        "viewer.images[viewer.stage.views[0].image].data[0]];");
    EXPECT_EQ(shown[0], 1);
    EXPECT_FLOAT_EQ(shown[1], float(i) / 8.0f) << i;
  }
  press("2");
  press("PageDown");
  page("await until(() => viewer.images.length === 3 && viewer.images.every(one => one.data));");
  EXPECT_EQ(
      page("return [page.state.table, document.querySelector('.live-header select').value, "
           "viewer.images[viewer.state.current].name, viewer.images[viewer.state.compare].name, "
           "viewer.images.map(one => one.data[0]), viewer.camera.width, "
           "document.querySelectorAll('table.images tbody tr').length, "
           "document.querySelectorAll('.numbers-table tbody tr').length];"),
      (Json{"t-2", "t-2", "m2", "reference", {1.5, 2.0, 3.0}, 10, 3, 2}));
  page(R"(await until(() => decodeURIComponent(location.hash).includes('"table":"t-2"'));
    window.kept = location.hash;
    const select = document.querySelector('.live-header select');
    select.value = 't';
    select.dispatchEvent(new Event('change'));
    await until(() => page.state.table === 't' && location.hash !== window.kept);
    location.hash = window.kept;
    await until(() => page.state.table === 't-2');)");
}

TEST_F(PageImagesTest, CompareWithEachOtherWithoutAReference) {
  openImages(false);
  EXPECT_EQ(page("return viewer.images.map(image => image.name);"), (Json{"a", "b"}));
  const double expected = mse(striped(0.5f), striped(0.25f));
  const double shown = page(
      "viewer.set({error: 'squared', compare: 0}); return viewer.painter.plane('squared', "
      "1).mean;");
  EXPECT_NEAR(shown, expected, 1e-6 * expected);
  EXPECT_EQ(text("[data-number=reference]"), "no reference");
}

TEST_F(PageImagesTest, AMeasurementIsFollowedToItsReport) {
  facts_.program = program(
      "while [ ! -e go ]; do sleep 0.02; done\nmkdir -p \"$4\"\n"
      "echo '<!doctype html><title>a report</title>' > \"$4/report.html\"");
  open();
  page("viewer.root.focus();");
  press("M");
  page("await until(() => page.measurement.isRunning);");
  EXPECT_EQ(page("return [page.tabs.current, document.querySelector('.measure a').hidden, "
                 "document.querySelector('.measure progress').hidden];"),
            (Json{"plots", true, false}));
  std::ofstream(folder() / "go") << "";
  page("await until(() => page.measurement.state === 'finished');");
  EXPECT_EQ(page("return [document.querySelector('.measure a').hidden, "
                 "await (await fetch(document.querySelector('.measure a').href)).text()];"),
            (Json{false, "<!doctype html><title>a report</title>\n"}));
}

TEST_F(PageImagesTest, GivesTheCropThatIsShown) {
  open();
  press("s");
  page("viewer.set({stops: 1}); await frame(); viewer.zoom(4); await frame();");
  page(R"(navigator.clipboard.writeText = async text => { window.copied = text; };
    viewer.root.focus();)");
  press("m");
  const std::string text = page("await until(() => window.copied); return window.copied;");
  const Json view = page(
      "const view = viewer.stage.views[0], {camera} = viewer; return [camera.toImage(view, view.x, "
      "view.y), camera.toImage(view, view.x + view.width, view.y + view.height), "
      "viewer.painter.factor];");
  int x = 0, y = 0, width = 0, height = 0;
  double exposure = 0.0;
  ASSERT_EQ(std::sscanf(text.c_str(), "--crop %d,%d,%d,%d --exposure %lf", &x, &y, &width, &height,
                        &exposure),
            5)
      << text;
  EXPECT_EQ(x, std::max(0.0, std::floor(double(view[0][0]))));
  EXPECT_EQ(y, std::max(0.0, std::floor(double(view[0][1]))));
  EXPECT_EQ(x + width, std::min(64.0, std::ceil(double(view[1][0]))));
  EXPECT_EQ(y + height, std::min(36.0, std::ceil(double(view[1][1]))));
  EXPECT_LT(width, 64);
  EXPECT_NEAR(exposure, double(view[2]), 1e-5 * exposure);
  // With insets those, each as one crop.
  page("window.copied = ''; viewer.set({insets: [[0.25, 0.5, 0.25, 0.25], [0, 0, 0.5, 0.5]]});");
  press("m");
  const std::string crops = page("await until(() => window.copied); return window.copied;");
  EXPECT_EQ(crops.rfind("--crop 16,18,16,9 --crop 0,0,32,18 --exposure ", 0), 0u) << crops;
}

TEST_F(PageImagesTest, MapsComeWhenTheMethodsArePaused) {
  open();
  page(R"(send({do: 'pause', on: true});
    await until(() => page.state.paused);
    viewer.set({error: 'flip_ldr'});
    await until(() => [0, 1].every(i => viewer.painter.plane('flip_ldr', i)));)");
  const Json means = page("return [0, 1].map(i => viewer.painter.plane('flip_ldr', i).mean);");
  for (const Json& mean : means) EXPECT_GT(mean.get<double>(), 0.01) << means;
  EXPECT_NE(text(".legend").find("pixels per degree"), std::string::npos);
}

TEST_F(PageImagesTest, SavesThePictureAsItWasRendered) {
  open();
  page("await until(() => page.last.panes[1].frame > 2);");
  pause();
  page(R"(viewer.set({current: 1});
    const made = URL.createObjectURL;
    URL.createObjectURL = blob => {
      window.saved = blob.arrayBuffer();
      return made.call(URL, blob);
    };
    const {click} = HTMLAnchorElement.prototype;
    HTMLAnchorElement.prototype.click = function() { window.savedAs = this.download; };
    viewer.root.focus();)");
  press("X");
  const Json bytes = page(
      "await until(() => window.saved); return Array.from(new Uint8Array(await window.saved));");
  EXPECT_EQ(page("return window.savedAs;"), "cornell-box-B-path-accumulate.exr");
  std::ofstream file(folder() / "saved.exr", std::ios::binary);
  for (const Json& byte : bytes) file.put(char(byte.get<int>()));
  file.close();
  const Json shown = page("return Array.from(viewer.images[1].data);");
  const Image image = readExr(folder() / "saved.exr").layers.at("");
  ASSERT_EQ(shown.size(), 3 * image.pixels.size());
  for (size_t i = 0; i < shown.size(); ++i)
    ASSERT_EQ(shown[i].get<float>(), image.pixels[i / 3][int(i % 3)]) << i;
}

}  // namespace
}  // namespace restlab::view_test
