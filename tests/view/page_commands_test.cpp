// Runs every command of the live page by each of its keys and by the palette. Checks the effects
// that are known here; a new command must at least not throw.
#include "tests/view/live_page.h"

namespace restlab::view_test {
namespace {

// window.tools: prepare(id) makes a state in which the command has an effect; done(id) returns what
// is wrong afterwards, or "".
constexpr const char* kTools = R"JS(
const tools = window.tools = {ran: [], files: []};
for (const one of page.commands) {
  const {run} = one;
  one.run = target => { tools.ran.push(one.id); return run(target); };
}
HTMLAnchorElement.prototype.click = function() { tools.files.push(this.download); };
const {root, state} = viewer, light = page.hello.scene.lights[0].name;
const dialog = () => document.querySelector('dialog[open]');

let count = 0;
const contexts = {
  plain: () => {},
  camera: () => page.camera.setMode(true),
  error: () => viewer.set({error: 'absolute'}),
  history: async () => {  // something to undo, and something to redo
    ++count;
    send({do: 'parameter', pane: 0, name: 'confidence_cap', value: 5 + count % 7});
    send({do: 'light', name: light, factor: 1 + count / 64});
    await until(() => page.state.lights[0].factor === 1 + count / 64);
    send({do: 'undo'});
    await until(() => page.state.can_undo && page.state.can_redo);
  },
  path: () => {
    const target = [0, 1, 0];
    page.recorder.keyframes = [{seconds: 0, position: [0, 1, 3], target},
                               {seconds: 0.1, position: [0.1, 1, 3], target}];
  }
};
// A pane that stood while its history began anew has nothing to probe.
const rendered = async () => {
  viewer.set({mode: 'side'});  // what is not in view renders nothing
  send({do: 'pause', on: false});
  await until(() => !page.state.paused && page.last.epoch === page.state.epoch &&
                    page.last.panes.every(pane => pane.seen && pane.frame > 0));
};
// Preconditions of some commands: without them a command changes nothing.
const first = {
  single: () => viewer.set({mode: 'side'}),
  'image-2': () => viewer.set({current: 0}),
  'compare-3': () => viewer.set({compare: 0}),
  'remove-inset': () => viewer.set({insets: [[0, 0, 0.5, 0.5]]}),
  'tab-methods': () => page.tabs.show('plots'),
  probe: () => rendered(),
  'clear-probe': async () => {
    await rendered();
    page.probe.ask({x: 3, y: 4});
    await until(() => viewer.images[0].marks && viewer.images[1].marks);
  },
  'camera-home': () => page.camera.lookFrom([0.2, 1, 2.5], [0, 1, 0]),
  picture: () => rendered(),
  'show-0-': async () => {
    send({do: 'set', pane: 0, key: 'source', value: 'reference'});
    await until(() => page.state.panes[0].source);
  },
  'show-1-': async () => {
    send({do: 'set', pane: 1, key: 'source', value: 'reference'});
    await until(() => page.state.panes[1].source);
  },
  'cancel-measure': async () => {
    send({do: 'measure'});
    await until(() => page.measurement.isRunning);
  }
};
const copied = async () => {
  for (const [pane, value] of [[0, 'restir_gi'], [1, 'path']]) {
    send({do: 'set', pane, key: 'integrator', value});
    await until(() => page.state.panes[pane].integrator === value);
  }
};
first['copy-ab'] = first['copy-ba'] = copied;
const rectangleWays = {};
for (const way of ['left', 'right', 'up', 'down']) {
  for (const verb of ['move', 'size']) {
    rectangleWays[`rectangle-${verb}-${way}`] = (b, a) => a.rectangle.join() !== b.rectangle.join();
    first[`rectangle-${verb}-${way}`] = () => {
      viewer.set({rectangle: [9, 9, 20, 20]});
      viewer.rectangle.setOn(true);
    };
  }
}
first['rectangle-off'] = () => viewer.set({rectangle: [9, 9, 20, 20]});

const reset = async () => {
  if (dialog()) dialog().close();
  if (page.measurement.isRunning) {
    send({do: 'cancel'});
    await until(() => !page.measurement.isRunning);
  }
  for (const [pane, {source}] of page.state.panes.entries()) {
    if (!source) continue;
    send({do: 'set', pane, key: 'source', value: ''});
    await until(() => !page.state.panes[pane].source);
  }
  page.camera.held.clear();
  page.camera.setMode(false);
  page.camera.setOrbit(false);
  page.recorder.isRecording = false;
  page.probe.clear();
  page.tabs.show('methods');
  viewer.rectangle.clear();
  viewer.set({mode: 'wipe', current: 1, left: -1, compare: 2, error: 'none', stops: 1.5,
              tone: 'srgb', log: {}, held: false, channel: 'g', histogram: false, insets: []});
  viewer.setExposure(7);
  viewer.fit();
  viewer.draw();
  viewer.zoom(2);
  root.focus();
  if (!page.state.paused) {
    send({do: 'pause', on: true});
    await until(() => page.state.paused);
  }
};

const snapshot = () => ({
  ...state, log: JSON.stringify(state.log), scale: viewer.camera.scale,
  fitted: viewer.camera.fitted, camera: root.dataset.camera, speed: page.camera.speed,
  held: [...page.camera.held].join(), isHeld: state.held, pose: JSON.stringify(page.camera.pose),
  paused: page.state.paused, undo: page.state.undo_text, redo: page.state.redo_text,
  seeds: page.state.panes.map(pane => pane.seed).join(),
  methods: page.state.panes.map(pane => pane.integrator), tab: page.tabs.current,
  theme: document.documentElement.dataset.theme, dialog: dialog() ? dialog().className : '',
  bookmarks: page.bookmarks.list.length, isRecording: page.recorder.isRecording,
  sources: page.state.panes.map(pane => pane.source).join(),
  measures: page.measurement.isRunning,
  exposure: viewer.painter.exposure, isChoosing: viewer.rectangle.isOn,
  marks: viewer.images.filter(image => image.marks).length, files: tools.files.join(),
  hasFocus: document.activeElement === root, isSearching:
      document.activeElement === page.methods.search && !page.methods.search.value
});

// Whether a command did what it is for: before, after.
const effects = {
  previous: (b, a) => a.current === 0, next: (b, a) => a.current === 2,
  'hold-compare': (b, a) => a.isHeld, 'hold-tab': (b, a) => a.isHeld,
  'next-left': (b, a) => b.left === -1 && a.left === 0,
  inset: (b, a) => a.insets.length === b.insets.length + 1,
  'remove-inset': (b, a) => a.insets.length === b.insets.length - 1,
  single: (b, a) => a.mode === 'single', wipe: (b, a) => a.mode === 'wipe',
  side: (b, a) => a.mode === 'side', fit: (b, a) => !b.fitted && a.fitted,
  actual: (b, a) => b.scale !== 1 && a.scale === 1, 'zoom-in': (b, a) => a.scale > b.scale,
  'zoom-out': (b, a) => a.scale < b.scale,
  'next-error': (b, a) => b.error !== 'none' ? a.error === 'squared' : a.error === 'signed',
  'previous-error': (b, a) => a.error === 'flip_hdr', log: (b, a) => a.log !== b.log,
  brighter: (b, a) => a.stops === 2, darker: (b, a) => a.stops === 1,
  'exposure-reset': (b, a) => a.stops === 0, tone: (b, a) => a.tone === 'false',
  'auto-exposure': (b, a) => a.stops === 0 && a.exposure !== b.exposure,
  channel: (b, a) => a.channel === 'b', 'previous-channel': (b, a) => a.channel === 'r',
  histogram: (b, a) => a.histogram && document.querySelector('.histogram').offsetHeight > 50,
  link: () => document.querySelector('.messages').textContent.includes('address of this view'),
  rectangle: (b, a) => a.isChoosing && a.rectangle.length === 4,
  'rectangle-off': (b, a) => a.rectangle === null, ...rectangleWays,
  palette: (b, a) => a.dialog === 'palette', help: (b, a) => a.dialog === 'help',
  faster: (b, a) => a.speed > b.speed, slower: (b, a) => a.speed < b.speed,
  'camera-mode': (b, a) => a.camera === (b.camera === 'fly' ? 'none' : 'fly'),
  orbit: (b, a) => a.camera === 'orbit', bookmark: (b, a) => a.bookmarks === b.bookmarks + 1,
  'camera-home': (b, a) => a.pose !== b.pose, record: (b, a) => a.isRecording,
  play: (b, a) => a.pose !== b.pose, pause: (b, a) => b.paused && !a.paused,
  restart: (b, a) => a.seeds !== b.seeds, undo: (b, a) => b.undo && a.redo === b.undo,
  redo: (b, a) => b.redo && a.undo === b.redo,
  'copy-ab': (b, a) => a.methods.join() === 'restir_gi,restir_gi',
  'copy-ba': (b, a) => a.methods.join() === 'path,path',
  probe: (b, a) => a.marks === 2 && a.tab === 'probe', 'clear-probe': (b, a) => a.marks === 0,
  'show-0-reference': (b, a) => a.sources === 'reference,',
  'show-1-reference': (b, a) => a.sources === ',reference',
  'show-0-': (b, a) => a.sources === ',', 'show-1-': (b, a) => a.sources === ',',
  measure: (b, a) => a.measures && a.tab === 'plots',
  'cancel-measure': (b, a) => b.measures && !a.measures,
  picture: (b, a) => a.files.endsWith('.exr'),
  crop: (b, a) => document.querySelector('.messages').textContent.includes('--crop '),
  save: (b, a) => a.files.endsWith('.toml'), screenshot: (b, a) => a.files.endsWith('.png'),
  theme: (b, a) => a.theme !== b.theme, 'find-parameter': (b, a) => a.isSearching,
  leave: (b, a) => b.camera === 'none' ? !a.hasFocus : a.camera === 'none'
};
for (let i = 0; i < 3; ++i) {
  effects[`image-${i + 1}`] = (b, a) => b.current !== i && a.current === i;
  effects[`compare-${i + 1}`] = (b, a) => b.compare !== i && a.compare === i;
}
for (const one of page.commands) {
  const [, kind, of] = /^(fly|tab|error)-(.*)$/.exec(one.id) || [];
  if (kind === 'fly') effects[one.id] = (b, a) => a.held === of && a.pose !== b.pose;
  if (kind === 'error') effects[one.id] = (b, a) => a.error === of;
  if (kind === 'tab') effects[one.id] = (b, a) => b.tab !== of && a.tab === of;
}
tools.known = Object.keys(effects);

const begin = () => {
  tools.before = snapshot();
  tools.ran.length = tools.files.length = 0;
};
const prepared = async (id, holds) => {
  for (const make of Object.values(contexts)) {
    await reset();
    if (first[id]) await first[id]();
    await make();
    await frame();
    begin();
    if (await holds()) return true;
  }
  return false;
};
tools.prepare = id => {
  const command = page.commands.find(one => one.id === id);
  return prepared(id, () => !command.when || command.when(viewer));
};
// The palette with a command as its first choice.
tools.search = (id, title) => prepared(id, async () => {
  document.dispatchEvent(new CustomEvent('palette'));
  page.palette.input.value = title;
  page.palette.input.dispatchEvent(new InputEvent('input', {bubbles: true}));
  return page.palette.found.some(one => one.id === id);
});
tools.done = async id => {
  const holds = effects[id] || (() => true), end = performance.now() + 5000;
  while (performance.now() < end && !(tools.ran.length && holds(tools.before, snapshot()))) {
    await new Promise(done => setTimeout(done, 5));
  }
  if (tools.ran.join() !== id) return `did ${tools.ran.join() || 'nothing'}`;
  return holds(tools.before, snapshot()) ? '' : 'has no effect';
};)JS";

class PageCommandsTest : public LivePageTest {
 protected:
  // Returns [id, keys, title, whether it lasts while a key is held]...
  Json start() {
    facts_.program = program("sleep 100");
    open();
    page(kTools);
    return page(
        "return page.commands.map(({id, keys, title, release}) => [id, keys, title, "
        "Boolean(release)]);");
  }
  // True for commands of a fourth or later image: there are three images.
  static bool isOfMoreImages(const std::string& id) {
    return (id.rfind("image-", 0) == 0 || id.rfind("compare-", 0) == 0) && id.back() > '3';
  }
  bool prepare(const std::string& id) { return page("return tools.prepare('" + id + "');"); }
  std::string done(const std::string& id) { return page("return tools.done('" + id + "');"); }
  void expectNoErrors() {
    EXPECT_EQ(page("return Array.from(document.querySelectorAll('.message.error'), "
                   "one => one.textContent);"),
              Json::array());
  }
};

TEST_F(PageCommandsTest, DoWhatTheySayByTheirKeys) {
  const Json commands = start();
  ASSERT_GT(commands.size(), 40u);
  for (const Json& command : commands) {
    const std::string id = command[0];
    if (isOfMoreImages(id)) continue;
    for (const std::string key : command[1]) {
      SCOPED_TRACE(id + " by " + key);
      if (!prepare(id)) {
        ADD_FAILURE() << "no state of the test has anything to do for it";
        continue;
      }
      keyDown(key);
      EXPECT_EQ(done(id), "");
      keyUp(key);
      if (command[3] == true) {
        EXPECT_EQ(page("return [viewer.state.held, page.camera.held.size];"), (Json{false, 0}));
      }
    }
  }
  expectNoErrors();
}

TEST_F(PageCommandsTest, DoWhatTheySayByThePalette) {
  const Json commands = start();
  for (const Json& command : commands) {
    const std::string id = command[0], title = command[2];
    if (isOfMoreImages(id) || command[3] == true || id == "palette") continue;
    SCOPED_TRACE(id);
    if (page("return tools.search('" + id + "', " + Json(title).dump() + ");") != true) {
      ADD_FAILURE() << "no state of the test has it in the palette";
      continue;
    }
    browser_->press("Enter", "Enter");
    EXPECT_EQ(done(id), "");
  }
  expectNoErrors();
}

TEST_F(PageCommandsTest, ArePickedInThePaletteByTyping) {
  start();
  ASSERT_TRUE(prepare("next-error"));
  press("Ctrl+k");
  for (const char c : std::string("false colour")) press(c == ' ' ? "Space" : std::string(1, c));
  EXPECT_EQ(page("return page.palette.found.map(one => one.id);"), (Json{"tone"}));
  browser_->press("Enter", "Enter");
  EXPECT_EQ(page("return [viewer.state.tone, tools.ran];"), (Json{"false", {"palette", "tone"}}));
  press("Ctrl+k");
  page(
      "const {input} = page.palette; input.value = 'confidence_cap of a'; "
      "input.dispatchEvent(new InputEvent('input'));");
  browser_->press("Enter", "Enter");
  EXPECT_EQ(page("return document.activeElement.closest('.parameter').dataset.parameter;"),
            "confidence_cap");
  press("Ctrl+k");
  press("ArrowDown");
  press("Escape");
  EXPECT_EQ(page("return Boolean(document.querySelector('dialog[open]'));"), false);
}

// This file must not know commands that no longer exist.
TEST_F(PageCommandsTest, AreAllThatThisFileKnows) {
  start();
  EXPECT_EQ(page("return tools.known.filter(id => !page.commands.some(one => one.id === id));"),
            Json::array());
}

}  // namespace
}  // namespace restlab::view_test
