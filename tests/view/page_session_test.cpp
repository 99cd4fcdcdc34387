// Changes, probes and numbers of the live page match the program.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/image/metrics/metrics.h"
#include "tests/view/live_page.h"

namespace restlab::view_test {
namespace {

class PageSessionTest : public LivePageTest {
 protected:
  void SetUp() override {
    LivePageTest::SetUp();
    if (browser_) open();
  }
  std::string number(const std::string& name, int pane) {
    return page(fmt::format("return document.querySelectorAll('[data-number={}]')[{}].textContent;",
                            name, pane));
  }
  // Returns value and is_set of pane A's confidence_cap in the program's state.
  Json cap() {
    return page(
        "const {value, is_set} = page.state.panes[0].parameters.find("
        "one => one.name === 'confidence_cap'); return [value, is_set];");
  }
  Json epoch() { return page("return page.state.epoch;"); }
  void waitForEpochAfter(const Json& epoch) {
    page("await until(() => page.state.epoch > " + epoch.dump() + ");");
  }
  // Types into the field of pane A's confidence_cap.
  void type(const std::string& number) {
    const std::string selector = "[data-parameter=confidence_cap] input[type=number]";
    click(selector);
    page("document.querySelector('" + selector + "').select();");
    for (const char c : number) press(std::string(1, c));
    browser_->press("Enter", "Enter");
  }
};

TEST_F(PageSessionTest, ParametersChangeTheProgram) {
  page("await until(() => page.last.panes[0].frames_measured > 4);");
  pause();
  const Json before = cap(), first = epoch();
  EXPECT_EQ(before[1], false);
  EXPECT_NE(number("frames", 0).find(" / "), std::string::npos);
  type("7");
  waitForEpochAfter(first);
  EXPECT_EQ(cap(), (Json{7, true}));
  // While the panes are paused, nothing is measured for the new setting.
  page("await until(() => page.last.epoch === page.state.epoch);");
  const std::string frames = number("frames", 0);
  EXPECT_EQ(frames.substr(frames.find('/')), "/ 0");
  EXPECT_EQ(number("mse", 0).substr(0, 3), "\u2013") << "a dash";
  EXPECT_NE(number("mse", 1).substr(0, 3), "\u2013") << "the other pane's go on";
  page(R"(send({do: 'pause', on: false});
    await until(() => page.last.panes[0].frames_measured > 2);
    const [pane] = page.last.panes;
    if (pane.frames_measured > pane.age) throw new Error('old frames count');)");

  const Json second = epoch();
  page("viewer.root.focus();");
  press("z");
  waitForEpochAfter(second);
  EXPECT_EQ(cap(), before) << "undone";
  const Json third = epoch();
  press("Z");
  waitForEpochAfter(third);
  EXPECT_EQ(cap(), (Json{7, true})) << "redone";
  const Json fourth = epoch();
  click("[data-parameter=confidence_cap] .reset");
  waitForEpochAfter(fourth);
  EXPECT_EQ(cap(), before) << "back to the default";
  EXPECT_EQ(page("return document.querySelector('[data-parameter=confidence_cap] "
                 "input[type=number]').value;"),
            before[0].dump());
  EXPECT_EQ(page("return document.querySelector('[data-parameter=confidence_cap] "
                 ".reset').disabled;"),
            true);
  stop();
  EXPECT_TRUE(view_->settings().panes[0].config.parameters.empty());
}

TEST_F(PageSessionTest, RefusalsAreSaidAndTheFieldShowsWhatIs) {
  const Json before = cap();
  page("viewer.root.focus();");
  type("0");
  page("await until(() => document.querySelector('.message.error'));");
  EXPECT_NE(text(".message.error").find("between"), std::string::npos) << text(".message.error");
  EXPECT_EQ(cap(), before);
  EXPECT_EQ(page(R"(
    const field = document.querySelector('[data-parameter=confidence_cap] input[type=number]');
    const shown = field.value;
    field.value = '';
    field.dispatchEvent(new Event('change'));
    return [shown, field.value];)"),
            (Json{before[0].dump(), before[0].dump()}))
      << "at once, while it is edited";
  page("document.activeElement.blur();");
  EXPECT_EQ(page("return document.querySelector('[data-parameter=confidence_cap] "
                 "input[type=number]').value;"),
            before[0].dump());
}

// A layer's numbers stand where its colours do, and in the line of the pointer's pixel.
TEST_F(PageSessionTest, ALayerShowsItsNumbers) {
  page(R"(
    send({do: 'layer', pane: 0, name: 'confidence'});
    await until(() => viewer.images[0].overlay && viewer.images[0].overlay.data);
    send({do: 'pause', on: true});
    await until(() => page.state.paused);)");
  const Json shown = page(R"(
    viewer.set({mode: 'single', current: 0, opacity: 0.7});
    viewer.pointer = [viewer.stage.width / 2, viewer.stage.height / 2];
    viewer.draw();
    const view = viewer.stage.views[0], {painter} = viewer, {data} = viewer.images[0].overlay;
    const at = viewer.camera.indexIn(viewer.images[0], viewer.pixel), value = data[at];
    const seen = painter.texts(view, at), text = String(Number(value.toPrecision(3)));
    viewer.set({opacity: 0.3});
    return [value > 0, seen, text, painter.texts(view, at).length,
            viewer.status.textContent.includes(`confidence: ${text}`)];)");
  EXPECT_EQ(shown[0], true);
  EXPECT_EQ(shown[1], (Json{shown[2]}));
  EXPECT_EQ(shown[3], 3) << "R, G, B of the image below a faint layer";
  EXPECT_EQ(shown[4], true);
}

TEST_F(PageSessionTest, ClickProbesThePixel) {
  press("s");
  press("1");
  page("await until(() => page.last.panes[0].frame > 2);");
  pause();
  constexpr uint32_t kX = 20, kY = 30;
  const auto [x, y] = positionOf(kX, kY);
  browser_->click(x, y);
  page("await until(() => page.probe.answers[0] && page.probe.answers[1]);");
  EXPECT_EQ(page("return [page.tabs.current, page.probe.pixel];"),
            (Json{"probe", {{"x", kX}, {"y", kY}}}));
  // Rows of the table: name, text of A, text of B.
  const Json rows = page(
      "return Array.from(document.querySelectorAll('.probe-table tbody tr'), row "
      "=> [row.firstChild.firstChild.data, ...Array.from(row.querySelectorAll("
      "'td'), cell => cell.textContent)]);");
  const Json commands = page(
      "return Array.from(document.querySelectorAll('.probe .command code'), "
      "one => one.textContent);");
  EXPECT_GT(page("return viewer.images[0].marks.length;"), 0);
  stop();
  int compared = 0;
  for (const int pane : {0, 1}) {
    for (const ProbeValue& value : view_->session(size_t(pane)).probe(kX, kY)) {
      const auto row = std::find_if(rows.begin(), rows.end(),
                                    [&](const Json& one) { return one[0] == value.name; });
      ASSERT_NE(row, rows.end()) << value.name;
      std::istringstream is(value.value), shown((*row)[size_t(1 + pane)].get<std::string>());
      for (std::string word, other; is >> word >> std::ws && shown >> other;) {
        char* end = nullptr;
        const double number = std::strtod(word.c_str(), &end);
        if (*end != '\0') {
          EXPECT_EQ(other, word) << value.name;
          continue;
        }
        EXPECT_NEAR(std::stod(other), number, 6e-5 * std::abs(number)) << value.name;
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 5);
  ASSERT_EQ(commands.size(), 2u);
  const std::string end =
      fmt::format("--pixel {},{} --seed 1 --frame {}", kX, kY, view_->frames(0));
  EXPECT_NE(commands[0].get<std::string>().find(end), std::string::npos) << commands[0];
}

// A line leads from the probe to each donor, even if the picture is zoomed and panned; the table
// lists each donor as the program sent it.
TEST_F(PageSessionTest, DonorsAreDrawnAndListed) {
  press("s");
  press("1");
  page("await until(() => page.last.panes[0].frame > 2);");
  pause();
  const Json seen = page(R"(
    const answer = async (x, y) => {
      page.probe.ask({x, y});
      await until(() => page.probe.answers[0] && page.probe.answers[1]);
      return page.probe.answers[0];
    };
    let message = null, donor = null;
    for (let x = 10; x < 50 && !donor; ++x) {
      message = await answer(x, 20);
      donor = message.donors.find(one => one.reuse === 'space' && one.shift === 'accepted');
    }
    const {stage, camera} = viewer;
    const lineAt = () => {
      viewer.draw();
      const view = stage.views[0], ratio = window.devicePixelRatio || 1;
      const [x0, y0] = camera.toView(view, message.x + 0.5, message.y + 0.5);
      const [x1, y1] = camera.toView(view, donor.x + 0.5, donor.y + 0.5);
      const copy = new OffscreenCanvas(stage.canvas.width, stage.canvas.height).getContext('2d');
      copy.drawImage(stage.canvas, 0, 0);
      // Between the rings of both.
      const at = [0.7 * x0 + 0.3 * x1, 0.7 * y0 + 0.3 * y1].map(v => Math.floor(v * ratio));
      return Array.from(copy.getImageData(at[0], at[1], 1, 1).data.slice(0, 2));
    };
    viewer.set({stops: -8});  // a bright picture could have the colour of a line
    viewer.zoom(6);
    viewer.pan((camera.x - message.x) * camera.scale, (camera.y - message.y) * camera.scale);
    const zoomed = lineAt();
    viewer.pan(31, 22);
    const panned = lineAt();
    const marks = viewer.images[0].marks.map(({x, y, kind}) => [x, y, kind]);
    const rows = Array.from(document.querySelectorAll('.donors tbody tr'),
                            row => Array.from(row.children, cell => cell.textContent));
    // A segment of the path between two vertices that the camera sees.
    const {path} = message;
    const rgbAt = (x, y) => {
      viewer.draw();
      const ratio = window.devicePixelRatio || 1;
      const copy = new OffscreenCanvas(stage.canvas.width, stage.canvas.height).getContext('2d');
      copy.drawImage(stage.canvas, 0, 0);
      return Array.from(copy.getImageData(Math.floor(x * ratio), Math.floor(y * ratio), 1, 1).data
                            .slice(0, 3));
    };
    const x1 = () => camera.toView(stage.views[0], ...path[0].film);
    const vertex = rgbAt(...x1());
    const steps = Array.from(document.querySelectorAll('.path tbody tr'),
                             row => Array.from(row.children, cell => cell.textContent));
    page.probe.clear();
    return {message, donor, zoomed, panned, marks, rows, cleared: lineAt(), vertex, steps,
            vertexCleared: rgbAt(...x1()),
            left: document.querySelectorAll('.donors').length};)");
  ASSERT_FALSE(seen["donor"].is_null());
  // White and yellow are both bright in red and green; the line is thinner than two pixels.
  for (const char* when : {"zoomed", "panned"}) {
    EXPECT_GE(seen[when][0], 200) << when << seen[when];
    EXPECT_GE(seen[when][1], 160) << when << seen[when];
  }
  EXPECT_NE(seen["cleared"], seen["panned"]);
  // x1 is a blue square.
  EXPECT_EQ(seen["vertex"], Json({0x33, 0xcc, 0xff}));
  EXPECT_NE(seen["vertexCleared"], seen["vertex"]);
  const Json& path = seen["message"]["path"];
  ASSERT_EQ(seen["steps"].size(), path.size());
  for (size_t i = 0; i < path.size(); ++i) {
    EXPECT_EQ(seen["steps"][i][0], path[i]["name"]);
    EXPECT_EQ(seen["steps"][i][4], path[i]["reconnected"] ? "reconnected" : "replayed");
  }
  EXPECT_EQ(seen["left"], 0);
  const Json& donors = seen["message"]["donors"];
  ASSERT_EQ(seen["rows"].size(), donors.size());
  size_t marked = 1;
  for (size_t i = 0; i < donors.size(); ++i) {
    const Json& donor = donors[i];
    const bool isElsewhere =
        donor["x"] != seen["message"]["x"] || donor["y"] != seen["message"]["y"];
    const Json mark = {donor["x"], donor["y"], "donor"};
    const auto& marks = seen["marks"];
    EXPECT_EQ(std::count(marks.begin(), marks.end(), mark) > 0, isElsewhere) << donor;
    marked += isElsewhere;
    std::string from = fmt::format("{} {},{}", donor["reuse"].get<std::string>(), donor["x"].dump(),
                                   donor["y"].dump());
    if (donor["selected"]) from += " \u2713";
    EXPECT_EQ(seen["rows"][i][0], from);
    EXPECT_EQ(seen["rows"][i][1], donor["shift"]);
    EXPECT_EQ(seen["rows"][i][4] == "\u2013", donor["share"].is_null());
  }
  EXPECT_EQ(seen["marks"].size(), marked);
}

// Renders the frames again and compares them with the final halves of the reference. The reference
// still improves while frames are measured and changes their errors slightly: they agree within
// five percent.
TEST_F(PageSessionTest, RunningErrorIsThatOfTheFrames) {
  pause();
  page(R"(await until(() => page.last.reference.spp >= 768);
    const {epoch} = page.state;
    send({do: 'restart'});
    send({do: 'pause', on: false});
    await until(() => page.state.epoch > epoch && page.last.epoch === page.state.epoch &&
                      page.last.panes[0].frame >= 12);)");
  pause();
  const std::string words[] = {number("mse", 0), number("mse", 1)};
  const std::string frames = number("frames", 0);
  const Json last = page("return page.last.panes.map(pane => [pane.mse.value, pane.last_mse]);");
  stop();
  for (size_t i : {0u, 1u}) {
    const uint64_t count = view_->frames(i);
    ASSERT_EQ(view_->error(i).frames(), count);
    EXPECT_EQ(frames, fmt::format("{} / {}", count, count));
    EXPECT_EQ(last[i][0], view_->error(i).mse().value);
    EXPECT_NEAR(std::strtod(words[i].c_str(), nullptr), last[i][0], 0.006 * double(last[i][0]))
        << words[i];
    Session again(view_->loaded().scene, view_->settings().panes[i].config);
    double sum = 0.0, mse = 0.0;
    for (uint64_t frame = 0; frame < count; ++frame) {
      again.frame();
      mse = mseAgainstHalves(again.radiance(), view_->reference().half0(),
                             view_->reference().half1());
      sum += mse;
    }
    EXPECT_NEAR(double(last[i][0]) / (sum / double(count)), 1.0, 0.05) << "pane " << i;
    EXPECT_NEAR(double(last[i][1]) / mse, 1.0, 0.1) << "pane " << i;
  }
}

}  // namespace
}  // namespace restlab::view_test
