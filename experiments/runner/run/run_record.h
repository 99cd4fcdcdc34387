// A run of a method as lines of results.jsonl, and back.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/runner/run/experiment.h"

namespace restlab {

// Version of the lines of results.jsonl; raised when a field changes its meaning.
constexpr int kResultsSchema = 3;

// JSON has no NaN and no infinity: they become the strings "nan", "inf", "-inf".
nlohmann::ordered_json finiteJson(double value);
double finiteNumber(const nlohmann::ordered_json& value);

// One line for each age of a finished run, one for each number of accumulated frames, and
// the last one, of kind "run", with all else. `job`: the key of the job that made it.
std::vector<nlohmann::ordered_json> runLines(const Suite& suite, const BlockResult& block,
                                             const MethodResult& method, const RunResult& run,
                                             const std::string& job, const std::string& startedUtc);

// An image of another program as a line of kind "image".
nlohmann::ordered_json imageLine(const Suite& suite, const BlockResult& block, const RunResult& run,
                                 const std::string& file, const std::string& job,
                                 const std::string& startedUtc);

// The run that these lines, of one run of one method, were made of; `method` also takes what is the
// same in all of its runs. Throws std::exception where something is missing.
RunResult runOfLines(const std::vector<nlohmann::ordered_json>& lines, MethodResult& method);

}  // namespace restlab
