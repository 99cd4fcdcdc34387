// Converts a run of a method to lines of results.jsonl, and back.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/runner/run/experiment.h"

namespace restlab {

// Version of the lines of results.jsonl; raised if a field changes its meaning.
constexpr int kResultsSchema = 3;

// Returns one line per age of a finished run, one per number of accumulated frames, and a last one
// of kind "run" with everything else. `job`: key of the job.
std::vector<nlohmann::ordered_json> runLines(const Suite& suite, const BlockResult& block,
                                             const MethodResult& method, const RunResult& run,
                                             const std::string& job, const std::string& startedUtc);

// Returns the line of kind "image" for an image of another program.
nlohmann::ordered_json imageLine(const Suite& suite, const BlockResult& block, const RunResult& run,
                                 const std::string& file, const std::string& job,
                                 const std::string& startedUtc);

// Restores a run from its lines, all of one method. `method` receives what is constant over runs.
// Throws std::exception if something is missing.
RunResult runOfLines(const std::vector<nlohmann::ordered_json>& lines, MethodResult& method);

}  // namespace restlab
