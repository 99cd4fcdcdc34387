// Opening the live page: alone, twice at once, again; and the session that it saves.
#include <fstream>

#include "experiments/view/view_page.h"
#include "experiments/view/view_session.h"
#include "tests/view/live_page.h"

namespace restlab::view_test {
namespace {

using PageOpenTest = LivePageTest;

TEST_F(PageOpenTest, ShowsBothPanesAndTheReference) {
  open();
  EXPECT_EQ(page("return viewer.images.map(image => image.name);"),
            (Json{"A: restir_gi, pixel", "B: path + accumulate", "reference"}));
  EXPECT_EQ(
      page("await frame(); await frame(); return Array.from("
           "document.querySelectorAll('.tag'), tag => tag.textContent.replace(/  MSE .*|  [^ ]* "
           "ms/, ''));"),
      (Json{"1  A: restir_gi, pixel", "2  B: path + accumulate", "3  reference"}));
  EXPECT_EQ(text(".link"), "connected");
  EXPECT_EQ(page("return [page.state.width, page.state.height];"), (Json{64, 36}));
  // Frames keep arriving.
  page(
      "const first = seen[0]?.frame ?? 0; await until(() => seen[0] && seen[0].frame > first + "
      "3);");
  EXPECT_EQ(page("return document.querySelectorAll('.message.error').length;"), 0);
}

constexpr const char* kState = "const {say, ...rest} = page.state; return rest;";

TEST_F(PageOpenTest, TwoPagesShowTheSame) {
  open();
  Browser second(1000, 700);
  open(second);
  page(
      "send({do: 'parameter', pane: 0, name: 'confidence_cap', value: 9});"
      "await until(() => page.state.can_undo);");
  page(second, "await until(() => page.state.can_undo);");
  EXPECT_EQ(page(kState), page(second, kState));
  page(second, "send({do: 'undo'}); await until(() => page.state.can_redo);");
  page("await until(() => page.state.can_redo);");
  EXPECT_EQ(page(kState), page(second, kState));
  for (Browser* browser : {browser_.get(), &second}) {
    page(*browser, R"(const first = {...window.seen};
      await until(() => [0, 1].every(i => seen[i] && seen[i].frame > (first[i]?.frame ?? 0) + 2));
      await until(() => seen[64]);)");
  }
  expectNothingWrong(second);
}

TEST_F(PageOpenTest, ReloadComesBackToTheSame) {
  open();
  page(R"(
    send({do: 'parameter', pane: 0, name: 'confidence_cap', value: 9});
    send({do: 'resolution', width: 48, height: 32});
    await until(() => page.state.width === 48);
    viewer.set({mode: 'wipe', error: 'squared', stops: 1.5, wipe: 0.25, current: 1, left: 0,
                insets: [[0.25, 0.5, 0.25, 0.125]]});
    await until(() => location.hash.includes('squared') && location.hash.includes('48'));)");
  const Json before = page(kState);
  browser_->evaluate("void (window.isOld = true, location.reload())");
  waitUntilShown(*browser_);
  EXPECT_EQ(page(kState), before) << "nothing was asked for, as all of it is so";
  EXPECT_EQ(page("const {mode, error, stops, wipe, current, left} = viewer.state;"
                 "return [mode, error, stops, wipe, current, left];"),
            (Json{"wipe", "squared", 1.5, 0.25, 1, 0}));
  page("await until(() => seen[0] && seen[1] && viewer.images[0].width === 48); await frame();");
  EXPECT_EQ(text(".inset code"), "12,16,12,4") << "in pixels of the kept size";
}

TEST_F(PageOpenTest, ALinkShowsTheSameAgain) {
  open();
  page(R"(await until(() => location.hash.length > 1);
    viewer.set({mode: 'single', current: 1, channel: 'b', stops: 0.5, histogram: true,
                rectangle: [3, 4, 20, 30]});
    viewer.zoom(4);
    viewer.setExposure(0.25);
    send({do: 'adaptive', on: false});
    await until(() => !page.state.adaptive);
    window.kept = new URL(viewer.data.link()).hash;
    viewer.set({mode: 'side', current: 0, channel: 'rgb', stops: 0, histogram: false,
                rectangle: null});
    viewer.fit();
    viewer.setExposure(1);
    send({do: 'adaptive', on: true});
    await until(() => page.state.adaptive && location.hash !== kept);
    location.hash = kept;
    await until(() => viewer.state.mode === 'single' && !page.state.adaptive);)");
  EXPECT_EQ(page("const {current, channel, stops, histogram, rectangle} = viewer.state; return "
                 "[current, channel, stops, histogram, rectangle, viewer.painter.exposure, "
                 "new URL(viewer.data.link()).hash === kept];"),
            (Json{1, "b", 0.5, true, {3, 4, 20, 30}, 0.25, true}));
  const auto noticeOf = [&](const std::string& hash) {
    return page("location.hash = " + Json(hash).dump() +
                "; const notices = () => document.querySelectorAll('.message');"
                "await until(() => notices().length); const {textContent} = notices()[0];"
                "notices().forEach(one => one.remove()); return textContent;");
  };
  EXPECT_EQ(noticeOf("#%7Bpanes").get<std::string>().find("the address is cut off"), 0u);
  const std::string wrong = noticeOf(
      "#%7B%22panes%22%3A%5B%5D%2C%22view%22%3A%7B%22mode%22%3A7%2C"
      "%22zoom%22%3A%5B1%5D%7D%7D");
  EXPECT_EQ(wrong.find("the address has no possible value of mode, zoom"), 0u) << wrong;
  EXPECT_EQ(page("return viewer.state.mode;"), "single");
}

TEST_F(PageOpenTest, ReloadTakesNothingBack) {
  open();
  page(R"(await until(() => location.hash.length > 1);
    send({do: 'parameter', pane: 0, name: 'confidence_cap', value: 9});
    send({do: 'pause', on: true});
    await until(() => page.state.paused && page.state.can_undo);
    window.isOld = true;
    setTimeout(() => location.reload(), 0);)");
  waitUntilShown(*browser_);
  // By then the page has sent anything that it would send on loading.
  page("send({do: 'save'}); await until(() => document.querySelector('.message'));");
  EXPECT_EQ(page("return page.state.paused;"), true);
  EXPECT_EQ(page("return page.state.panes[0].parameters.find("
                 "one => one.name === 'confidence_cap').value;"),
            9);
}

// Another viewer at the same port does not know the page's address.
TEST_F(PageOpenTest, TellsAnotherProgramFromALostOne) {
  open();
  const std::string old = url();
  const size_t port = old.find(':', 7) + 1;
  stop();
  loop_.reset();
  ViewServerOptions options;
  options.page = viewPage();
  options.port = uint16_t(std::stoi(old.substr(port)));
  loop_ = std::make_unique<ViewLoop>(*view_, facts_, options, folder());
  page("await until(() => document.querySelector('.link').dataset.link === 'replaced');");
  EXPECT_NE(text(".link").find("another viewer"), std::string::npos);
  for (const std::string& complaint : browser_->takeComplaints()) {
    EXPECT_TRUE(complaint.find("403") != std::string::npos ||
                complaint.find("WebSocket") != std::string::npos)
        << complaint;
  }
}

TEST_F(PageOpenTest, SavesASessionThatASuiteParserTakes) {
  open();
  page(R"(send({do: 'parameter', pane: 0, name: 'confidence_cap', value: 9});
    await until(() => page.state.can_undo);
    window.files = [];
    const {click} = HTMLAnchorElement.prototype;
    HTMLAnchorElement.prototype.click = function() {
      files.push(this.download);
      click.call(this);
    };
    const made = URL.createObjectURL;
    URL.createObjectURL = blob => {
      window.saved = blob.text();
      return made.call(URL, blob);
    };)");
  press("Ctrl+s");
  const std::string toml = page("await until(() => window.saved); return await saved;");
  EXPECT_EQ(page("return files[0];"), "session.toml");
  const auto file = folder() / "of-the-page.toml";
  std::ofstream(file) << toml;
  const ViewStart start = startOfSuite(file);
  EXPECT_EQ(start.request.scene, "cornell-box");
  stop();
  EXPECT_TRUE(isSame(start.settings, view_->settings())) << toml;
}

}  // namespace
}  // namespace restlab::view_test
