// The list of columns: every writer takes its columns from it.
#include "experiments/runner/tables/columns.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <sstream>

#include "experiments/runner/tables/report.h"
#include "experiments/runner/tables/report_document.h"
#include "tests/runner/summary_fixture.h"

namespace restlab {

namespace {

using ColumnsTest = SummaryTest;

std::set<std::string> headingOf(const std::string& csv) {
  std::set<std::string> names;
  std::istringstream line(csv.substr(0, csv.find('\n')));
  for (std::string name; std::getline(line, name, ',');)
    EXPECT_TRUE(names.insert(name).second) << name << " stands there twice";
  return names;
}

TEST_F(ColumnsTest, AllStandInTheCsvOnce) {
  const auto rows = summarise(suite_, block_);
  const std::set<std::string> names = headingOf(summaryCsv(rows));
  size_t wanted = 0;
  for (const Column& column : columnsOf(rows)) {
    if (!column.inCsv) continue;
    EXPECT_EQ(names.count(column.key), 1u) << column.key;
    for (const char* end : {"_ci_lo", "_ci_hi"})
      EXPECT_EQ(names.count(column.key + end), column.ends == Ends::all ? 1u : 0u) << column.key;
    wanted += column.ends == Ends::all ? 3 : 1;
  }
  EXPECT_EQ(names.size(), wanted) << "the file has a column that is not of the list";
}

TEST_F(ColumnsTest, WithATitleStandInTheReportWhereTheyAreKnown) {
  const auto rows = summarise(suite_, block_);
  const auto document = blockDocument(suite_, rows, 1.0f);
  std::map<std::string, std::string> titles;
  for (const auto& column : document.at("columns")) titles[column.at("key")] = column.at("title");
  size_t wanted = 0;
  for (const Column& column : columnsOf(rows)) {
    if (column.title.empty() || !isKnown(column, rows)) continue;
    const std::string key = column.reportKey.empty() ? column.key : column.reportKey;
    EXPECT_EQ(titles[key], column.title);
    ++wanted;
  }
  EXPECT_EQ(titles.size(), wanted) << "the report has a column that is not of the list";
}

TEST_F(ColumnsTest, TitlesNameTheBaselineOrLeaveItOut) {
  suite_.baseline = "gi";
  EXPECT_EQ(columnAt(columnsOf(summarise(suite_, block_)), "mse_ratio").narrow, "than gi");
  suite_.baseline.clear();
  for (SuiteMethod& method : suite_.methods) method.session.integrator = "restir_gi";
  const Columns columns = columnsOf(summarise(suite_, block_));
  EXPECT_EQ(columnAt(columns, "mse_ratio").narrow, "than");
  EXPECT_EQ(columnAt(columns, "time_ms_median").narrow, "time per frame");
  EXPECT_EQ(columnAt(columns, "efficiency_ratio").narrow, "efficiency");
  EXPECT_THROW(columnAt(columns, "no column"), std::out_of_range);
}

}  // namespace

}  // namespace restlab
