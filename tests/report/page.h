// Fixture: a report in a browser.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "tests/report/browser.h"
#include "tests/report/sample.h"

namespace restlab::report_test {

struct Position {
  double x = 0.0, y = 0.0;
};

// Parsed status line of the pixel under the pointer.
struct Status {
  int x = -1, y = -1;
  std::map<std::string, std::vector<float>> values;  // by the image's name: R, G, B
  double error = 0.0;                                // value of the error view; 0 without one
};

// Skips without a browser. Finally requires no requests and no errors in the console.
class PageTest : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  // Writes the report of a model and opens it; returns when its first viewer is ready.
  void open(const ReportModel& model);
  // Opens an existing report; returns when its first viewer is ready.
  void openFile(const std::filesystem::path& report);
  // Waits until pending drawing is done.
  void settle();
  // Saves a screenshot in the folder RESTLAB_SCREENSHOTS, if that is set.
  void screenshot(const std::string& name, bool wholePage = false);

  // Scrolls an element into view and returns its centre.
  Position middle(const std::string& selector);
  void click(const std::string& selector);
  std::string text(const std::string& selector);
  std::vector<std::string> texts(const std::string& selector);
  std::string attribute(const std::string& selector, const std::string& name);
  // Field of the viewer's state: current, compare, mode, error, stops, tone, scale.
  std::string state(const std::string& name);

  // Window position of the centre of an image pixel. Requires a single view.
  Position pixelPosition(double x, double y);
  void pointAt(double x, double y);
  Status status();
  // Returns R, G, B, A of all canvas pixels at most `around` from a window position, or R, G, B of
  // one.
  std::vector<int> canvasBytes(Position at, int around);
  std::vector<int> canvasColour(Position at);

  TemporaryFolder folder_;
  std::unique_ptr<Browser> browser_;
};

}  // namespace restlab::report_test
