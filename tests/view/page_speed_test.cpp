// Measures the times of docs/performance.md, "The viewer": how fluent the page is while nothing
// renders, and the cost of being watched. The printed times mean nothing on a busy machine; the
// assertions hold on any machine.
#include <algorithm>
#include <chrono>
#include <cstdio>

#include "experiments/statistics/intervals.h"
#include "tests/view/live_page.h"

namespace restlab::view_test {
namespace {

double percentileOf(std::vector<double> values, double fraction) {
  return percentile(values, fraction);
}

class PageSpeedTest : public LivePageTest {
 protected:
  // Panes of door-ajar on two threads: restir_gi, and path with that denoiser.
  std::vector<SessionConfig> panesOf(uint32_t width, uint32_t height, const std::string& denoiser) {
    facts_.request.scene = "door-ajar";
    std::vector<SessionConfig> panes = {smallPane("restir_gi"), smallPane("path", denoiser)};
    for (SessionConfig& pane : panes) {
      pane.width = width;
      pane.height = height;
      pane.maxBounces = 8;
      pane.threads = 2;
    }
    return panes;
  }

  void openPanes(const std::vector<SessionConfig>& panes) {
    serve(panes);
    browser_->evaluate("void (location.href = " + Json(url()).dump() + ")");
    waitUntilShown(*browser_);
  }
};

// Calls what pointer events call, once per browser frame, for three seconds each.
TEST_F(PageSpeedTest, NightlyPanZoomAndWipe) {
  openPanes(panesOf(1280, 720, "none"));
  pause();
  const Json read = page(R"(
    const {canvas} = viewer, result = {width: canvas.width, height: canvas.height};
    const motions = {
      pan: i => { viewer.camera.pan(i % 40 < 20 ? 7 : -7, i % 20 < 10 ? 3 : -3); viewer.redraw(); },
      zoom: i => viewer.zoom(i % 40 < 20 ? 1.05 : 1 / 1.05, 300, 200),
      wipe: i => viewer.set({wipe: 0.5 + 0.4 * Math.sin(i / 9)})
    };
    viewer.set({mode: 'wipe', current: 0, compare: 2});
    for (const [name, move] of Object.entries(motions)) {
      if (name === 'pan') viewer.zoom(3, 300, 200);
      await frame();
      const before = Number(viewer.root.dataset.drawn), begin = performance.now();
      const gaps = [];
      for (let i = 0, last = begin; performance.now() < begin + 3000; ++i) {
        move(i);
        await frame();
        const now = performance.now();
        gaps.push(now - last);
        last = now;
      }
      const drawn = Number(viewer.root.dataset.drawn) - before;
      result[name] = {perSecond: 1000 * drawn / (performance.now() - begin), gaps};
    }
    return result;)");
  std::printf("canvas %dx%d:", read["width"].get<int>(), read["height"].get<int>());
  for (const char* name : {"pan", "zoom", "wipe"}) {
    const double perSecond = read[name]["perSecond"];
    std::printf(" %s %.1f a second (95 %% of the gaps below %.0f ms);", name, perSecond,
                percentileOf(read[name]["gaps"].get<std::vector<double>>(), 0.95));
    EXPECT_GT(perSecond, 0.5) << name << ": nothing is drawn";
  }
  std::printf("\n");

  page("viewer.set({mode: 'single', current: 0});");
  watchExposureKeys();
  for (int i = 0; i < 40; ++i) {
    press(i % 2 == 0 ? "e" : "E");
    page("await until(() => delays.length > " + std::to_string(i) + ");");
  }
  const auto delays = page("return delays;").get<std::vector<double>>();
  std::printf("from key to changed picture: median %.0f ms, 95th percentile %.0f ms\n",
              percentileOf(delays, 0.5), percentileOf(delays, 0.95));
}

// Flies for five seconds: pictures of pane A a second, and the time from a key to the first picture
// of another view, with smaller frames and with whole ones.
TEST_F(PageSpeedTest, NightlyFlying) {
  openPanes(panesOf(320, 180, "accumulate"));
  double perSecond[2] = {};
  for (const char* mode : {"side", "wipe"}) {
    for (const bool isAdaptive : {false, true}) {
      const Json read = page(R"(
        viewer.set({mode: ')" +
                             std::string(mode) + R"(', current: 0, compare: 2});
        send({do: 'adaptive', on: )" +
                             (isAdaptive ? "true" : "false") + R"(});
        await until(() => page.state.adaptive === )" +
                             (isAdaptive ? "true" : "false") + R"();
        const rest = ms => new Promise(resolve => setTimeout(resolve, ms));
        await rest(3000);
        const set = viewer.setImage, seen = [];
        viewer.setImage = (i, change) => {
          set.call(viewer, i, change);
          if (i === 0 && change.data) seen.push([performance.now(), change.epoch, change.width]);
        };
        const delays = [];
        for (let i = 0; i < 5; ++i) {
          const {epoch} = page.state, before = seen.length, begin = performance.now();
          page.camera.hold(i % 2 ? 'back' : 'forward');
          await until(() => seen.slice(before).some(one => one[1] > epoch));
          await frame();
          delays.push(performance.now() - begin);
          page.camera.release(i % 2 ? 'back' : 'forward');
          await rest(1500);
        }
        const before = seen.length, begin = performance.now();
        page.camera.hold('turn-left');
        await rest(5000);
        page.camera.release('turn-left');
        const spent = performance.now() - begin, pictures = seen.slice(before);
        viewer.setImage = set;
        return {delays, perSecond: 1000 * pictures.length / spent,
                width: pictures.length ? pictures[pictures.length - 1][2] : 0};)");
      perSecond[isAdaptive ? 1 : 0] = read["perSecond"];
      std::printf(
          "%s, %s frames (%d wide): %.1f pictures a second; first picture of a view after "
          "%.0f ms (median), %.0f ms (longest)\n",
          mode, isAdaptive ? "smaller" : "whole", read["width"].get<int>(),
          perSecond[isAdaptive ? 1 : 0],
          percentileOf(read["delays"].get<std::vector<double>>(), 0.5),
          percentileOf(read["delays"].get<std::vector<double>>(), 1.0));
    }
    EXPECT_GT(perSecond[1], 0.0) << mode;
  }
}

// Compares the passes of frames in a view that nobody sees and in one that a page receives, in
// turn.
TEST_F(PageSpeedTest, NightlyBeingWatched) {
  constexpr int kRounds = 6, kWarmUp = 10, kFrames = 40;
  const std::vector<SessionConfig> panes = panesOf(320, 180, "accumulate");
  const PreparedScene prepared = prepareScene(facts_.request);
  std::vector<double> ratios[2];
  double bytes = 0.0, seconds = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<double> alone[2], watched[2];
    LiveView view(prepared, panes, ReferenceStore{});
    for (int frame = 0; frame < kWarmUp + kFrames; ++frame) {
      view.renderFrames();
      for (size_t pane = 0; frame >= kWarmUp && pane < 2; ++pane)
        alone[pane].push_back(view.stats(pane).timeMs);
    }
    start(settingsOf(prepared, panes));
    {
      Page page(url());
      page.waitFor("numbers", [&](const Json& said) {
        return said["panes"][1]["frame"].get<int>() >= kWarmUp;
      });
      const uint64_t before = page.bytes();
      const auto begin = std::chrono::steady_clock::now();
      while (watched[0].size() < size_t(kFrames)) {
        const Json said = page.waitFor("numbers");
        for (size_t pane = 0; pane < 2; ++pane)
          watched[pane].push_back(said["panes"][pane]["ms"].get<double>());
      }
      seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      bytes += double(page.bytes() - before);
    }
    stop();
    loop_.reset();
    view_.reset();
    for (size_t pane = 0; pane < 2; ++pane)
      ratios[pane].push_back(median(watched[pane]) / median(alone[pane]));
  }
  for (size_t pane = 0; pane < 2; ++pane) {
    const Interval ratio = geometricMeanInterval(ratios[pane]);
    std::printf("%s: frame time of a watched view over one alone %.3f [%.3f, %.3f], %d rounds\n",
                pane == 0 ? "restir_gi" : "path + accumulate", ratio.value, ratio.lo, ratio.hi,
                kRounds);
    EXPECT_GT(ratio.value, 0.0);
  }
  std::printf("stream: %.2f MB/s\n", bytes / seconds / 1e6);
  EXPECT_GT(bytes, 0.0);
}

}  // namespace
}  // namespace restlab::view_test
