#include "experiments/runner/base/log.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <mutex>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "core/base/control_characters.h"
#include "core/base/error.h"
#include "experiments/runner/base/build_info.h"

namespace restlab {

namespace {

int level = 0;
bool isEventLog = false;

// Prints after all that stdout has so far: both may go to one file, as in the log of a job.
void printLast(const std::string& text) {
  std::fflush(stdout);
  std::fputs((text + "\n").c_str(), stderr);
  std::fflush(stderr);
}

// Prints one line, even if a file name or a library's message has line breaks.
void line(const std::string& text) { printLast(oneLine(text)); }

void say(const char* event, const char* prefix, const std::string& text) {
  if (isEventLog) {
    logEvent({{"event", event}, {"text", text}});
  } else {
    line(prefix + text);
  }
}

std::mutex warningsMutex;
std::vector<std::string> warnings;

void keep(const std::string& text) {
  const std::lock_guard lock(warningsMutex);
  if (warnings.size() >= kKeptWarnings) return;
  std::string kept = oneLine(text);
  if (kept.size() > kKeptWarningBytes) kept = kept.substr(0, kKeptWarningBytes - 4) + " ...";
  warnings.push_back(std::move(kept));
}

}  // namespace

std::vector<std::string> keptWarnings() {
  const std::lock_guard lock(warningsMutex);
  return warnings;
}

void setEventLog(bool isOn) { isEventLog = isOn; }

void logEvent(const nlohmann::ordered_json& event) {
  if (!isEventLog) return;
  nlohmann::ordered_json line = {{"utc", utcNow()}};
  line.update(event);
  // Replace invalid UTF-8, which file names may have.
  const auto anyBytes = nlohmann::ordered_json::error_handler_t::replace;
  printLast(jsonWithoutControls(line.dump(-1, ' ', false, anyBytes)));
}

void setVerbosity(int newLevel) { level = newLevel; }
int verbosity() { return level; }

void logInfo(const std::string& text) {
  if (level >= 0) say("info", "", text);
}
void logDetail(const std::string& text) {
  if (level >= 1) say("detail", "", text);
}
void logWarning(const std::string& text) {
  keep(text);
  say("warning", "warning: ", text);
}
void logError(const std::string& text) { say("error", "error: ", text); }

Progress::Progress(std::string label, uint64_t total, uint64_t already)
    : label_(std::move(label)),
      total_(total),
      already_(already),
      start_(Clock::now()),
      lastPrint_(start_),
      terminal_(isatty(STDERR_FILENO) != 0 && !isEventLog) {}

Progress::~Progress() { finish(); }

void Progress::update(uint64_t done, const std::string& note, const WholeProgress& whole) {
  if (level < 0) return;
  const auto now = Clock::now();
  const double sinceLastS = std::chrono::duration<double>(now - lastPrint_).count();
  const int tenth = total_ ? int(done * 10 / total_) : 0;
  // Without a terminal: print at each tenth, at first after 3 s, then at least every 30 s.
  const double silenceS = lastPrint_ == start_ ? 3.0 : 30.0;
  const bool due = terminal_ ? sinceLastS >= 0.2 || done == total_
                             : (tenth > lastTenth_ && sinceLastS >= 1.0) || sinceLastS >= silenceS;
  if (!due) return;
  lastPrint_ = now;
  lastTenth_ = tenth;
  print(done, note, whole);
}

void Progress::print(uint64_t done, const std::string& note, const WholeProgress& whole) {
  const double elapsedS = std::chrono::duration<double>(Clock::now() - start_).count();
  const double leftS = done > already_ && done < total_
                           ? elapsedS * double(total_ - done) / double(done - already_)
                           : 0.0;
  if (isEventLog) {
    nlohmann::ordered_json event = {
        {"event", "progress"}, {"of", label_}, {"done", done}, {"elapsed_s", elapsedS}};
    if (total_) event.update({{"total", total_}, {"left_s", leftS}});
    if (whole.total) {
      event.update({{"suite_done", whole.done},
                    {"suite_total", whole.total},
                    {"suite_left_s", whole.leftS}});
    }
    if (!note.empty()) event["note"] = note;
    return logEvent(event);
  }
  std::string text = label_;
  if (total_) {
    text += fmt::format(" {}/{} ({:.0f} s elapsed, {:.0f} s left)", done, total_, elapsedS, leftS);
  } else {
    text += fmt::format(" {} ({:.0f} s elapsed)", done, elapsedS);
  }
  // Skip the suite's progress if it has only this table.
  if (whole.total > total_)
    text += fmt::format("; suite {}/{} ({:.0f} s left)", whole.done, whole.total, whole.leftS);
  if (!note.empty()) text += " " + note;
  if (terminal_) {
    std::fputs(fmt::format("\r{:<78}", oneLine(text)).c_str(), stderr);
    std::fflush(stderr);
    open_ = true;
  } else {
    line(text);
  }
}

void Progress::finish() {
  if (open_) std::fputs("\n", stderr);
  open_ = false;
}

}  // namespace restlab
