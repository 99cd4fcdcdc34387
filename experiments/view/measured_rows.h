// Rows of a run that is under way: means per method over the runs that results.jsonl has so far.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace restlab {

struct MeasuredRow {
  std::string method;
  uint64_t runs = 0;
  double mse = 0.0, relmse = 0.0, energy = 0.0;  // means over runs
  double timeMs = 0.0;                           // mean of the runs' medians of a frame
};

class MeasuredRows {
 public:
  // Rows beyond are left out.
  static constexpr size_t kMostRows = 64;

  // Follows a file, which need not exist yet. Lines that it has already are of an earlier run.
  void follow(const std::filesystem::path& file);
  // Reads whole new lines; returns whether there are new rows or values. Lines without a method's
  // errors are passed over.
  bool poll();
  // In the order in which methods appear.
  const std::vector<MeasuredRow>& rows() const { return rows_; }

 private:
  void hear(const std::string& line);

  std::filesystem::path file_;
  uintmax_t read_ = 0;  // bytes of whole lines
  std::vector<MeasuredRow> rows_;
};

}  // namespace restlab
