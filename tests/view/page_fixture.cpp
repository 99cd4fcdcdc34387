#include <fmt/format.h>

#include "experiments/view/view_page.h"

#include <algorithm>
#include <numeric>
#include "tests/view/live_page.h"

namespace restlab::view_test {

namespace {

// Records in window.seen, for each slot, the last frame and its time of arrival.
constexpr const char* kWatch = R"((() => {
  const page = document.body.page, show = page.showImage;
  window.seen = {};
  page.showImage = head => {
    window.seen[head.slot] = {frame: head.frame, time: performance.now()};
    show.call(page, head);
  };
})())";

}  // namespace

Key keyNamed(std::string name) {
  Key key;
  const auto takes = [&](const std::string& modifier) {
    if (name.size() <= modifier.size() || name.rfind(modifier, 0) != 0) return false;
    name = name.substr(modifier.size());
    return true;
  };
  key.control = takes("Ctrl+");
  key.alt = takes("Alt+");
  key.shift = takes("Shift+");
  key.key = key.code = name == "Space" ? " " : name;
  if (name == "Space") key.code = name;
  if (name.size() > 1) return key;
  const auto c = static_cast<unsigned char>(name[0]);
  static const std::map<char, std::pair<const char*, bool>> others = {{'+', {"NumpadAdd", false}},
                                                                      {'-', {"Minus", false}},
                                                                      {'=', {"Equal", false}},
                                                                      {'/', {"Slash", false}},
                                                                      {'?', {"Slash", true}}};
  if (std::isalpha(c)) {
    key.code = std::string("Key") + char(std::toupper(c));
    key.shift = key.shift || std::isupper(c);
    if (key.control && key.shift) key.key = std::string(1, char(std::toupper(c)));
  } else if (std::isdigit(c)) {
    key.code = "Digit" + name;
    if (key.shift) key.key = std::string(1, "=!\"#$%&/()"[c - '0']);
  } else {
    key.code = others.at(name[0]).first;
    key.shift = others.at(name[0]).second;
  }
  return key;
}

void LivePageTest::SetUp() {
  ViewLoopTest::SetUp();
  if (report_test::findBrowser().empty())
    GTEST_SKIP() << "Chromium is not installed (package chromium)";
  browser_ = std::make_unique<Browser>(1280, 800);
}

void LivePageTest::TearDown() {
  if (browser_) expectNothingWrong(*browser_);
  browser_.reset();  // first: a page complains when its program ends
  ViewLoopTest::TearDown();
}

void LivePageTest::expectNothingWrong(const Browser& browser) const {
  EXPECT_TRUE(browser.complaints().empty()) << browser.complaints().front();
  if (!loop_) return;
  const std::string origin = url().substr(0, url().find('/', 7) + 1);
  for (const std::string& request : browser.requests()) {
    EXPECT_TRUE(request.rfind(origin, 0) == 0 || request.rfind("blob:" + origin, 0) == 0)
        << request;
  }
}

std::vector<SessionConfig> LivePageTest::smallPanes() {
  std::vector<SessionConfig> panes = {smallPane("restir_gi"), smallPane("path", "accumulate")};
  for (SessionConfig& pane : panes) {
    pane.width = 64;
    pane.height = 36;
  }
  return panes;
}

void LivePageTest::serve(const std::vector<SessionConfig>& panes) {
  view_.emplace(prepareScene(facts_.request), panes, ReferenceStore{});
  serveView();
}

void LivePageTest::serveView() {
  ViewServerOptions options;
  options.page = viewPage();
  loop_ = std::make_unique<ViewLoop>(*view_, facts_, options, folder());
  thread_ = std::thread([this] {
    try {
      loop_->run();
    } catch (const std::exception& error) {
      ADD_FAILURE() << "the loop has ended: " << error.what();
    }
  });
}

void LivePageTest::openFiles(ViewImages images) {
  std::vector<int> all(images.list.size() + (images.reference ? 1 : 0));
  std::iota(all.begin(), all.end(), 0);
  const ViewSettings settings = settingsOf(images);
  view_.emplace(std::move(images), settings);
  serveView();
  browser_->evaluate("void (location.href = " + Json(url()).dump() + ")");
  waitUntilShown(*browser_, all);
}

