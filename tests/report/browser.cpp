#include "tests/report/browser.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "experiments/report/pixels.h"
#include "tests/report/sample.h"

namespace restlab::report_test {

namespace fs = std::filesystem;

namespace {

constexpr double kAnswerS = 60.0;

double nowS() {
  using namespace std::chrono;
  return duration<double>(steady_clock::now().time_since_epoch()).count();
}

// Runs in the child: Chromium expects the protocol's pipes at descriptors 3 and 4.
[[noreturn]] void becomeBrowser(const std::string& program, const fs::path& folder, int read,
                                int write) {
  setpgid(0, 0);
  // Move both above 4 first: one may occupy the other's place.
  const int in = fcntl(read, F_DUPFD, 10), out = fcntl(write, F_DUPFD, 10);
  const int log = open((folder / "browser.log").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  const int none = ::open("/dev/null", O_RDONLY);
  dup2(none, STDIN_FILENO);
  dup2(log, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  dup2(in, 3);
  dup2(out, 4);
  for (int fd = 5; fd < 64; ++fd) close(fd);
  setenv("HOME", folder.c_str(), 1);
  std::vector<std::string> words = {program,
                                    "--headless",
                                    "--remote-debugging-pipe",
                                    "--user-data-dir=" + (folder / "profile").string(),
                                    "--force-device-scale-factor=1",
                                    "--disable-gpu",
                                    "--disable-dev-shm-usage",
                                    "--disable-background-networking",
                                    "--disable-component-update",
                                    "--disable-sync",
                                    "--no-first-run",
                                    "--no-default-browser-check",
                                    "--mute-audio"};
  // Enables WebGL2 without a GPU, for the tests that need it.
  words.push_back("--enable-unsafe-swiftshader");
  // Chromium's sandbox does not start for root.
  if (geteuid() == 0) words.push_back("--no-sandbox");
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  execv(argv[0], argv.data());
  _exit(127);
}

}  // namespace

std::string findBrowser() {
  const char* path = std::getenv("PATH");
  for (const char* name : {"chromium", "chromium-browser", "google-chrome-stable"}) {
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
      const std::string file = folder + "/" + name;
      if (access(file.c_str(), X_OK) == 0) return file;
    }
  }
  return "";
}

// Chromium, with its profile and its log in a folder that goes with it.
class BrowserProcess {
 public:
  // Returns the one of this program; starts it if there is none, or if it has ended.
  static std::shared_ptr<BrowserProcess> get();
  BrowserProcess();
  ~BrowserProcess() { end(); }
  BrowserProcess(const BrowserProcess&) = delete;
  BrowserProcess& operator=(const BrowserProcess&) = delete;

  // Returns the answer of a page, or without `session` of the browser.
  Json call(const std::string& method, const Json& parameters, const std::string& session = "");
  // Handles one message that answers no call.
  void receiveEvent(double deadlineS);

  std::map<std::string, Browser*> pages;  // by session

 private:
  Json receive(double deadlineS);
  void note(const Json& event);
  [[noreturn]] void hasEnded() const;
  void end();

