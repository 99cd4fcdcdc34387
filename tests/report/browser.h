// Headless Chromium driven by a test: DevTools protocol over two pipes, real input events.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace restlab::report_test {

using Json = nlohmann::json;

// Returns the program found in PATH; "" if there is none.
std::string findBrowser();

// One page. Every call waits for its answer; errors throw std::runtime_error.
class Browser {
 public:
  // Starts the program with a profile below `folder`.
  Browser(const std::filesystem::path& folder, int width, int height);
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
  void drag(double x0, double y0, double x1, double y1);
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

 private:
  // Opens a new page.
  void attach(int width, int height);
  void end();
  Json call(const std::string& method, const Json& parameters, bool ofPage = true);
  Json receive(double deadlineS);
  void note(const Json& event);
  void mouse(const char* type, double x, double y, int buttons, int clicks);
  void sendKey(const char* type, const std::string& key, const std::string& code, bool shift);

  pid_t child_ = -1;
  int in_ = -1, out_ = -1;  // pipes of the program: in_ is written to, out_ is read
  int lastId_ = 0;
  std::string session_, opened_, buffer_;
  bool loaded_ = false;
  std::vector<std::string> requests_, complaints_;
};

}  // namespace restlab::report_test
