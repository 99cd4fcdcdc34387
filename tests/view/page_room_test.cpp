// Room of the live page: what stands where, and what is cut, in windows of several sizes.
#include <fmt/format.h>

#include "tests/view/live_page.h"

namespace restlab::view_test {
namespace {

// Returns a problem a line: texts that are cut, and parts outside of the window.
constexpr const char* kProblems = R"(
  const problems = [], say = (what, one) => problems.push(
      `${what}: ${one.className || one.tagName} '${one.textContent.slice(0, 40)}'`);
  const isShown = one => one.offsetParent && getComputedStyle(one).visibility !== 'hidden';
  // Labels lose their end where there is no room, the status line is one of any length, and a select
  // shows what fits of its longest choice.
  const texts = ['button', 'output', 'td', 'th', '.legend-title', '.hint', '.line-text',
                 '.live-header h1', '.link', 'label > span', '.parameter > label'].join();
  for (const one of document.querySelectorAll(texts)) {
    if (!isShown(one) || getComputedStyle(one).display === 'inline') continue;
    const range = document.createRange();
    range.selectNodeContents(one);
    const width = Math.max(one.scrollWidth, range.getBoundingClientRect().width);
    if (width > one.clientWidth + 1 && one.clientWidth > 0) say('cut', one);
    const panel = one.closest('.panel, .numbers-box, .scroll');
    const box = one.getBoundingClientRect();
    if (panel && box.right > panel.getBoundingClientRect().right + 1) say('beyond its panel', one);
  }
  const root = document.documentElement;
  if (root.scrollWidth > innerWidth || document.body.scrollWidth > innerWidth) {
    problems.push('the page scrolls sideways');
  }
  if (document.body.scrollHeight > innerHeight + 1) problems.push('the page scrolls down');
  for (const name of ['.stage', '.toolbar', '.status', '.numbers-box', '.tabs', '.panel:not([hidden])']) {
    const box = document.querySelector(name).getBoundingClientRect();
    if (box.left < -1 || box.right > innerWidth + 1 || box.top < -1 || box.bottom > innerHeight + 1) {
      problems.push(`${name} is outside of the window`);
    }
    if (box.height < ({'.stage': 160, '.panel:not([hidden])': 100}[name] || 10)) {
      problems.push(`${name} has ${box.height} pixels`);
    }
  }
  return problems;)";

class PageRoomTest : public LivePageTest {
 protected:
  // Checks the windows, with and without a pixel below the pointer, with an error view.
  void expectRoom() {
    for (const auto& [width, height] : {std::pair(1400, 900), {1280, 800}, {900, 700}}) {
      SCOPED_TRACE(fmt::format("{}x{}", width, height));
      browser_->resize(width, height);
      for (const std::string mode : {"side", "wipe", "single"}) {
        const Json problems = page(fmt::format(R"(
          viewer.set({{mode: '{}', error: '{}'}});
          await frame(); await frame();
          viewer.pointer = [viewer.stage.width / 2 - 20, viewer.stage.height / 2];
          viewer.redraw();
          await frame(); await frame();)",
                                               mode, mode == "wipe" ? "squared" : "none") +
                                   kProblems);
        EXPECT_EQ(problems, Json::array()) << mode;
      }
    }
  }
};

TEST_F(PageRoomTest, OfResultsWithLongNamesAndNumbers) {
  std::filesystem::create_directory(folder() / "images");
  const auto write = [&](const std::string& name, float value) {
    writeExr(folder() / "images" / (name + ".exr"),
             {{{"", Image(64, 36, glm::vec3(value, 0.00123457f, -12.3457f * value))}},
              {{"kind", "image"}, {"render_time_s", "1.23457"}}});
  };
  for (int i = 1; i <= 5; ++i) {
    write(fmt::format("scene-all-restir_pt-unbiased-surflet-svgf_restir-{}", i),
          0.123457f + 0.9f * float(i));
  }
  write("scene-all-reference", 1.0f);
  write("scene-indirect-reference", 1.0f);
  write("scene-indirect-path", 1.5f);
  openFiles(readResultsImages(folder(), ""));
  expectRoom();
}

