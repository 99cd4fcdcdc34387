// What a folder of results shows: made of jobs alone, so that it can be made again at any time.
#pragma once

#include <deque>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/runner/suite/suite_check.h"
#include "experiments/runner/summary/scene_sweep.h"
#include "experiments/runner/summary/summary.h"

namespace restlab {

class Outputs {
 public:
  explicit Outputs(std::filesystem::path out) : out_(std::move(out)) {}

  // Summarises a block and writes its images; its images are freed, its numbers stay. `suite` must
  // outlive this. Returns the block's table.
  std::string add(const Suite& suite, BlockResult block);
  // A line below the tables' heading.
  void note(const std::string& line) { notes_.push_back(line); }
  // What methods ran on; shown below the tables.
  void use(const std::vector<DeviceUse>& devices) { devices_ = devices; }
  // summary.csv, table.md and table.tex. `suite`: any point, for name and question.
  void write(const Suite& suite, bool finished) const;
  // The tables of sweeps of scenes; "" where there is none.
  std::string sweepTables() const;
  // Where values are not finite, in a line; "" where all are.
  std::string nonfinite() const;
  // Which rows have an energy that is far off (isFarOff()); "": none.
  std::string wrongEnergies() const;
  // The blocks of the report: sweeps first, then scenes, as parts of their sweep.
  std::vector<nlohmann::ordered_json> documents() const;
  // report.html and plots/*.svg; `record`: run.json. Nothing where there is no block.
  void writePages(const Suite& suite, const nlohmann::ordered_json& record) const;

 private:
  struct Block {
    const Suite* suite;
    BlockResult result;
    std::vector<MethodSummary> rows;  // point into `result`
    double referenceMean;             // over pixels and channels
  };
  std::vector<SceneSweep> sweeps() const;

  std::filesystem::path out_;
  std::deque<Block> blocks_;                       // addresses must stay
  std::vector<nlohmann::ordered_json> documents_;  // of the blocks
  std::vector<std::string> notes_;
  std::vector<DeviceUse> devices_;
};

}  // namespace restlab
