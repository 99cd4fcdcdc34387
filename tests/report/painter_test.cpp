// Colouring of a viewer's pictures: new versions of images, images without data, overlays, and
// WebGL2 compared with the tables.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/image/io/layer_colors.h"
#include "core/image/metrics/metrics.h"
#include "tests/report/page.h"

namespace restlab::report_test {
namespace {

class PainterTest : public PageTest {
 protected:
  void SetUp() override {
    PageTest::SetUp();
    if (!browser_) return;
    open(sampleModel(folder_.path()));
    for (const char* name : {"reference", "path", "gi"}) {
      const auto file = folder_.path() / "images" / (std::string(name) + ".exr");
      images_.push_back(readExr(file).layers.at(""));
    }
  }
  // Returns the value of the body of a function that can use the viewer, its painter and these
  // helpers: bytes(layer) reads a canvas; state(change); renew(i, data) gives image i a new
  // version.
  Json page(const std::string& body) {
    const Json value = browser_->evaluate(R"((async () => {
      const viewer = document.querySelector('.viewer').viewer, {painter, images} = viewer;
      const bytes = layer => {
        const context = new OffscreenCanvas(layer.width, layer.height).getContext('2d');
        context.drawImage(layer, 0, 0);
        return context.getImageData(0, 0, layer.width, layer.height).data;
      };
      const state = change => Object.assign(viewer.state, change);
      const renew = (i, data) => {
        images[i].data = data;
        images[i].version = (images[i].version || 0) + 1;
      };
      )" + body + "})()");
    settle();
    return value;
  }

  std::vector<Image> images_;  // reference, path, gi
};

// Byte of an sRGB picture (IEC 61966-2-1).
int srgb(float linear) {
  if (!(linear > 0.0f)) return 0;
  const double x = double(linear);
  const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
  return int(std::min(255.0, encoded * 255.0 + 0.5));
}

TEST_F(PainterTest, EveryByteIsTheSrgbOfTheFile) {
  for (const double stops : {0.0, -7.5, 3.0}) {
    for (size_t i = 0; i < images_.size(); ++i) {
      const std::vector<int> bytes = page(
          fmt::format("state({{stops: {}}});"
                      "return Array.from(bytes(painter.layer({{image: {}, isError: false}})));",
                      stops, i));
      ASSERT_EQ(bytes.size(), 4 * images_[i].pixels.size());
      for (size_t k = 0; k < images_[i].pixels.size(); ++k) {
        const glm::vec3& p = images_[i].pixels[k];
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) continue;
        for (int c = 0; c < 3; ++c) {
          const float shown = float(2.0 * std::exp2(stops)) * p[c];
          // A value close to a level's border may round to either level.
          const int near[] = {srgb(shown * (1.0f - 1e-6f)), srgb(shown * (1.0f + 1e-6f))};
          const int byte = bytes[4 * k + size_t(c)];
          ASSERT_TRUE(byte == near[0] || byte == near[1])
              << "image " << i << ", pixel " << k << ", " << stops << " EV: " << byte << " for "
              << near[0];
        }
      }
    }
  }
}

TEST_F(PainterTest, NewVersionChangesPictureAndError) {
  page("viewer.set({mode: 'single', current: 1, error: 'none'});");
  const Position at = pixelPosition(30, 30);
  const glm::vec3 before = images_[1].at(30, 30);
  ASSERT_EQ(canvasColour(at)[0], srgb(2.0f * before.x));
  page("renew(1, images[1].data.map(value => 0.5 * value)); viewer.set({});");
  EXPECT_EQ(canvasColour(at)[0], srgb(before.x)) << "half as bright";

  const char* kMean = ".images tbody tr:nth-child(2) [data-part=mean]";
  page("viewer.set({error: 'absolute'});");
  Image half = images_[1];
  for (glm::vec3& pixel : half.pixels) pixel *= 0.5f;
  const double first = evaluateMetric("mae", half, images_[0]).value;
  EXPECT_NEAR(std::stod(text(kMean)), first, 0.006 * first);
  const std::vector<int> shown = canvasColour(at);
  // Change the data within the same array, too.
  page("renew(1, images[1].data.map(value => 3 * value)); viewer.set({});");
  for (glm::vec3& pixel : half.pixels) pixel *= 3.0f;
  const double second = evaluateMetric("mae", half, images_[0]).value;
  EXPECT_NEAR(std::stod(text(kMean)), second, 0.006 * second);
  EXPECT_NE(canvasColour(at), shown);
  // A new version of the reference changes the error, too.
  page("renew(0, Float32Array.from(images[1].data)); viewer.set({});");
  EXPECT_EQ(text(kMean), "0");
}