TEST_F(PageRoomTest, OfMethodsWithLongNamesAndNumbers) {
  facts_.request.scene = "door-ajar";  // has a long title
  facts_.warnings = {"one", "another"};
  open();
  page(R"(
    for (const pane of [0, 1]) {
      send({do: 'set', pane, key: 'integrator', value: 'restir_gi'});
      send({do: 'set', pane, key: 'mode', value: 'biased'});
      send({do: 'set', pane, key: 'cache', value: 'voxel'});
      send({do: 'set', pane, key: 'denoiser', value: 'svgf_restir'});
    }
    send({do: 'pause', on: true});
    await until(() => page.state.paused && page.state.panes[1].denoiser === 'svgf_restir' &&
                      viewer.images.every(one => one.epoch === page.state.epoch));
    const interval = {value: 0.00123457, lo: -0.00123457, hi: 0.0123457};
    const {numbers} = page, last = structuredClone(page.last);
    for (const pane of last.panes) {
      Object.assign(pane, {mse: interval, relmse: interval, mse_newest: 0.00123457, frame: 123456,
                           relmse_newest: 0.123457, frames_measured: 123456, ms: 1234.57,
                           energy: {value: 0.9971, lo: 0.9951, hi: 0.9991}});
    }
    last.panes[1].energy = {value: 1, lo: 0.999, hi: 1.001};
    page.showNumbers(last);
    page.showNumbers = () => {};)");
  // Numbers of a row have the same digits after the point, and their whole value at hand.
  EXPECT_EQ(page("return Array.from(document.querySelectorAll('[data-number=energy] .value'), "
                 "one => one.textContent);"),
            (Json{"0.9971", "1.0000"}));
  EXPECT_EQ(page("return document.querySelector('[data-number=mse_newest]').title;"), "0.00123457");
  expectRoom();
}

// The picture stays large, and the box of numbers as high as it is, whatever stands below.
TEST_F(PageRoomTest, ThePictureStaysInSight) {
  open();
  page("send({do: 'pause', on: true}); await until(() => page.state.paused);");
  const Json shares = page(R"(
    viewer.set({histogram: true, rectangle: [1, 1, 9, 9],
                insets: [[0, 0, 0.5, 0.5], [0.5, 0.5, 0.2, 0.2]]});
    await frame(); await frame();
    const column = viewer.root, stage = document.querySelector('.stage');
    const share = () => {
      const box = stage.getBoundingClientRect();
      return [box.height > 0.45 * column.clientHeight,
              box.top >= column.getBoundingClientRect().top - 1 && box.bottom <= innerHeight];
    };
    column.scrollTop = 0;
    const above = share();
    column.scrollTop = 1e6;
    await frame();
    return [above, share(), column.scrollTop > 0];)");
  EXPECT_EQ(shares, (Json{{true, true}, {true, true}, true}));
  const Json heights = page(R"(
    const box = document.querySelector('.numbers-box'), {numbers} = page;
    const last = structuredClone(page.last), heights = [];
    for (const [health, busy] of [[{}, 0.5], [{dropped_weights: 12, non_finite: 3, a: 1, b: 2, c: 3,
                                               a_longer_name: 123456}, 9]]) {
      for (const pane of last.panes) pane.health = health;
      numbers.show({...last, busy});
      heights.push(box.scrollHeight);
    }
    return heights;)");
  EXPECT_EQ(heights[0], heights[1]);
}

// Picture and panel are seen together also where the window is narrower still.
TEST_F(PageRoomTest, APhoneHasThePanelsBelow) {
  open();
  browser_->resize(600, 900);
  EXPECT_EQ(page(R"(await frame(); await frame();
    const [stage, tabs] = ['.stage', '.tabs'].map(
        name => document.querySelector(name).getBoundingClientRect());
    return [stage.height > 150, stage.bottom < tabs.top, tabs.bottom <= innerHeight,
            document.body.scrollHeight <= innerHeight, document.body.scrollWidth <= innerWidth];)"),
            (Json{true, true, true, true, true}));
}

TEST_F(PageRoomTest, ThePanelsAreWidenedByTheHandle) {
  open();
  const char* kWidth = "return Math.round(page.handle.width);";
  const int before = page(kWidth);
  const Json at = page(
      "const box = page.handle.element.getBoundingClientRect(); return [box.x + 3, box.y + 200];");
  browser_->drag(at[0], at[1], double(at[0]) - 80.0, at[1]);
  EXPECT_EQ(page(kWidth), before + 80);
  page("page.handle.element.focus();");
  press("ArrowRight");
  EXPECT_EQ(page(kWidth), before + 64);
  // The next page has it, too; a width from elsewhere is bounded.
  page("window.isOld = true; location.reload();");
  waitUntilShown(*browser_);
  EXPECT_EQ(page(kWidth), before + 64);
  page(
      "window.isOld = true; localStorage.setItem('restlab side width', '1e9'); "
      "location.reload();");
  waitUntilShown(*browser_);
  EXPECT_LE(int(page(kWidth)), 768) << "the picture keeps two fifths";
  page("page.handle.element.focus();");
  press("Home");
  EXPECT_EQ(page(kWidth), before);
}

