// Is this version better? Two folders of results, table by table, method by method.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/runner/compare/folder_differences.h"

namespace restlab {

enum class Verdict { same, better, worse, notToldApart, notJudged, notKnown };

// Of after / before of something of which less is better: better or worse where the interval is
// bounded, does not reach 0 and leaves out 1.
Verdict verdictOf(const Interval& afterOverBefore);

struct ComparedRow {
  std::string table, method;
  Interval before, after;  // MSE
  // after / before: below 1 is better. Of the MSE, runs paired where the seeds of one folder are
  // among those of the other; of the time, each over that of the baseline in its own folder where
  // both have the same one, as the clocks of two hours differ.
  Interval mseRatio, timeRatio;
  std::string timesOver;    // the name of that baseline; "": times as they are
  std::string whyNoTime;    // why the time gets no verdict though it is known; "": it gets one
  std::string runsOfRatio;  // where the MSE's ratio is not of all runs in pairs: of which, and how
  Verdict error = Verdict::notKnown, time = Verdict::notKnown;
  // Settings that define what is measured and differ, "max_bounces 8 / 2": then unlike things are
  // compared, and the verdicts say so.
  std::vector<std::string> unlike;

  bool isWorse() const { return error == Verdict::worse || time == Verdict::worse; }
  std::string verdictText(Verdict verdict) const;  // "better", "unlike things: better"
};

struct FolderComparison {
  FolderOrigin before, after;
  std::vector<ComparedRow> rows;
  std::vector<std::string> notes;  // what is in one folder only, and all that differs
  std::string loads;               // what else the machine did, where times may hold it; else ""
  bool isOneProgram = false;       // made by the same sources, compiler, machine and devices
};

// Throws Error (badInput) where a folder is none that `run` left, or the two have no method of a
// table in common.
FolderComparison compareFolders(const std::filesystem::path& before,
                                const std::filesystem::path& after);

// As a table in markdown, with who made what above and the notes below.
std::string comparisonTable(const FolderComparison& comparison);
nlohmann::ordered_json comparisonJson(const FolderComparison& comparison);

}  // namespace restlab
