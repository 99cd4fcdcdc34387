// Runs `restlab run` on a saved session, as a process of its own. The process ends with the thread
// that began it, however that ends.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

#include "experiments/view/measured_rows.h"

namespace restlab {

class Measurement {
 public:
  enum class State { none, running, finished, failed, cancelled };

  Measurement() = default;
  // Ends the run; finished results stay in its folder.
  ~Measurement();
  Measurement(const Measurement&) = delete;
  Measurement& operator=(const Measurement&) = delete;

  // Starts `program` run `suite` -o `out` in `folder`. None may be running. Throws Error (badInput)
  // if it cannot be started.
  void begin(const std::filesystem::path& program, const std::filesystem::path& folder,
             const std::string& suite, const std::string& out);
  // Reads the process's output; never waits. Returns true if something is new.
  bool poll();
  // Asks the process to end; it stores its finished results first.
  void cancel();

  State state() const { return state_; }
  bool isRunning() const { return state_ == State::running; }
  // Rows of its table so far.
  const std::vector<MeasuredRow>& rows() const { return rows_.rows(); }
  // Last line of output, for people.
  const std::string& text() const { return text_; }
  // Progress of the whole suite, from 0 to 1; 0 while unknown.
  double done() const { return done_; }
  // Arguments of begin(): the suite and the folder of results.
  const std::string& suite() const { return suite_; }
  std::filesystem::path report() const { return folder_ / out_ / "report.html"; }
  const std::string& out() const { return out_; }

 private:
  bool read();
  void hear(const std::string& line);
  void end(int status);

  State state_ = State::none;
  pid_t child_ = 0;
  int pipe_ = -1;
  bool isCancelled_ = false;
  std::filesystem::path folder_;
  std::string suite_, out_, text_, rest_, error_;
  double done_ = 0.0;
  MeasuredRows rows_;
};

}  // namespace restlab
