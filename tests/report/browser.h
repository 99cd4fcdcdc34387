// Headless Chromium driven by a test: DevTools protocol over two pipes, real input events.
#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace restlab::report_test {

using Json = nlohmann::json;

// Returns the program found in PATH; "" if there is none.
std::string findBrowser();

class BrowserProcess;

// One page, with a profile of its own. The first one of a test program starts Chromium, which ends
// with the program. Every call waits for its answer; errors throw std::runtime_error.
class Browser {
 public:
  // Opens an empty page of the given size in CSS pixels.
  Browser(int width, int height);
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  // Loads a file and waits until it is loaded.
  void open(const std::filesystem::path& file);

  // Returns the value of an expression; waits for a promise.
  Json evaluate(const std::string& expression);
  // Evaluates until the value is true; throws after `seconds`.
  void waitFor(const std::string& condition, double seconds = 30.0);

  // Real events at window positions in CSS pixels.
  void moveMouse(double x, double y);
  void click(double x, double y);
  void drag(double x0, double y0, double x1, double y1, bool shift = false);
  void wheel(double x, double y, double deltaY);
  // Key named by `KeyboardEvent.key` and `.code`: press("2", "Digit2").
  void press(const std::string& key, const std::string& code, bool shift = false);
  void keyDown(const std::string& key, const std::string& code, bool shift = false);
  void keyUp(const std::string& key, const std::string& code, bool shift = false);

  void resize(int width, int height);
  void setDark(bool dark);
  // Writes a PNG of the window or of the whole page.
  void screenshot(const std::filesystem::path& file, bool wholePage = false);

  // Requests other than for the opened file, in order.
  const std::vector<std::string>& requests() const { return requests_; }
  // Errors and warnings of the console, and uncaught exceptions.
  const std::vector<std::string>& complaints() const { return complaints_; }
  // Returns them and forgets them: a test has expected them.
  std::vector<std::string> takeComplaints() { return std::exchange(complaints_, {}); }

 private:
  friend class BrowserProcess;

  Json call(const std::string& method, const Json& parameters);
  void note(const Json& event);
  void mouse(const char* type, double x, double y, int buttons, int clicks, bool shift = false);
  void sendKey(const char* type, const std::string& key, const std::string& code, bool shift);

  std::shared_ptr<BrowserProcess> process_;
  std::string profile_, session_, opened_;
  bool loaded_ = false;
  std::vector<std::string> requests_, complaints_;
};

}  // namespace restlab::report_test
