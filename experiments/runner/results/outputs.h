// Tables, images and report of a folder of results, made from jobs alone, so they can be made
// again.
#pragma once

#include <deque>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/runner/tables/scene_sweep.h"
#include "experiments/runner/tables/summary.h"

namespace restlab {

class Outputs {
 public:
  explicit Outputs(std::filesystem::path out) : out_(std::move(out)) {}

  // Summarises a block and writes its images; then frees its images and keeps its numbers. `suite`
  // must outlive this object. Returns the block's table.
  std::string add(const Suite& suite, BlockResult block);
  // Adds a line below the tables' heading.
  void note(const std::string& line) { notes_.push_back(line); }
  // Sets the devices shown below the tables.
  void use(const std::vector<DeviceUse>& devices) { devices_ = devices; }
  // Writes summary.csv, table.md and table.tex. `suite`: any point, for name and question.
  // `record`: run.json.
  void write(const Suite& suite, const nlohmann::ordered_json& record, bool finished) const;
  // Returns the tables of scene sweeps; "" without sweeps.
  std::string sweepTables() const;
  // Returns one line on where values are not finite; "" if all are finite.
  std::string nonfinite() const;
  // Returns one line on rows whose energy is far off (isFarOff()); "" if there are none.
  std::string wrongEnergies() const;
  // Returns the blocks of the report: sweeps first, then scenes, as parts of their sweep.
  std::vector<nlohmann::ordered_json> documents() const;
  // Writes report.html and plots/*.svg, unless there is no block. `record`: run.json.
  void writePages(const Suite& suite, const nlohmann::ordered_json& record) const;

 private:
  struct Block {
    const Suite* suite;
    BlockResult result;
    std::vector<MethodSummary> rows;  // point into `result`
    double referenceMean;             // over pixels and channels
  };
  std::vector<SweptBlock> sweptBlocks() const;
  std::vector<SceneSweep> sweeps() const;

  std::filesystem::path out_;
  std::deque<Block> blocks_;                       // addresses must stay
  std::vector<nlohmann::ordered_json> documents_;  // of the blocks
  std::vector<std::string> notes_;
  std::vector<DeviceUse> devices_;
};

}  // namespace restlab
