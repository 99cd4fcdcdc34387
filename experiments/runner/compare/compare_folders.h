// Compares two folders of results, table by table and method by method: is the new version better?
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/runner/compare/folder_differences.h"
#include "experiments/statistics/intervals.h"

namespace restlab {

enum class Verdict { same, better, worse, notToldApart, notJudged, notKnown };

// Judges the interval of the ratio after / before of a quantity of which less is better. Returns
// better or worse if the interval is bounded, lies above 0 and leaves out 1.
Verdict verdictOf(const Interval& afterOverBefore);

struct ComparedRow {
  std::string table, method;
  Interval before, after;  // MSE
  // after / before: below 1 is better. MSE: runs are paired if the seeds of one folder are among
  // those of the other. Time: each folder's times are divided by its own baseline if both have the
  // same one, because clock speeds differ from hour to hour.
  Interval mseRatio, timeRatio;
  std::string timesOver;    // name of that baseline; "": times are not divided
  std::string whyNoTime;    // why a known time gets no verdict; "": it gets one
  std::string runsOfRatio;  // which runs the MSE's ratio is of, if not all in pairs
  Verdict error = Verdict::notKnown, time = Verdict::notKnown;
  // Differing settings that define what is measured, "max_bounces 8 / 2". The verdicts then say
  // that unlike things are compared.
  std::vector<std::string> unlike;

  bool isWorse() const { return error == Verdict::worse || time == Verdict::worse; }
  std::string verdictText(Verdict verdict) const;  // "better", "unlike things: better"
};

struct FolderComparison {
  FolderOrigin before, after;
  std::vector<ComparedRow> rows;
  std::vector<std::string> notes;  // what only one folder has, and all differences
  std::string loads;               // machine load that may be in the times; else ""
  bool isOneProgram = false;       // same sources, compiler, machine and devices
};

// Throws Error (badInput) if a folder was not written by `run`, or if the two have no method of a
// table in common.
FolderComparison compareFolders(const std::filesystem::path& before,
                                const std::filesystem::path& after);

// Returns a markdown table, with the origins of both folders above and the notes below.
std::string comparisonTable(const FolderComparison& comparison);
nlohmann::ordered_json comparisonJson(const FolderComparison& comparison);

}  // namespace restlab