// A label says error and time where there is room, and loses them from the end.
TEST_F(PageRoomTest, LabelsLoseTheirEndWithoutRoom) {
  open();
  const Json labels = page(R"(
    send({do: 'pause', on: true});
    await until(() => page.state.paused);
    page.showNumbers = () => {};
    Object.assign(viewer.images[0], {mse: 0.0123457, ms: 8.91});
    viewer.set({mode: 'single', current: 0, compare: 2, error: 'none'});
    const label = async () => {
      viewer.tagKey = null;
      viewer.redraw();
      await frame(); await frame();
      return viewer.tags.firstChild.textContent;
    };
    const texts = [await label()];
    viewer.set({error: 'squared'});
    texts.push(await label());
    viewer.set({error: 'none'});
    for (const width of [250, 170]) {
      viewer.frame.style.width = `${width}px`;
      texts.push(await label());
    }
    texts.push(viewer.tags.firstChild.title);
    return texts;)");
  const std::string name = "1  A: restir_gi, pixel", whole = name + "  MSE 0.0123  8.91 ms";
  EXPECT_EQ(labels[0], whole);
  EXPECT_EQ(labels[1].get<std::string>().find(name + " \u2013 squared error  mse "), 0u) << labels;
  EXPECT_EQ(labels[2], name + "  MSE 0.0123");
  EXPECT_EQ(labels[3], name);
  EXPECT_EQ(labels[4], whole);
}

TEST_F(PageRoomTest, WarningsStandInThePage) {
  facts_.warnings = {"a texture is missing", "a lamp has no area"};
  open();
  EXPECT_EQ(text("[data-list=warnings]"), "2 warnings");
  click("[data-list=warnings]");
  EXPECT_EQ(page("return document.querySelector('#list-warnings').innerText;"),
            "\u00d7\na texture is missing\na lamp has no area");
  browser_->press("Escape", "Escape");
  EXPECT_EQ(page("return [document.querySelector('#list-warnings').hidden, "
                 "document.querySelector('.stage-note').hidden];"),
            (Json{true, true}));
  page(
      "send({do: 'light', name: 'all', factor: 0}); send({do: 'restart'}); "
      "await until(() => !document.querySelector('.stage-note').hidden);");
  EXPECT_EQ(text("[data-list=warnings]"), "3 warnings");
  page(
      "send({do: 'light', name: 'all', factor: 1}); "
      "await until(() => document.querySelector('.stage-note').hidden);");
  EXPECT_EQ(text("[data-list=warnings]"), "2 warnings");
}

// Notices go by themselves but while they are read; errors stay; all are in the list.
TEST_F(PageRoomTest, NoticesGoByThemselves) {
  open();
  const Json seen = page(R"(
    const timers = new Map(), {setTimeout: set, clearTimeout: clear} = window;
    let next = 1;
    window.setTimeout = (run, ms) => { timers.set(next, run); return next++; };
    window.clearTimeout = id => timers.delete(id);
    const pass = () => [...timers].forEach(([id, run]) => { timers.delete(id); run(); });
    const texts = () => Array.from(page.messages.element.children, one => one.firstChild.textContent);
    try {
      page.messages.error('wrong');
      page.messages.notice('done');
      page.messages.notice('read');
      page.messages.element.lastChild.dispatchEvent(new Event('pointerenter'));
      pass();
      const while_ = texts();
      page.messages.element.lastChild.dispatchEvent(new Event('pointerleave'));
      pass();
      for (let i = 0; i < 60; ++i) page.messages.notice(`n${i}`);
      const isFull = texts();
      pass();
      return [while_, isFull, texts(), page.messages.kept.length, page.messages.kept[49].text];
    } finally {
      Object.assign(window, {setTimeout: set, clearTimeout: clear});
    })");
  EXPECT_EQ(
      seen,
      (Json{
          {"wrong", "read"}, {"wrong", "n55", "n56", "n57", "n58", "n59"}, {"wrong"}, 50, "n10"}));
  click("[data-list=messages]");
  EXPECT_EQ(page("return [document.querySelectorAll('#list-messages li').length, "
                 "document.querySelector('#list-messages').hidden];"),
            (Json{50, false}));
  click("canvas");
  EXPECT_EQ(page("return document.querySelector('#list-messages').hidden;"), true);
}

}  // namespace
}  // namespace restlab::view_test