TEST_F(PainterTest, MovingColoursNothing) {
  page("viewer.set({mode: 'wipe', error: 'absolute', wipe: 0.5});");
  settle();
  const Json before = page("return painter.cache.made + painter.planes.made;");
  EXPECT_GT(before, 0);
  page(R"(for (let i = 0; i < 5; ++i) {
      viewer.zoom(1.5, 100, 100);
      viewer.camera.pan(7, -3);
      viewer.set({wipe: 0.1 * i});
      await new Promise(requestAnimationFrame);
    })");
  EXPECT_EQ(page("return painter.cache.made + painter.planes.made;"), before);
}

TEST_F(PainterTest, RangeOfErrorsIsSteady) {
  // Scales the error of both methods by each factor, a new version each time, and returns the range
  // after each.
  const auto ranges = [&](const std::string& factors) {
    return page(
               "state({error: 'absolute', compare: 0, stops: 0});"
               "window.firsts = window.firsts || images.map(image => image.data);"
               "return [" +
               factors + R"(].map(factor => {
      for (const i of [1, 2]) {
        renew(i, firsts[i].map((value, k) => firsts[0][k] + factor * (value - firsts[0][k])));
      }
      return painter.errorScale().hi;
    });)")
        .get<std::vector<double>>();
  };
  const std::vector<double> first = ranges("1, 1.3, 0.8, 1.4, 0.7, 1.3, 1");
  for (const double range : first) EXPECT_EQ(range, first[0]) << "noise does not move it";
  for (const double range : ranges("0.45, 0.45, 0.45, 0.45, 0.45, 0.45, 0.45, 0.45, 0.45")) {
    EXPECT_EQ(range, first[0]) << "smaller, but well seen";
  }
  const std::vector<double> falling = ranges("0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1");
  EXPECT_EQ(falling[6], first[0]);
  EXPECT_NEAR(falling[7], 0.1 * first[0], 1e-6 * first[0]) << "eight in a row";
  EXPECT_EQ(falling[8], falling[7]);
  EXPECT_NEAR(ranges("1000")[0], 1000.0 * first[0], 1e-3 * first[0]) << "another picture";
}

TEST_F(PainterTest, ImageWithoutDataIsNothing) {
  const Json seen = page(R"(
    const found = [], held = images[2].data;
    state({error: 'absolute', compare: 0});
    renew(1, images[1].data);
    images[2].data = null;
    for (const error of ['signed', 'absolute', 'squared', 'relative', 'smape']) {
      state({error});
      found.push(painter.plane(error, 2), painter.layer({image: 2, isError: true}),
                 painter.texts({image: 2, isError: true}, 0).length,
                 painter.isLight({image: 2, isError: true}, 0));
      if (!(painter.errorScale().hi > 0) || !painter.layer({image: 1, isError: true})) return error;
    }
    for (const tone of ['srgb', 'false']) {
      state({tone});
      found.push(painter.layer({image: 2, isError: false}),
                 painter.texts({image: 2, isError: false}, 0).length,
                 painter.isLight({image: 2, isError: false}, 0));
    }
    // Nothing to compare with; then not as large.
    for (const data of [null, images[0].data.subarray(3)]) {
      const whole = images[0].data;
      renew(0, data);
      found.push(painter.plane('signed', 1), painter.layer({image: 1, isError: true}));
      if (!(painter.errorScale().hi > 0)) return 'range';
      renew(0, whole);
    }
    state({tone: 'srgb', error: 'none'});
    renew(2, held);
    return found;)");
  ASSERT_TRUE(seen.is_array()) << seen;
  for (const Json& value : seen)
    EXPECT_TRUE(value.is_null() || value == 0 || value == false) << seen;
}

TEST_F(PainterTest, OverlayHasItsOwnColours) {
  const Json seen = page(R"(
    const count = images[1].width * images[1].height, view = {image: 1, isError: false};
    const found = [painter.overlayLayer(view), painter.overlayScale(1)];
    const over = (data, version, name) => {
      images[1].overlay = {data, version, unit: '', name};
      const {lo, hi} = painter.overlayScale(1), layer = painter.overlayLayer(view);
      found.push([lo, hi, layer.width, layer.height,
                  ...[0, 1, 2].map(i => bytes(layer).slice(4 * i, 4 * i + 3).join(' '))]);
    };
    const age = Float32Array.from({length: count}, (_, i) => i === 0 ? 0 : i === 2 ? NaN : 20);
    over(age, 1, 'age');
    over(Float32Array.from({length: 3 * count}, (_, i) => age[Math.floor(i / 3)]), 2, 'age');
    over(age.map(value => 10 - value), 1, 'difference');
    images[1].overlay = {data: new Float32Array(5), version: 1, unit: '', name: 'other size'};
    found.push(painter.overlayLayer(view));
    images[1].overlay = null;
    found.push(painter.overlayLayer(view));
    return found;)");
  const Json age = {0, 20, kSampleWidth, kSampleHeight, "7 7 12", "253 247 184", "255 0 255"};
  const Json difference = {-10,        10,         kSampleWidth, kSampleHeight,
                           "127 39 4", "8 48 107", "255 0 255"};
  EXPECT_EQ(seen, (Json{nullptr, nullptr, age, age, difference, nullptr, nullptr}));
}

