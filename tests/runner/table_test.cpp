// Tables of rows with known numbers: headings, columns and notes.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "experiments/runner/tables/report.h"
#include "experiments/runner/tables/report_document.h"
#include "tests/runner/summary_fixture.h"

namespace restlab {

namespace {

using TableTest = SummaryTest;

// Every table and file names the method that ratios are relative to.
TEST_F(TableTest, TheBaselineIsNamed) {
  suite_.baseline = "gi";
  const auto rows = summarise(suite_, block_);
  const std::string table = blockTable(suite_, rows);
  EXPECT_NE(table.find("| time per frame (x times that of gi) | MSE | than gi | energy |"),
            std::string::npos)
      << table;
  EXPECT_NE(table.find("| method | efficiency (against gi) |"), std::string::npos) << table;
  EXPECT_NE(table.find("| method | MSE without lights in view (than gi) | relMSE without the worst "
                       "0.1 % (than gi) |"),
            std::string::npos)
      << table;
  EXPECT_NE(blockTex(suite_, rows).find("time and lower against gi; "), std::string::npos);
  EXPECT_NE(summaryCsv(rows).find("baseline"), std::string::npos);
  const std::string document = blockDocument(suite_, rows, 1.0f).dump();
  EXPECT_NE(document.find("MSE of gi / MSE"), std::string::npos) << document;
  EXPECT_EQ(document.find("MSE of path"), std::string::npos) << document;
  EXPECT_NE(document.find("efficiency against gi"), std::string::npos) << document;
}

// Means over unlike machines are of no machine; within a run methods took turns on one.
TEST_F(TableTest, UnlikeMachinesLeaveRatiosOfTimesAlone) {
  for (MethodResult& method : block_.methods)
    for (RunResult& run : method.runs) run.machine = "one";
  compareMachines(block_);
  const auto alike = summarise(suite_, block_);
  EXPECT_EQ(alike[1].timeMsMedian, 24.2);
  for (MethodResult& method : block_.methods) method.runs[2].machine = "other";
  block_.methods[1].runs[0].accumulated = {{1, 2.5, {}}};
  compareMachines(block_);
  EXPECT_TRUE(std::isnan(block_.methods[1].runs[0].accumulated[0].timeMs));
  block_.methods[1].runs[0].accumulated.clear();
  const auto rows = summarise(suite_, block_);
  EXPECT_TRUE(std::isnan(rows[1].timeMsMedian));
  EXPECT_EQ(rows[1].timeRatio.value, alike[1].timeRatio.value);
  EXPECT_TRUE(rows[1].passes.empty());
  const std::string table = blockTable(suite_, rows);
  EXPECT_NE(table.find("unlike machines (one; other)"), std::string::npos) << table;
  EXPECT_NE(table.find("| 1.10x [1.10, 1.10] |"), std::string::npos) << table;
  EXPECT_EQ(table.find(" ms"), std::string::npos) << table;
}

// A ratio whose interval reaches 0 is called unbounded in every output.
TEST_F(TableTest, RatiosThatReachZeroAreUnbounded) {
  for (MethodResult& method : block_.methods) method.runs.resize(2);
  block_.methods[1].runs[0].measured.mse = 0.02;
  block_.methods[1].runs[1].measured.mse = 0.16;
  const auto rows = summarise(suite_, block_);
  const Interval& ratio = rows[1].mseRatio;
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_GT(ratio.value, 0.0);
  EXPECT_TRUE(ratio.lo > 0.0 || ratio.lo == -infinity) << ratio.lo;
  EXPECT_LT(rows[1].mse.lo, 0.0) << "two runs say little";
  for (const std::string& text : {blockTable(suite_, rows), blockTex(suite_, rows)}) {
    EXPECT_NE(text.find("[unbounded"), std::string::npos) << text;
    EXPECT_EQ(text.find("x lower [0, "), std::string::npos) << text;
    EXPECT_EQ(text.find("0.0900 [-"), std::string::npos) << text;
  }
}

// Text files contain no control characters that could command a terminal.
TEST_F(TableTest, NamesCommandNoTerminal) {
  suite_.methods[1].name = "g\x1b[31mi\x07\xc2\x9bm\nx";
  const auto rows = summarise(suite_, block_);
  for (const std::string& text : {blockTex(suite_, rows), summaryCsv(rows)}) {
    EXPECT_EQ(text.find_first_of("\x1b\x07\x9b"), std::string::npos) << text;
    EXPECT_NE(text.find("g [31mi  m x"), std::string::npos) << text;
  }
}

// Scene names in any script give distinct ASCII ids.
TEST_F(TableTest, IdsOfBlocksArePlainAndDiffer) {
  std::set<std::string> ids;
  for (const char* scene : {"Zimmer \u00fc", "Zimmer \u00f6", "Zimmer _", "\u65e5\u672c"}) {
    block_.scene = scene;
    const auto document = blockDocument(suite_, summarise(suite_, block_), 1.0f);
    const std::string id = document.at("id");
    EXPECT_EQ(id.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
                                   "0123456789._-"),
              std::string::npos)
        << id;
    EXPECT_TRUE(ids.insert(id).second) << id;
  }
}

// The report opens on the lowest error among rows that are to be trusted.
TEST_F(TableTest, TheReportOpensOnTheBest) {
  const auto opensOn = [&] {
    const auto document = blockDocument(suite_, summarise(suite_, block_), 1.0f);
    return document.value("opens_on", std::string());
  };
  EXPECT_EQ(opensOn(), "gi");
  for (RunResult& run : block_.methods[1].runs) run.measured.energyRatio = 0.9;
  EXPECT_EQ(opensOn(), "path") << "gi does not count";
  const auto warned = blockDocument(suite_, summarise(suite_, block_), 1.0f);
  EXPECT_EQ(warned["rows"][1]["warnings"].size(), 1u) << warned["rows"][1].dump();
  EXPECT_TRUE(warned["rows"][1]["flags"].empty()) << "said once";
  for (size_t run = 0; run < 3; ++run) {
    block_.methods[1].runs[run].measured.energyRatio = 1.0;
    block_.methods[1].runs[run].measured.mse = block_.methods[0].runs[run].measured.mse = 1.0;
  }
  EXPECT_EQ(opensOn(), "path") << "the first of equal ones";
  for (MethodResult& method : block_.methods)
    for (RunResult& run : method.runs) run.measured.nonfinite = 1;
  EXPECT_EQ(opensOn(), "") << "none is to be trusted";
}

// Columns without times or comparisons are left out.
TEST_F(TableTest, EmptyColumnsAreLeftOut) {
  for (MethodResult& method : block_.methods)
    for (RunResult& run : method.runs) run.timesMs.clear();
  suite_.methods[0].session = suite_.methods[1].session;
  const std::string table = blockTable(suite_, summarise(suite_, block_));
  EXPECT_NE(table.find("| method | MSE | energy |\n|---|---|---|\n"), std::string::npos) << table;
  EXPECT_EQ(table.find("efficiency"), std::string::npos) << table;
  EXPECT_EQ(table.find("|  |"), std::string::npos) << table;
}

// Three rows with the same note share one line.
TEST_F(TableTest, NotesOfManyRowsAreOneLine) {
  for (int i = 0; i < 3; ++i) {
    suite_.methods.push_back(suite_.methods[1]);
    suite_.methods.back().name = "gi " + std::string(1, char('a' + i));
    block_.methods.push_back(block_.methods[1]);
    for (RunResult& run : block_.methods.back().runs)
      run.measured.energyRatio = 0.9 + 0.001 * double(i);
  }
  for (RunResult& run : block_.methods[1].runs) run.measured.energyRatio = 0.93;
  const std::string table = blockTable(suite_, summarise(suite_, block_));
  EXPECT_NE(table.find("- gi (*): does not count: energy ratio 0.93 [0.93, 0.93] is outside "
                       "0.95..1.05; likewise, by numbers of their own (flags in summary.csv): "
                       "gi a (*); gi b (*); gi c (*)\n"),
            std::string::npos)
      << table;
  const size_t first = table.find("does not count: energy");
  EXPECT_EQ(table.find("does not count: energy", first + 1), std::string::npos) << table;
}

// The same frame of other runs reveals a disturbed machine; frames that differ within a run do not.
TEST_F(TableTest, ADisturbedMachineIsSaid) {
  const auto timed = [&](double slowest) {
    for (size_t m = 0; m < 2; ++m) {
      for (size_t r = 0; r < 3; ++r)
        block_.methods[m].runs[r].timesMs = {10.0, 30.0 * (m == 1 && r == 2 ? slowest : 1.0)};
    }
    return blockTable(suite_, summarise(suite_, block_));
  };
  EXPECT_EQ(timed(1.1).find("disturbed"), std::string::npos);
  const std::string table = timed(1.8);
  EXPECT_NE(table.find("- the machine was disturbed: one frame in twenty took up to 1.80 times as "
                       "long as the same frame of other runs, in gi;"),
            std::string::npos)
      << table;
}

TEST_F(TableTest, TableSaysWhatDoesNotCount) {
  for (RunResult& run : block_.methods[1].runs) run.measured.energyRatio = 0.9;
  const std::string table = blockTable(suite_, summarise(suite_, block_));
  EXPECT_NE(table.find("| gi (*) |"), std::string::npos) << table;
  EXPECT_NE(table.find("energy ratio 0.9 [0.9, 0.9] is outside 0.95..1.05"), std::string::npos)
      << table;
  EXPECT_NE(table.find("10x lower [5.68, 17.6]"), std::string::npos) << table;
}

}  // namespace

}  // namespace restlab