void LivePageTest::open(Browser& browser) {
  browser.evaluate("void (location.href = " + Json(url()).dump() + ")");
  waitUntilShown(browser);
}

void LivePageTest::open() {
  serve(smallPanes());
  open(*browser_);
}

void LivePageTest::waitUntilShown(Browser& browser, const std::vector<int>& images) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  for (;;) {
    try {
      browser.waitFor(fmt::format("Boolean(!window.isOld && document.body && document.body.page && "
                                  "document.body.page.viewer && "
                                  "{}.every(i => document.body.page.viewer.images[i].data))",
                                  Json(images).dump()),
                      20.0);
      browser.evaluate(kWatch);
      return;
    } catch (const std::runtime_error&) {
      // Evaluation fails while another page is loading.
      if (std::chrono::steady_clock::now() > end) throw;
    }
  }
}

Json LivePageTest::page(Browser& browser, const std::string& body) {
  return browser.evaluate(R"((async () => {
    const page = document.body.page, {viewer} = page;
    const frame = () => new Promise(requestAnimationFrame);
    const send = command => page.session.send(command);
    const until = async holds => {
      for (const end = performance.now() + 20000; !holds();) {
        if (performance.now() > end) throw new Error('never true: ' + holds);
        await new Promise(done => setTimeout(done, 5));
      }
    };
    )" + body + "})()");
}

void LivePageTest::pause() {
  page(R"(
    send({do: 'pause', on: true});
    await until(() => page.state.paused);
    await until(() => [0, 1].every(i => seen[i] && seen[i].frame === page.last.panes[i].frame &&
                                   performance.now() - seen[i].time > 200));)");
}

void LivePageTest::dispatch(const char* type, const Key& key) {
  const Json event = {{"key", key.key},    {"code", key.code},       {"shiftKey", key.shift},
                      {"altKey", key.alt}, {"ctrlKey", key.control}, {"bubbles", true},
                      {"cancelable", true}};
  browser_->evaluate(fmt::format(
      "void (document.activeElement || document.body).dispatchEvent(new KeyboardEvent('{}', {}))",
      type, event.dump()));
}

void LivePageTest::keyDown(const std::string& name) {
  const Key key = keyNamed(name);
  if (key.control || key.alt) return dispatch("keydown", key);
  browser_->keyDown(key.key, key.code, key.shift);
}

void LivePageTest::keyUp(const std::string& name) {
  const Key key = keyNamed(name);
  if (key.control || key.alt) return dispatch("keyup", key);
  browser_->keyUp(key.key, key.code, key.shift);
}

void LivePageTest::watchExposureKeys() {
  page(R"(
    window.delays = [];
    document.addEventListener('keydown', async event => {
      const {stops} = viewer.root.dataset;
      do { await frame(); } while (viewer.root.dataset.stops === stops);
      await frame();
      delays.push(performance.now() - event.timeStamp);
    }, true);)");
}

void LivePageTest::press(const std::string& name) {
  keyDown(name);
  keyUp(name);
}

void LivePageTest::click(const std::string& selector) {
  const Json at = page("const element = document.querySelector(" + Json(selector).dump() + R"();
    element.scrollIntoView({block: 'center', inline: 'center'});
    await frame();
    const box = element.getBoundingClientRect();
    return [box.x + box.width / 2, box.y + box.height / 2];)");
  browser_->click(at[0], at[1]);
}

std::string LivePageTest::text(const std::string& selector) {
  return browser_->evaluate("document.querySelector(" + Json(selector).dump() + ").textContent");
}

std::pair<double, double> LivePageTest::positionOf(uint32_t x, uint32_t y) {
  const Json box = page(R"(await frame();
    const box = viewer.canvas.getBoundingClientRect();
    return [box.x, box.y, box.width, box.height, page.state.width, page.state.height];)");
  const double width = box[2], height = box[3], columns = box[4], rows = box[5];
  const double scale = std::min(width / columns, height / rows);
  return {double(box[0]) + 0.5 * width + scale * (x + 0.5 - 0.5 * columns),
          double(box[1]) + 0.5 * height + scale * (y + 0.5 - 0.5 * rows)};
}

}  // namespace restlab::view_test
