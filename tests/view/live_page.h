// Live page in a browser, with its viewer running in the test program.
#pragma once

#include <string>

#include "tests/report/browser.h"
#include "tests/view/loop_fixture.h"

namespace restlab::view_test {

using report_test::Browser;

// Key named as in the commands' table, as the browser reports it.
struct Key {
  std::string key, code;
  bool shift = false, control = false, alt = false;
};
Key keyNamed(std::string name);

// Skips without a browser. Finally requires that the console has no errors and that only the
// viewer's server was asked.
class LivePageTest : public ViewLoopTest {
 protected:
  void SetUp() override;
  void TearDown() override;

  // restir_gi and path + accumulate, 64x36.
  static std::vector<SessionConfig> smallPanes();
  void serve(const std::vector<SessionConfig>& panes);
  // Serves view_ as it is.
  void serveView();
  // Serves images, opens the page and waits until all of them are there.
  void openFiles(ViewImages images);
  // Opens the address and waits until all three images are there.
  void open(Browser& browser);
  // Serves smallPanes() and opens the page.
  void open();
  // Waits for a page that is loading; ignores an old page that has set window.isOld.
  void waitUntilShown(Browser& browser, const std::vector<int>& images = {0, 1, 2});

  // Returns the value of the body of an async function in the page, which can use
  //   page, viewer        as the page has them
  //   until(holds)        waits until the function is true
  //   frame()             waits for the browser's next frame
  //   send(command)       sends a command to the program
  Json page(Browser& browser, const std::string& body);
  Json page(const std::string& body) { return page(*browser_, body); }
  // Returns when the page has received the last frame of both panes.
  void pause();

  // Sends real events, except for keys with Ctrl or Alt.
  void press(const std::string& name);
  // Makes window.delays collect, for each key that changes the exposure, the milliseconds from the
  // browser's event to the second frame that shows the change.
  void watchExposureKeys();
  void keyDown(const std::string& name);
  void keyUp(const std::string& name);
  void click(const std::string& selector);
  std::string text(const std::string& selector);
  // Window position of the centre of an image pixel. Requires a single view that shows the whole
  // image.
  std::pair<double, double> positionOf(uint32_t x, uint32_t y);

  void expectNothingWrong(const Browser& browser) const;

  std::unique_ptr<Browser> browser_;

 private:
  void dispatch(const char* type, const Key& key);
};

}  // namespace restlab::view_test