// IDs have the colours of `render --aov --png`, which differ even for consecutive numbers.
TEST_F(PainterTest, LayersOfNamesHaveAColourEach) {
  const std::vector<float> names = {0.0f, 1.0f, 2.0f, 70001.0f, 1.0f, 16777215.0f};
  Image given(uint32_t(names.size()), 1);
  for (size_t i = 0; i < names.size(); ++i) given.pixels[i] = glm::vec3(names[i]);
  const Image colours = falseColors(given);
  const Json seen = page(R"(
    const count = images[1].width * images[1].height, view = {image: 1, isError: false};
    const names = )" + Json(names).dump() +
                         R"(;
    const data = Float32Array.from({length: 3 * count}, (_, i) => names[Math.floor(i / 3)] || 0);
    data.fill(NaN, 3 * 6, 3 * 7);
    images[1].overlay = {data, version: 1, unit: '', name: 'object', kind: 'name'};
    const layer = painter.overlayLayer(view);
    const found = [Array.from(bytes(layer).slice(0, 28)), painter.overlayScale(1),
                   painter.overlayText(1)];
    images[1].overlay = null;
    return found;)");
  for (size_t i = 0; i < names.size(); ++i) {
    for (int c = 0; c < 3; ++c)
      EXPECT_EQ(seen[0][4 * i + size_t(c)], srgb(colours.pixels[i][c])) << names[i];
  }
  EXPECT_EQ(seen[0][24], 255) << "no number is no name";
  EXPECT_EQ(seen[0][25], 0);
  EXPECT_EQ(seen[1], nullptr) << "names have no scale";
  EXPECT_EQ(seen[2], ": one colour a number");
}

// Each component has its own colour: no sum shows where a normal points.
TEST_F(PainterTest, LayersOfVectorsShowTheirComponents) {
  const Json seen = page(R"(
    const count = images[1].width * images[1].height, view = {image: 1, isError: false};
    const found = [];
    for (const kind of ['vector', 'vector2', 'colour', 'radiance']) {
      const data = new Float32Array(3 * count);
      data.set([1, 0, 0, -1, 0, 0, 0, 1, 0, 0, 0, -1, 0.5, 0.5, NaN]);
      for (let i = 15; i < data.length; ++i) data[i] = i % 2 ? 1 : -1;  // the range of most
      images[1].overlay = {data, version: 1, unit: '', name: kind, kind};
      const layer = bytes(painter.overlayLayer(view));
      found.push([0, 1, 2, 3, 4].map(i => layer.slice(4 * i, 4 * i + 3).join(' ')));
      found.push(painter.overlayText(1));
    }
    images[1].overlay = null;
    return found;)");
  EXPECT_EQ(seen[0], (Json{"255 128 128", "0 128 128", "128 255 128", "128 128 0", "255 0 255"}));
  EXPECT_EQ(seen[1], ": x, y, z as red, green, blue from -1 to 1; grey is 0");
  EXPECT_EQ(seen[2],
            (Json{"255 128 128", "0 128 128", "128 255 128", "128 128 128", "191 191 128"}))
      << "the third number is no component";
  EXPECT_EQ(seen[4][0], "255 0 0");
  EXPECT_EQ(seen[4][1], "0 0 0");
  EXPECT_EQ(seen[5], " as sRGB");
  EXPECT_EQ(seen[6][2], "0 " + std::to_string(srgb(float(page("return painter.factor;")))) + " 0");
}

// Compares pictures made by tables and by WebGL2. Returns [largest difference of a byte, number of
// bytes that differ by more than 1, number of bytes that differ].
constexpr const char* kCompare = R"(
  const compare = (i, isError) => {
    const pictures = ['2d', 'webgl2'].map(kind => {
      if (painter.use(kind) !== kind) throw new Error('no ' + kind);
      return bytes(painter.layer({image: i, isError}));
    });
    let most = 0, more = 0, any = 0, nothing = pictures[1].every(byte => byte === 0);
    if (nothing) return [256, 0, 0];
    for (let k = 0; k < pictures[0].length; ++k) {
      const differs = Math.abs(pictures[0][k] - pictures[1][k]);
      most = Math.max(most, differs);
      if (differs > 1) ++more;
      if (differs > 0) ++any;
    }
    return [most, more, any];
  };)";

