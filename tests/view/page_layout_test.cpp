// Layout of the live page on a small screen: 1280 pixels wide.
#include "tests/view/live_page.h"

namespace restlab::view_test {
namespace {

class PageLayoutTest : public LivePageTest {
 protected:
  void SetUp() override {
    LivePageTest::SetUp();
    if (!browser_) return;
    facts_.request.scene = "door-ajar";  // has a long title
    open();
    page(
        "send({do: 'set', pane: 1, key: 'integrator', value: 'restir_gi'});"
        "send({do: 'set', pane: 1, key: 'mode', value: 'biased'});"
        "send({do: 'set', pane: 1, key: 'cache', value: 'voxel'});"
        "await until(() => page.state.panes[1].cache === 'voxel'); await frame(); await frame();");
  }
};

TEST_F(PageLayoutTest, NamesAreWhole) {
  // Collects texts that their elements cut off.
  EXPECT_EQ(page(R"(
    const chosen = ['.live-header h1', '.tag', 'table.images .name', '.numbers-table thead th',
                    '.parameter > label', '.parameter > .label', '.header-buttons button'];
    const cut = [];
    for (const tab of ['methods', 'scene']) {
      page.tabs.show(tab);
      for (const one of document.querySelectorAll(chosen.join())) {
        if (!one.offsetParent) continue;
        const box = one.closest('td, th') || one;
        if (one.scrollWidth > one.clientWidth + 1 && getComputedStyle(one).display !== 'inline' ||
            one.scrollHeight > one.clientHeight + 2 && one.clientHeight > 0 ||
            one.getBoundingClientRect().right > box.getBoundingClientRect().right + 1) {
          cut.push(one.textContent);
        }
      }
    }
    return cut;)"),
            Json::array());
}

TEST_F(PageLayoutTest, TheToolbarIsOneRow) {
  EXPECT_LT(page("return document.querySelector('.live .toolbar').clientHeight;"), 40);
  EXPECT_EQ(page("return document.querySelector('.live .toolbar [data-command=exposure-reset]')"
                 ".offsetParent;"),
            nullptr)
      << "there is no room for it, and a key";
}

// The views fill the stage, and all of them share one zoom.
TEST_F(PageLayoutTest, SideBySideLeavesNothingEmpty) {
  press("b");
  EXPECT_EQ(page("await frame(); return viewer.stage.views.length;"), 3);
  const Json covered = page(R"(await frame();
    const {views, width, height} = viewer.stage;
    return views.reduce((sum, view) => sum + view.width * view.height, 0) / (width * height);)");
  EXPECT_GT(covered.get<double>(), 0.96);
  // The pointer finds the pixel where it is drawn.
  EXPECT_EQ(page(R"(const {views} = viewer.stage, {camera} = viewer;
    return views.map(view => viewer.stage.hit(...camera.toView(view, 20.5, 10.5)).pixel);)"),
            (Json{{{"x", 20}, {"y", 10}}, {{"x", 20}, {"y", 10}}, {{"x", 20}, {"y", 10}}}));
}

}  // namespace
}  // namespace restlab::view_test
