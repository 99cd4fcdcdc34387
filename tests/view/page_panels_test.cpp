// Panels of the live page while something changes, is refused or plays.
#include <fstream>

#include "tests/view/live_page.h"

namespace restlab::view_test {
namespace {

class PagePanelsTest : public LivePageTest {
 protected:
  void SetUp() override {
    LivePageTest::SetUp();
    if (browser_) open();
  }
};

// A refused value disappears when its field loses the focus.
TEST_F(PagePanelsTest, ARefusedLightDoesNotStayInItsField) {
  const std::string field = "document.querySelector('[data-light] input[type=number]')";
  press("Alt+2");
  page(field + ".scrollIntoView(); " + field + ".focus(); " + field + ".select();");
  for (const char* key : {"-", "1"}) press(key);
  browser_->press("Enter", "Enter");
  page("await until(() => document.querySelector('.message.error'));");
  page("document.activeElement.blur();");
  EXPECT_EQ(page("return " + field + ".value;"), "1");
  // A value that is still being sent is not reset.
  page(field + ".focus(); " + field + ".select();");
  press("3");
  browser_->press("Tab", "Tab");
  EXPECT_EQ(page("return " + field + ".value;"), "3");
  page("await until(() => page.state.lights[0].factor === 3);");
  EXPECT_EQ(page("return " + field + ".value;"), "3");
}

TEST_F(PagePanelsTest, MessagesCoverNoPicture) {
  const Json before = page(
      "const {x, y, width, height} = viewer.canvas.getBoundingClientRect();"
      "return [x, y, width, height];");
  page(
      "for (let i = 0; i < 9; ++i) send({do: 'dance ' + i});"
      "await until(() => document.querySelectorAll('.message.error').length > 5);");
  EXPECT_EQ(page("const {x, y, width, height} = viewer.canvas.getBoundingClientRect();"
                 "return [x, y, width, height];"),
            before);
  EXPECT_EQ(page(R"(const canvas = viewer.canvas.getBoundingClientRect();
    return Array.from(document.querySelectorAll('.message'), one => {
      const box = one.getBoundingClientRect();
      return box.left < canvas.right && box.right > canvas.left && box.top < canvas.bottom &&
             box.bottom > canvas.top;
    }).filter(Boolean).length;)"),
            0);
}

TEST_F(PagePanelsTest, HeadsOfTheNumbersNameTheMethods) {
  const std::string heads =
      "return Array.from(document.querySelectorAll('.numbers-table thead th'), th => "
      "th.textContent);";
  EXPECT_EQ(page(heads), (Json{"A: restir_gi, pixel", "B: path + accumulate"}));
  page(
      "send({do: 'set', pane: 1, key: 'denoiser', value: 'none'});"
      "await until(() => page.state.can_undo);");
  EXPECT_EQ(page(heads), (Json{"A: restir_gi, pixel", "B: path"}));
}

// Old values are marked as old and probed again after the change is rendered.
TEST_F(PagePanelsTest, AProbeFollowsAChange) {
  press("s");
  press("1");
  page(
      "await until(() => page.last.panes[0].frame > 2); page.probeAt({x: 20, y: 30});"
      "await until(() => page.probe.answers[0] && page.probe.answers[1]);");
  pause();
  page(
      "await until(() => page.probe.answers.every(one => one.frame === "
      "page.last.panes[one.pane].frame));");
  const std::string hint = "return document.querySelector('.probe .hint').textContent;";
  EXPECT_EQ(page(hint).get<std::string>().find("before the change"), std::string::npos);
  const Json first = page("return page.probe.answers.map(one => [one.frame, one.epoch]);");
  page(
      "send({do: 'light', name: 'all', factor: 0.5});"
      "await until(() => page.state.epoch > " +
      first[0][1].dump() + ");");
  EXPECT_NE(page(hint).get<std::string>().find("before the change"), std::string::npos)
      << page(hint);
  EXPECT_EQ(page("return page.probe.answers.map(one => [one.frame, one.epoch]);"), first)
      << "panes stand";
  page(
      "viewer.set({mode: 'side'});"  // what is out of view renders nothing
      "send({do: 'pause', on: false});"
      "await until(() => page.probe.answers.every(one => one.epoch === page.state.epoch));");
  EXPECT_EQ(page(hint).get<std::string>().find("before the change"), std::string::npos)
      << page(hint);
  EXPECT_EQ(page("return document.querySelectorAll('.message.error').length;"), 0);
}

TEST_F(PagePanelsTest, AProbeFollowsFramesUnlessItIsHeld) {
  // No real click: the box of numbers above grows while frames go on.
  const std::string toggle = "document.querySelector('#probe-hold').click();";
  page(R"(page.probeAt({x: 20, y: 30});
    await until(() => page.probe.answers[0] && page.probe.answers[1]);
    const first = page.probe.answers.map(one => one.frame);
    await until(() => page.probe.answers.every((one, i) => one.frame > first[i]));)");
  page(toggle);
  // Answers that were asked for before still come.
  page("await until(() => !page.probe.asked.some(Boolean));");
  const Json held = page("return page.probe.answers.map(one => one.frame);");
  page(R"(window.sent = [];
    const sendNow = page.session.send, from = page.last.panes[0].frame;
    page.session.send = command => {
      sent.push(command.do);
      return sendNow.call(page.session, command);
    };
    await until(() => page.last.panes[0].frame > from + 10);)");
  EXPECT_EQ(page("return sent;"), Json::array());
  EXPECT_EQ(page("return page.probe.answers.map(one => one.frame);"), held);
  const std::string hint = text(".probe .hint");
  EXPECT_EQ(hint.find("A: held at frame " + held[0].dump() + ","), 0u) << hint;
  page(toggle);
  page("await until(() => page.probe.answers[0].frame > " + held[0].dump() + ");");
  EXPECT_EQ(text(".probe .hint").find("held"), std::string::npos);
}

// Estimates against a noisy reference may be negative; leaving them out would lift the curve.
TEST_F(PagePanelsTest, ErrorsThatAreNotAboveZeroAreInThePlot) {
  pause();
  press("Alt+3");
  page(R"(const panes = mse => [0, 1].map(() => ({frame: 0, ms: 1, last_mse: mse, passes: []}));
    page.showNumbers = () => {};  // those of the program
    window.numbers = (epoch, list) => list.forEach((mse, i) => page.plots.add({
      epoch, age: 10 * (i + 1), panes: panes(mse).map(pane => ({
        ...pane, epoch, age: 10 * (i + 1), frame: i + 1}))}));
    numbers(1e9, [1e-2, -1e-3, 0, 1e-3]);
    page.plots.show();)");
  EXPECT_EQ(page("return page.plots.series.curves[0].points.map(point => point.mse);"),
            (Json{1e-2, -1e-3, 0, 1e-3}));
  EXPECT_EQ(page("const {picture} = page.plots.byAge; return [picture.querySelectorAll('.below')"
                 ".length, picture.textContent.includes('not above 0'),"
                 "picture.innerHTML.includes('NaN')];"),
            (Json{4, true, false}));
  page("numbers(1e9 + 1, [-1, 0]); page.plots.show();");
  EXPECT_EQ(page("return page.plots.byAge.picture.innerHTML.includes('NaN');"), false);
}

TEST_F(PagePanelsTest, ARecordedPathIsPlayedOnceWithItsFieldOfView) {
  page(R"(const target = [0, 1, 0];
    page.recorder.keyframes = [{seconds: 0, position: [0, 1, 3], target, yfov: 0.5},
                               {seconds: 60, position: [0.3, 1, 3], target, yfov: 1}];
    window.looks = [];
    const {lookFrom} = page.camera;
    page.camera.lookFrom = (...given) => {
      looks.push([performance.now(), ...given]);
      lookFrom.apply(page.camera, given);
    };
    page.recorder.playBack();
    await until(() => looks.length > 3);
    page.recorder.playBack();)");
  const Json stopped = page(
      "const before = looks.length;"
      "await new Promise(done => setTimeout(done, 200));"
      "return [before, looks.length, page.recorder.play.textContent];");
  EXPECT_EQ(stopped[0], stopped[1]) << "asked for again it stops";
  EXPECT_EQ(stopped[2], "play");
  // Stopped and restarted within one browser frame, it plays once, to its end.
  page(R"(looks.length = 0;
    page.recorder.keyframes[1].seconds = 0.6;
    for (let i = 0; i < 3; ++i) page.recorder.playBack();
    await until(() => looks.length > 3 && !page.recorder.playing);
    await until(() => Math.abs(page.state.camera.yfov - 1) < 1e-9);)");
  EXPECT_EQ(page("let back = 0; for (let i = 1; i < looks.length; ++i)"
                 "if (looks[i][1][0] <= looks[i - 1][1][0]) ++back; return back;"),
            0);
  EXPECT_EQ(page("return looks[looks.length - 1].slice(1);"), (Json{{0.3, 1, 3}, {0, 1, 0}, 1}));
  EXPECT_NEAR(page("return page.state.camera.to_world[12];").get<double>(), 0.3, 1e-9);
}

// Messages that are already on their way still arrive after the page is hidden.
TEST_F(PagePanelsTest, InTheBackgroundItLooksAway) {
  page(R"(await until(() => page.last.age > 2);
    Object.defineProperty(document, 'hidden', {value: true, configurable: true});
    document.dispatchEvent(new Event('visibilitychange'));
    let since = performance.now();
    await until(() => {
      if (page.last.age !== window.age) since = performance.now();
      window.age = page.last.age;
      return performance.now() - since > 600;
    });
    delete document.hidden;
    document.dispatchEvent(new Event('visibilitychange'));
    await until(() => page.last.age > window.age + 2);)");
}

class PageMaterialsTest : public LivePageTest {};

// A number, a colour and a choice of a scene file's materials, and what the file refuses.
TEST_F(PageMaterialsTest, AreSetInTheScenePanel) {
  std::ofstream(folder() / "x.scene.toml")
      << "base = \"cornell-box\"\n[[material]]\nname = \"clay\"\nkind = \"oren_nayar\"\n"
         "color = [0.7, 0.4, 0.2]\n[[assign]]\nmaterial = \"White\"\nto = \"clay\"\n";
  facts_.request.scene = (folder() / "x.scene.toml").string();
  open();
  press("Alt+2");
  page(
      "const all = document.querySelector('[data-material]'); all.open = true; "
      "all.scrollIntoView();");
  const auto set = [&](const std::string& name, const std::string& input,
                       const std::string& value) {
    page("const input = document.querySelector('[data-material] [data-parameter=" + name + "] " +
         input + "'); input.focus(); input.value = '" + value +
         "'; input.dispatchEvent(new Event('change')); input.blur();");
  };
  const auto waitFor = [&](const std::string& name, const std::string& value) {
    page("await until(() => page.state.materials[0].parameters.some(p => p.name === '" + name +
         "' && JSON.stringify(p.value) === '" + value + "' && p.is_set));");
  };
  set("color", "input[type=text]", "[0.1, 0.2, 0.9]");
  waitFor("color", "\"[0.1, 0.2, 0.9]\"");
  EXPECT_EQ(
      page("return document.querySelector('[data-parameter=color] input[type=color]').value;"),
      "#597cf3");
  set("color", "input[type=color]", "#ffffff");
  waitFor("color", "\"[1, 1, 1]\"");
  set("sigma", "input[type=number]", "0.8");
  waitFor("sigma", "0.8");
  set("model", "select", "conserving");
  waitFor("model", "\"conserving\"");
  set("color", "input[type=text]", "[7, 0, 0]");
  page(
      "await until(() => [...document.querySelectorAll('.message.error')].some("
      "message => message.textContent.includes(\"'color' must hold\")));");
  page(
      "await until(() => document.querySelector('[data-parameter=color] input').value === '[1, 1, "
      "1]');");
  // Another kind has other controls. The address holds kinds and values.
  set("kind", "select", "phong");
  page(
      "await until(() => document.querySelector('[data-material] [data-parameter=power]'));"
      "window.steps = page.state.undo_text;");
  set("power", "input[type=number]", "7");
  page(R"(await until(() => page.state.undo_text !== steps);
    const wanted = JSON.stringify(page.state.materials);
    await until(() => decodeURIComponent(location.hash).includes('"power":7'));
    const {hash} = location;
    send({do: 'undo'});
    send({do: 'undo'});
    await until(() => page.state.materials[0].kind === 'oren_nayar');
    if (!document.querySelector('[data-parameter=sigma]')) throw new Error('controls of before');
    await until(() => location.hash !== hash);
    location.hash = hash;
    await until(() => JSON.stringify(page.state.materials) === wanted);)");
  if (const char* file = std::getenv("RESTLAB_SCREENSHOT")) browser_->screenshot(file);
}

}  // namespace
}  // namespace restlab::view_test
