// A report in a browser, for the tests that drive it.
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

// What the status line says of the pixel under the pointer.
struct Status {
  int x = -1, y = -1;
  std::map<std::string, std::vector<float>> values;  // by the image's name: R, G, B
  double error = 0.0;                                // of the error view; 0 without one
};

// Skips without a browser. In the end nothing may have been requested and nothing complained of.
class PageTest : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  // Writes the report of a model and opens it; returns once its first viewer is there.
  void open(const ReportModel& model);
  // The same with a report that is there.
  void openFile(const std::filesystem::path& report);
  // Waits until what was asked for is drawn.
  void settle();
  // A picture for people, in the folder RESTLAB_SCREENSHOTS where that is set.
  void screenshot(const std::string& name, bool wholePage = false);

  // Scrolls an element to where it can be clicked; its middle.
  Position middle(const std::string& selector);
  void click(const std::string& selector);
  std::string text(const std::string& selector);
  std::vector<std::string> texts(const std::string& selector);
  std::string attribute(const std::string& selector, const std::string& name);
  // A field of the viewer's state: current, compare, mode, error, stops, tone, scale.
  std::string state(const std::string& name);

  // The middle of an image pixel in the window, while one view fills the stage.
  Position pixelPosition(double x, double y);
  void pointAt(double x, double y);
  Status status();
  // R, G, B, A of all canvas pixels at most `around` from a position of the window; R, G, B there.
  std::vector<int> canvasBytes(Position at, int around);
  std::vector<int> canvasColour(Position at);

  TemporaryFolder folder_;
  std::unique_ptr<Browser> browser_;
};

}  // namespace restlab::report_test
