#include "tests/report/page.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <regex>

#include "experiments/report/report_html.h"

namespace restlab::report_test {

namespace fs = std::filesystem;

namespace {

std::string quoted(const std::string& text) { return Json(text).dump(); }

std::string element(const std::string& selector) {
  return "document.querySelector(" + quoted(selector) + ")";
}

// Parses a number as the page writes it.
float parse(const std::string& word) {
  if (word == "NaN") return std::numeric_limits<float>::quiet_NaN();
  if (word == "+Inf") return std::numeric_limits<float>::infinity();
  if (word == "-Inf") return -std::numeric_limits<float>::infinity();
  return std::strtof(word.c_str(), nullptr);
}

}  // namespace

void PageTest::SetUp() {
  if (findBrowser().empty()) GTEST_SKIP() << "Chromium is not installed (package chromium)";
  browser_ = std::make_unique<Browser>(1280, 900);
}

void PageTest::TearDown() {
  if (!browser_) return;
  EXPECT_TRUE(browser_->complaints().empty()) << browser_->complaints().front();
  EXPECT_TRUE(browser_->requests().empty()) << browser_->requests().front();
}

void PageTest::open(const ReportModel& model) {
  writeReport(folder_.path(), model);
  openFile(folder_.path() / "report.html");
}

void PageTest::openFile(const std::filesystem::path& report) {
  browser_->open(report);
  if (browser_->evaluate("document.querySelectorAll('.viewer').length") == 0) return;
  browser_->evaluate(element(".viewer") + ".scrollIntoView()");
  browser_->waitFor("document.querySelector('.viewer').dataset.drawn !== undefined");
  browser_->evaluate(element(".viewer") + ".scrollIntoView()");
  settle();
}

void PageTest::settle() {
  browser_->evaluate(
      "new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => done(1))))");
}

void PageTest::screenshot(const std::string& name, bool wholePage) {
  settle();
  const char* folder = std::getenv("RESTLAB_SCREENSHOTS");
  const fs::path file = fs::path(folder ? folder : folder_.path().c_str()) / (name + ".png");
  browser_->screenshot(file, wholePage);
  EXPECT_GT(fs::file_size(file), 5000u) << file;
  EXPECT_EQ(readFile(file).substr(1, 3), "PNG") << file;
}

Position PageTest::middle(const std::string& selector) {
  browser_->evaluate(element(selector) + ".scrollIntoView({block: 'center', inline: 'center'})");
  settle();
  const Json box = browser_->evaluate("(() => { const b = " + element(selector) +
                                      ".getBoundingClientRect(); return [b.x, b.y, b.width, "
                                      "b.height]; })()");
  return {double(box[0]) + double(box[2]) / 2.0, double(box[1]) + double(box[3]) / 2.0};
}

void PageTest::click(const std::string& selector) {
  const Position at = middle(selector);
  browser_->click(at.x, at.y);
  settle();
}

std::string PageTest::text(const std::string& selector) {
  return browser_->evaluate(element(selector) + ".textContent");
}

std::vector<std::string> PageTest::texts(const std::string& selector) {
  return browser_->evaluate("Array.from(document.querySelectorAll(" + quoted(selector) +
                            "), e => e.textContent)");
}

std::string PageTest::attribute(const std::string& selector, const std::string& name) {
  const Json value = browser_->evaluate(element(selector) + ".getAttribute(" + quoted(name) + ")");
  return value.is_string() ? value.get<std::string>() : "";
}

std::string PageTest::state(const std::string& name) {
  settle();
  return attribute(".viewer", "data-" + name);
}

Position PageTest::pixelPosition(double x, double y) {
  const Json box = browser_->evaluate(
      "(() => { const b = document.querySelector('.stage canvas').getBoundingClientRect(); "
      "const image = document.querySelector('.viewer').viewer.images[0]; "
      "return [b.x, b.y, b.width / image.width, b.height / image.height]; })()");
  return {double(box[0]) + (x + 0.5) * double(box[2]), double(box[1]) + (y + 0.5) * double(box[3])};
}

void PageTest::pointAt(double x, double y) {
  const Position at = pixelPosition(x, y);
  browser_->moveMouse(at.x, at.y);
  settle();
}

Status PageTest::status() {
  settle();
  const std::string line = text(".status");
  Status status;
  std::smatch match;
  if (!std::regex_search(line, match, std::regex("^x (\\d+)  y (\\d+)"))) return status;
  status.x = std::stoi(match[1]);
  status.y = std::stoi(match[2]);
  const std::regex value("   ([^:]+): (\\S+) (\\S+) (\\S+)");
  for (std::sregex_iterator it(line.begin(), line.end(), value), end; it != end; ++it) {
    status.values[(*it)[1]] = {parse((*it)[2]), parse((*it)[3]), parse((*it)[4])};
  }
  if (std::regex_search(line, match, std::regex("error: (\\S+)$"))) status.error = parse(match[1]);
  return status;
}

std::vector<int> PageTest::canvasBytes(Position at, int around) {
  // Read a copy: reading the page's canvas would change how the browser draws it.
  return browser_->evaluate(fmt::format(
      "(() => {{ const c = document.querySelector('.stage canvas'); const b = "
      "c.getBoundingClientRect(); const one = new OffscreenCanvas({2}, {2}).getContext('2d'); "
      "one.drawImage(c, {0} - b.x - {3}, {1} - b.y - {3}, {2}, {2}, 0, 0, {2}, {2}); return "
      "Array.from(one.getImageData(0, 0, {2}, {2}).data); }})()",
      std::floor(at.x), std::floor(at.y), 2 * around + 1, around));
}

std::vector<int> PageTest::canvasColour(Position at) {
  std::vector<int> colour = canvasBytes(at, 0);
  colour.resize(3);
  return colour;
}

}  // namespace restlab::report_test