// Each channel as a grey picture; what is not finite in any channel stays marked.
TEST_F(PainterTest, SingleChannelsAreGrey) {
  const auto valueOf = [](const glm::vec3& p, int channel) {
    return channel < 3 ? p[channel] : 0.2126f * p.x + 0.7152f * p.y + 0.0722f * p.z;
  };
  for (int channel = 0; channel < 4; ++channel) {
    const std::string name(1, "rgby"[channel]);
    const std::string start = "state({channel: '" + name + "'}); painter.use('2d');";
    for (size_t i = 0; i < images_.size(); ++i) {
      const std::string view = fmt::format("{{image: {}, isError: false}}", i);
      const std::vector<int> bytes =
          page(start + "return Array.from(bytes(painter.layer(" + view + ")));");
      ASSERT_EQ(bytes.size(), 4 * images_[i].pixels.size());
      for (size_t k = 0; k < images_[i].pixels.size(); ++k) {
        const glm::vec3& p = images_[i].pixels[k];
        const int* shown = &bytes[4 * k];
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
          EXPECT_TRUE(shown[0] != shown[1] || shown[1] != shown[2]) << name << " " << k;
          continue;
        }
        const float value = 2.0f * valueOf(p, channel);
        ASSERT_EQ(shown[0], shown[1]);
        ASSERT_EQ(shown[0], shown[2]);
        ASSERT_GE(shown[0], srgb(value * (1.0f - 1e-6f))) << name << ", pixel " << k;
        ASSERT_LE(shown[0], srgb(value * (1.0f + 1e-6f))) << name << ", pixel " << k;
      }
      const Json found = page(kCompare + start + fmt::format("return compare({}, false);", i));
      EXPECT_LE(found[0], 1) << "by WebGL, " << name << " of image " << i;
    }
  }
}

TEST_F(PainterTest, WebGlPaintsTheSame) {
  for (const int i : {0, 1, 2}) {
    for (const double stops : {0.0, -5.0, 4.5}) {
      const std::string start = kCompare + fmt::format("state({{stops: {}}});", stops);
      const Json image = page(start + fmt::format("return compare({}, false);", i));
      EXPECT_LE(image[0], 1) << "sRGB, image " << i;
      EXPECT_LE(image[2], kSampleWidth * kSampleHeight / 100) << "and that seldom";
      // Rounding may select the next colour of a map, which differs by at most six levels.
      const auto expectNear = [&](const Json& found, const std::string& what) {
        EXPECT_LE(found[0], 6) << what;
        EXPECT_LE(found[1], kSampleWidth * kSampleHeight / 500) << what;
      };
      expectNear(page(start + fmt::format("state({{tone: 'false'}}); const found = "
                                          "compare({}, false); state({{tone: 'srgb'}}); "
                                          "return found;",
                                          i)),
                 fmt::format("false colour, image {}, {} EV", i, stops));
      if (i == 0) continue;
      for (const char* error : {"signed", "absolute", "squared", "relative", "smape"}) {
        for (const bool log : {false, true}) {
          expectNear(page(start + fmt::format("state({{error: '{0}', log: {{'{0}': {1}}}}}); "
                                              "const found = compare({2}, true); "
                                              "state({{error: 'none', log: {{}}}}); "
                                              "return found;",
                                              error, log, i)),
                     fmt::format("{} error, log {}, image {}, {} EV", error, log, i, stops));
        }
      }
    }
  }
}

TEST_F(PainterTest, WebGlShowsNewVersionsAndLossIsMended) {
  EXPECT_EQ(page("return painter.kind;"), "2d") << "software is not chosen without being asked";
  EXPECT_EQ(page(std::string(kCompare) + R"(
    compare(1, false);
    renew(1, images[1].data.map(value => 0.5 * value));
    return compare(1, false)[0] <= 1;)"),
            true);
  EXPECT_EQ(page(R"(
    const lost = new Promise(done => { painter.onLost = () => done(true); });
    const before = bytes(painter.layer({image: 1, isError: false}));
    painter.gl.gl.getExtension('WEBGL_lose_context').loseContext();
    const after = bytes(painter.layer({image: 1, isError: false}));
    if (painter.kind !== '2d') return painter.kind;
    if (!after.every((byte, k) => Math.abs(byte - before[k]) <= 1)) return 'another picture';
    return await lost;)"),
            true);
}

}  // namespace
}  // namespace restlab::report_test