  TemporaryFolder folder_;
  pid_t child_ = -1;
  int in_ = -1, out_ = -1;  // pipes of the program: in_ is written to, out_ is read
  int lastId_ = 0;
  std::string buffer_;
};

std::shared_ptr<BrowserProcess> BrowserProcess::get() {
  static std::shared_ptr<BrowserProcess> process;
  if (process) {
    try {
      process->call("Browser.getVersion", Json::object());
    } catch (const std::runtime_error&) {
      process.reset();
    }
  }
  if (!process) process = std::make_shared<BrowserProcess>();
  return process;
}

BrowserProcess::BrowserProcess() {
  // Without this, writing to a dead browser would raise a signal instead of an error.
  signal(SIGPIPE, SIG_IGN);
  int toChild[2], fromChild[2];
  if (pipe2(toChild, O_CLOEXEC) != 0 || pipe2(fromChild, O_CLOEXEC) != 0) {
    throw std::runtime_error(std::string("pipe: ") + std::strerror(errno));
  }
  const std::string program = findBrowser();
  child_ = fork();
  if (child_ == 0) becomeBrowser(program, folder_.path(), toChild[0], fromChild[1]);
  close(toChild[0]);
  close(fromChild[1]);
  in_ = toChild[1];
  out_ = fromChild[0];
}

void BrowserProcess::end() {
  close(in_);
  close(out_);
  // The browser ends when its pipe closes; otherwise kill its whole process group.
  for (int i = 0; i < 50; ++i) {
    if (waitpid(child_, nullptr, WNOHANG) != 0) {
      child_ = -1;
      break;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  if (child_ > 0) {
    kill(-child_, SIGKILL);
    waitpid(child_, nullptr, 0);
  }
}

void BrowserProcess::hasEnded() const {
  std::ifstream log(folder_.path() / "browser.log");
  std::ostringstream text;
  text << log.rdbuf();
  throw std::runtime_error("the browser has ended: " + text.str());
}

Json BrowserProcess::receive(double deadlineS) {
  for (;;) {
    const size_t end = buffer_.find('\0');
    if (end != std::string::npos) {
      const Json message = Json::parse(buffer_.substr(0, end));
      buffer_.erase(0, end + 1);
      return message;
    }
    pollfd waiting = {out_, POLLIN, 0};
    const double left = deadlineS - nowS();
    if (left <= 0.0) throw std::runtime_error("the browser does not answer");
    if (poll(&waiting, 1, int(left * 1000.0) + 1) <= 0) continue;
    char bytes[65536];
    const ssize_t size = read(out_, bytes, sizeof(bytes));
    if (size <= 0) hasEnded();
    buffer_.append(bytes, size_t(size));
  }
}

void BrowserProcess::note(const Json& event) {
  const auto page = pages.find(event.value("sessionId", ""));
  if (page != pages.end()) page->second->note(event);
}

void BrowserProcess::receiveEvent(double deadlineS) { note(receive(deadlineS)); }

Json BrowserProcess::call(const std::string& method, const Json& parameters,
                          const std::string& session) {
  Json request = {{"id", ++lastId_}, {"method", method}, {"params", parameters}};
  if (!session.empty()) request["sessionId"] = session;
  const std::string text = request.dump() + '\0';
  for (size_t sent = 0; sent < text.size();) {
    const ssize_t size = write(in_, text.data() + sent, text.size() - sent);
    if (size <= 0) hasEnded();
    sent += size_t(size);
  }
  const double deadline = nowS() + kAnswerS;
  for (;;) {
    const Json message = receive(deadline);
    if (message.value("id", 0) != lastId_) {
      note(message);
    } else if (message.contains("error")) {
      throw std::runtime_error(method + ": " + message["error"].dump());
    } else {
      return message["result"];
    }
  }
}

Browser::Browser(int width, int height) : process_(BrowserProcess::get()) {
  profile_ = process_->call("Target.createBrowserContext", Json::object())["browserContextId"];
  const Json target = process_->call("Target.createTarget",
                                     {{"url", "about:blank"}, {"browserContextId", profile_}});
  session_ = process_->call("Target.attachToTarget",
                            {{"targetId", target["targetId"]}, {"flatten", true}})["sessionId"];
  process_->pages[session_] = this;
  for (const char* domain : {"Page", "Runtime", "Network", "Log"}) {
    call(std::string(domain) + ".enable", Json::object());
  }
  // Each page takes itself to be the one in front.
  call("Emulation.setFocusEmulationEnabled", {{"enabled", true}});
  resize(width, height);
}

Browser::~Browser() {
  process_->pages.erase(session_);
  try {
    process_->call("Target.disposeBrowserContext", {{"browserContextId", profile_}});
  } catch (const std::runtime_error&) {
    // It has ended: the next page starts another one.
  }
}

Json Browser::call(const std::string& method, const Json& parameters) {
  return process_->call(method, parameters, session_);
}

void Browser::note(const Json& event) {
  const std::string method = event.value("method", "");
  const Json parameters = event.value("params", Json::object());
  if (method == "Page.loadEventFired") loaded_ = true;
  if (method == "Network.requestWillBeSent") {
    const std::string url = parameters["request"]["url"];
    if (url != opened_) requests_.push_back(url);
  }
  // Ignore warnings about slow readback of a software-rendered picture.
  if (parameters.dump().find("GL Driver Message (OpenGL, Performance") != std::string::npos) return;
  if (method == "Runtime.exceptionThrown") complaints_.push_back(parameters.dump());
  if (method == "Runtime.consoleAPICalled" &&
      (parameters["type"] == "error" || parameters["type"] == "warning")) {
    complaints_.push_back(parameters.dump());
  }
  if (method == "Log.entryAdded" && parameters["entry"]["level"] != "info" &&
      parameters["entry"]["level"] != "verbose") {
    complaints_.push_back(parameters.dump());
  }
}

void Browser::open(const fs::path& file) {
  opened_ = "file://" + fs::absolute(file).string();
  loaded_ = false;
  const Json result = call("Page.navigate", {{"url", opened_}});
  if (result.contains("errorText")) {
    throw std::runtime_error(opened_ + ": " + result["errorText"].get<std::string>());
  }
  const double deadline = nowS() + kAnswerS;
  while (!loaded_) process_->receiveEvent(deadline);
}

Json Browser::evaluate(const std::string& expression) {
  const Json result =
      call("Runtime.evaluate",
           {{"expression", expression}, {"returnByValue", true}, {"awaitPromise", true}});
  if (result.contains("exceptionDetails")) {
    throw std::runtime_error(expression + ": " + result["exceptionDetails"].dump());
  }
  return result["result"].value("value", Json());
}

void Browser::waitFor(const std::string& condition, double seconds) {
  const double deadline = nowS() + seconds;
  while (evaluate(condition) != true) {
    if (nowS() > deadline) throw std::runtime_error("never true: " + condition);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

void Browser::mouse(const char* type, double x, double y, int buttons, int clicks, bool shift) {
  call("Input.dispatchMouseEvent", {{"type", type},
                                    {"x", x},
                                    {"y", y},
                                    {"button", buttons || clicks ? "left" : "none"},
                                    {"buttons", buttons},
                                    {"modifiers", shift ? 8 : 0},
                                    {"clickCount", clicks}});
}

void Browser::moveMouse(double x, double y) { mouse("mouseMoved", x, y, 0, 0); }

void Browser::click(double x, double y) {
  moveMouse(x, y);
  mouse("mousePressed", x, y, 1, 1);
  mouse("mouseReleased", x, y, 0, 1);
}

void Browser::drag(double x0, double y0, double x1, double y1, bool shift) {
  moveMouse(x0, y0);
  mouse("mousePressed", x0, y0, 1, 1, shift);
  constexpr int kSteps = 4;
  for (int i = 1; i <= kSteps; ++i) {
    const double at = double(i) / kSteps;
    mouse("mouseMoved", x0 + at * (x1 - x0), y0 + at * (y1 - y0), 1, 0, shift);
  }
  mouse("mouseReleased", x1, y1, 0, 1, shift);
}

void Browser::wheel(double x, double y, double deltaY) {
  call("Input.dispatchMouseEvent",
       {{"type", "mouseWheel"}, {"x", x}, {"y", y}, {"deltaX", 0}, {"deltaY", deltaY}});
}

void Browser::sendKey(const char* type, const std::string& key, const std::string& code,
                      bool shift) {
  Json event = {{"type", type}, {"key", key}, {"code", code}, {"modifiers", shift ? 8 : 0}};
  // Default actions of the browser (a click, closing a dialog) depend on the key's number.
  static const std::map<std::string, int> numbers = {
      {"Enter", 13}, {"Escape", 27}, {"End", 35}, {"ArrowLeft", 37}, {"ArrowRight", 39}};
  const auto number = numbers.find(key);
  if (number != numbers.end()) {
    event["windowsVirtualKeyCode"] = number->second;
  } else if (key.size() == 1) {
    event["windowsVirtualKeyCode"] = std::toupper(static_cast<unsigned char>(key[0]));
  }
  if (std::strcmp(type, "keyDown") == 0 && (key.size() == 1 || key == "Enter")) {
    event["text"] = key == "Enter" ? "\r" : key;
  }
  call("Input.dispatchKeyEvent", event);
}

void Browser::keyDown(const std::string& key, const std::string& code, bool shift) {
  sendKey("keyDown", key, code, shift);
}
void Browser::keyUp(const std::string& key, const std::string& code, bool shift) {
  sendKey("keyUp", key, code, shift);
}
void Browser::press(const std::string& key, const std::string& code, bool shift) {
  keyDown(key, code, shift);
  keyUp(key, code, shift);
}

void Browser::resize(int width, int height) {
  call("Emulation.setDeviceMetricsOverride",
       {{"width", width}, {"height", height}, {"deviceScaleFactor", 1}, {"mobile", false}});
}

void Browser::setDark(bool dark) {
  call("Emulation.setEmulatedMedia",
       {{"features", {{{"name", "prefers-color-scheme"}, {"value", dark ? "dark" : "light"}}}}});
}

void Browser::screenshot(const fs::path& file, bool wholePage) {
  const Json shot =
      call("Page.captureScreenshot", {{"format", "png"}, {"captureBeyondViewport", wholePage}});
  std::ofstream(file, std::ios::binary) << decodeBase64(shot["data"].get<std::string>());
}

}  // namespace restlab::report_test
