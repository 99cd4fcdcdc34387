// `restlab run` of a saved session, as a process of its own. It ends with the thread that has begun
// it, by whatever ends that.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

namespace restlab {

class Measurement {
 public:
  enum class State { none, running, finished, failed, cancelled };

  Measurement() = default;
  // Ends the run: what is finished of it stays in its folder.
  ~Measurement();
  Measurement(const Measurement&) = delete;
  Measurement& operator=(const Measurement&) = delete;

  // `program` run `suite` -o `out` in `folder`. None is running. Throws Error (badInput) where it
  // cannot be begun.
  void begin(const std::filesystem::path& program, const std::filesystem::path& folder,
             const std::string& suite, const std::string& out);
  // Reads what it has said; never waits. True where something is new.
  bool poll();
  // It ends when it has kept what is finished.
  void cancel();

  State state() const { return state_; }
  bool isRunning() const { return state_ == State::running; }
  // The last line that it said, for people.
  const std::string& text() const { return text_; }
  // Of the whole suite, from 0 to 1; 0 while it is unknown.
  double done() const { return done_; }
  // The suite, and the folder of results, as begin() was given them.
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
};

}  // namespace restlab
