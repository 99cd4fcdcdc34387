// Messages for users, on stderr; stdout carries data only. No colours, so that a file reads the
// same.
#pragma once

#include <chrono>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace restlab {

// -1: errors and warnings only (-q); 0: normal; 1 or more: details (-v).
void setVerbosity(int level);
int verbosity();

void logInfo(const std::string& line);     // normal
void logDetail(const std::string& line);   // with -v
void logWarning(const std::string& line);  // always, prefixed "warning: "
void logError(const std::string& line);    // always, prefixed "error: "

// Returns the first warnings of this program, at most kKeptWarnings, each in at most
// kKeptWarningBytes. Thread-safe.
std::vector<std::string> keptWarnings();
constexpr size_t kKeptWarnings = 32, kKeptWarningBytes = 500;

// Switches from text lines to one JSON object per line: "event" ("info", "detail", "warning",
// "error", "progress", or as given to logEvent()), "utc" and further fields.
void setEventLog(bool isOn);
// Does nothing for text lines. Thread-safe, like all functions here.
void logEvent(const nlohmann::ordered_json& event);

// Progress of all loops together, and their remaining time.
struct WholeProgress {
  uint64_t done = 0, total = 0;  // total 0: unknown
  double leftS = 0.0;
};

// Progress of a loop: on a terminal one line that is rewritten, else a line per 10 % or 30 s.
class Progress {
 public:
  // `total` 0: unknown. `already`: number done before the loop began.
  Progress(std::string label, uint64_t total, uint64_t already = 0);
  ~Progress();
  void update(uint64_t done, const std::string& note = "", const WholeProgress& whole = {});
  void finish();

 private:
  void print(uint64_t done, const std::string& note, const WholeProgress& whole);
  using Clock = std::chrono::steady_clock;
  std::string label_;
  uint64_t total_, already_;
  Clock::time_point start_, lastPrint_;
  int lastTenth_ = 0;
  bool terminal_, open_ = false;
};

}  // namespace restlab
