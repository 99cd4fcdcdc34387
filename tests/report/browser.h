// A headless Chromium that a test drives: DevTools protocol over two pipes, real input events.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace restlab::report_test {

using Json = nlohmann::json;

// The program, looked for in PATH; "" where there is none.
std::string findBrowser();

// One page. Every call waits for its answer; what goes wrong throws std::runtime_error.
class Browser {
 public:
  // Starts the program with a profile below `folder`.
  Browser(const std::filesystem::path& folder, int width, int height);
  ~Browser();
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

  // Loads a file and waits until it is loaded.
  void open(const std::filesystem::path& file);

  // Value of an expression, once it is resolved where it is a promise.
  Json evaluate(const std::string& expression);
  // Evaluates until the value is true; throws after `seconds`.
  void waitFor(const std::string& condition, double seconds = 30.0);

  // Real events at positions of the window in CSS pixels.
  void moveMouse(double x, double y);
  void click(double x, double y);
  void drag(double x0, double y0, double x1, double y1);
  void wheel(double x, double y, double deltaY);
  // A key as `KeyboardEvent.key` and `.code` name it: press("2", "Digit2").
  void press(const std::string& key, const std::string& code, bool shift = false);
  void keyDown(const std::string& key, const std::string& code, bool shift = false);
  void keyUp(const std::string& key, const std::string& code, bool shift = false);

  void resize(int width, int height);
  void setDark(bool dark);
  // Of the window, or of the whole page; a PNG.
  void screenshot(const std::filesystem::path& file, bool wholePage = false);

  // Requests other than for the file that was opened, in the order in which they were made.
  const std::vector<std::string>& requests() const { return requests_; }
  // Errors and warnings of the console, and exceptions that nobody caught.
  const std::vector<std::string>& complaints() const { return complaints_; }

 private:
  // Makes a page of its own.
  void attach(int width, int height);
  void end();
  Json call(const std::string& method, const Json& parameters, bool ofPage = true);
  Json receive(double deadlineS);
  void note(const Json& event);
  void mouse(const char* type, double x, double y, int buttons, int clicks);
  void sendKey(const char* type, const std::string& key, const std::string& code, bool shift);

  pid_t child_ = -1;
  int in_ = -1, out_ = -1;  // of the program: we write to in_, read from out_
  int lastId_ = 0;
  std::string session_, opened_, buffer_;
  bool loaded_ = false;
  std::vector<std::string> requests_, complaints_;
};

}  // namespace restlab::report_test
