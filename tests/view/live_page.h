// The live page in a browser, with the viewer that it shows at work in the same program.
#pragma once

#include <string>

#include "tests/report/browser.h"
#include "tests/view/loop_fixture.h"

namespace restlab::view_test {

using report_test::Browser;

// A key as a command names it, as the browser has it.
struct Key {
  std::string key, code;
  bool shift = false, control = false, alt = false;
};
Key keyNamed(std::string name);

// Skips without a browser. In the end nothing may have been complained of in the console, nor
// anything been requested but of the viewer.
class LivePageTest : public ViewLoopTest {
 protected:
  void SetUp() override;
  void TearDown() override;

  // restir_gi beside path + accumulate, 64x36.
  static std::vector<SessionConfig> smallPanes();
  void serve(const std::vector<SessionConfig>& panes);
  // The view that is there.
  void serveView();
  // Opens the address and waits until all three images are there.
  void open(Browser& browser);
  // Serves the small panes, and opens them.
  void open();
  // The same of a page that is on its way; one that sets window.isOld is not meant.
  void waitUntilShown(Browser& browser, const std::vector<int>& images = {0, 1, 2});

  // The value of the body of an async function of the page, which has
  //   page, viewer        as the page has them
  //   until(holds)        waits until it is true
  //   frame()             waits for the next frame of the browser
  //   send(command)       to the program
  Json page(Browser& browser, const std::string& body);
  Json page(const std::string& body) { return page(*browser_, body); }
  // Returns once the page has the last frame of both panes.
  void pause();

  // Real events, apart from keys with Ctrl or Alt.
  void press(const std::string& name);
  // From now on window.delays gets, of each key that changes the exposure, the milliseconds from
  // the browser's event to the second frame of the page that has it.
  void watchExposureKeys();
  void keyDown(const std::string& name);
  void keyUp(const std::string& name);
  void click(const std::string& selector);
  std::string text(const std::string& selector);
  // The window's position of the middle of an image pixel, while one view fills the stage and the
  // whole image is in it.
  std::pair<double, double> positionOf(uint32_t x, uint32_t y);

  void expectNothingWrong(const Browser& browser) const;

  std::unique_ptr<Browser> browser_;

 private:
  void dispatch(const char* type, const Key& key);
};

}  // namespace restlab::view_test
