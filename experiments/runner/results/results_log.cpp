#include "experiments/runner/results/results_log.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "core/base/control_characters.h"
#include "core/base/error.h"
#include "experiments/runner/base/log.h"

namespace restlab {

namespace fs = std::filesystem;

ResultsLog::ResultsLog(fs::path file) : file_(std::move(file)) {
  std::ifstream in(file_, std::ios::binary);
  if (!in) return;
  uintmax_t whole = 0;  // of complete jobs
  uintmax_t bytes = 0;  // of complete lines
  size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    if (in.eof()) break;  // no end of line
    bytes += line.size() + 1;
    ++number;
    const auto json = nlohmann::ordered_json::parse(line, nullptr, false);
    if (!json.is_object()) {
      failInput(fmt::format("{}:{}: is no JSON object; move the file away or mend the line",
                            file_.string(), number));
    }
    if (!json.value("job_ends", true)) continue;
    whole = bytes;
    if (json.contains("job")) jobs_.insert(json.at("job").get<std::string>());
  }
  in.close();
  std::error_code status;
  const uintmax_t size = fs::file_size(file_, status);
  if (status || size <= whole) return;
  logInfo(fmt::format("{}: its last lines are of a run that was not written whole; cut off",
                      file_.string()));
  fs::resize_file(file_, whole, status);
  if (status) failInput(fmt::format("{}: cannot be mended: {}", file_.string(), status.message()));
}

void ResultsLog::add(const std::string& key, const JobData& job, bool isMadeAnew) {
  const bool isKnown = jobs_.count(key) != 0;
  if (isKnown && !isMadeAnew) return;
  // Mark the last line of a job, so that a reader can tell whether the job is complete.
  std::string text;
  for (const JobMethod& method : job.methods) {
    for (const nlohmann::ordered_json& own : method.lines) {
      nlohmann::ordered_json line = own;
      if (isKnown) line["replaces_earlier"] = true;
      line["job_ends"] = &method == &job.methods.back() && &own == &method.lines.back();
      text += jsonWithoutControls(line.dump()) + "\n";
    }
  }
  std::error_code status;
  const uintmax_t before = fs::exists(file_, status) ? fs::file_size(file_, status) : 0;
  std::ofstream out(file_, std::ios::binary | std::ios::app);
  out << text << std::flush;
  const bool written = bool(out);
  const int reason = errno;
  out.close();
  if (!written) {
    fs::resize_file(file_, before, status);
    failInput(fmt::format("{}: cannot be written: {}", file_.string(), std::strerror(reason)));
  }
  jobs_.insert(key);
}

}  // namespace restlab
