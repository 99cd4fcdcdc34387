// Sweeps over numbers: the plots of the MSE over the value.
#include "experiments/runner/tables/parameter_sweep.h"

#include <set>

#include "core/frame/method_settings.h"
#include "core/frame/schema.h"
#include "experiments/report/report_model.h"
#include "experiments/runner/suite/suite_settings.h"
#include "experiments/runner/suite/sweep.h"
#include "experiments/runner/tables/report_document.h"
#include "experiments/runner/tables/swept_axis.h"
#include "tests/runner/summary_fixture.h"

namespace restlab {

namespace {

class ParameterSweepTest : public SummaryTest {
 protected:
  // Replaces `gi` by a copy for each list of values, the MSE of which is a tenth of its number.
  void sweep(const std::vector<std::vector<SweptValue>>& lists) {
    const SuiteMethod gi = suite_.methods[1];
    const MethodResult result = block_.methods[1];
    suite_.methods.resize(1);
    block_.methods.resize(1);
    for (const std::vector<SweptValue>& values : lists) {
      SuiteMethod& method = suite_.methods.emplace_back(gi);
      method.given = "gi";
      method.swept = values;
      method.name = method.base = "gi, " + sweepLabel(values);
      MethodResult& measured = block_.methods.emplace_back(result);
      for (RunResult& run : measured.runs)
        run.measured.mse = 0.1 * double(suite_.methods.size() - 1);
    }
  }
  nlohmann::ordered_json plots() { return methodSweepPlots(summarise(suite_, block_)); }
};

TEST_F(ParameterSweepTest, ALineForEachMethodAndOtherValue) {
  sweep({{{"spatial_radius", "64.0"}, {"mode", "biased"}},
         {{"spatial_radius", "64.0"}, {"mode", "unbiased"}},
         {{"spatial_radius", "2.0"}, {"mode", "biased"}},
         {{"spatial_radius", "2.0"}, {"mode", "unbiased"}}});
  const auto all = plots();
  ASSERT_EQ(all.size(), 1u) << "modes are no numbers: " << all.dump();
  const auto& plot = all[0];
  EXPECT_EQ(plot["x"]["title"], "spatial_radius, pixels");
  EXPECT_EQ(plot["x"]["log"], true) << "from 2 to 64";
  EXPECT_EQ(plot["intervals"], "bars");
  ASSERT_EQ(plot["series"].size(), 2u) << "path has no such parameter";
  EXPECT_EQ(plot["series"][0]["name"], "gi, mode=biased");
  EXPECT_EQ(plot["series"][1]["name"], "gi, mode=unbiased");
  const auto& points = plot["series"][0]["points"];
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0][0], 2.0) << "in order of the value";
  EXPECT_NEAR(points[0][1].get<double>(), 0.3, 1e-12);
  EXPECT_EQ(points[1][0], 64.0);
  EXPECT_NEAR(points[1][1].get<double>(), 0.1, 1e-12);
  EXPECT_LE(points[0][2], points[0][1]);
  EXPECT_GE(points[0][3], points[0][1]);
}

TEST_F(ParameterSweepTest, BackendsHaveLinesOfTheirOwn) {
  sweep({{{"confidence_cap", "4"}},
         {{"confidence_cap", "8"}},
         {{"confidence_cap", "4"}},
         {{"confidence_cap", "8"}}});
  for (size_t m = 1; m < 5; ++m) {
    SuiteMethod& method = suite_.methods[m];
    method.session.backend = m < 3 ? "cpu" : "vulkan";
    method.name = method.base + " @" + method.session.backend;
  }
  const auto plot = plots().at(0);
  ASSERT_EQ(plot["series"].size(), 2u);
  EXPECT_EQ(plot["series"][1]["name"], "gi @vulkan");
  EXPECT_EQ(plot["x"]["log"], false) << "from 4 to 8";
}

TEST_F(ParameterSweepTest, NothingToPlotIsNoPlot) {
  EXPECT_EQ(plots().size(), 0u) << "without a sweep";
  sweep({{{"filter", "box"}}, {{"filter", "center"}}});
  EXPECT_EQ(plots().size(), 0u) << "of names";
  sweep({{{"seed", "1"}}, {{"seed", "100"}}});
  EXPECT_EQ(plots().size(), 0u) << "of seeds";
  sweep({{{"confidence_cap", "4"}}});
  EXPECT_EQ(plots().size(), 0u) << "of a single value";
}

// A scene at several points: one block over all of them.
TEST_F(ParameterSweepTest, SettingsMakeABlockOfEachScene) {
  std::vector<Suite> suites;
  std::vector<std::vector<MethodSummary>> rows;
  for (const char* bounces : {"1", "40"}) {
    for (const char* filter : {"box", "center"}) {
      Suite& suite = suites.emplace_back(suite_);
      suite.swept = {{"max_bounces", bounces}, {"filter", filter}};
      suite.point = sweepLabel(suite.swept);
    }
  }
  for (const Suite& suite : suites) rows.push_back(summarise(suite, block_));
  std::vector<SweptBlock> blocks;
  for (size_t i = 0; i < suites.size(); ++i) blocks.push_back({&suites[i], &rows[i], 1.0});
  const std::vector<SettingSweep> sweeps = settingSweeps(blocks);
  ASSERT_EQ(sweeps.size(), 1u);
  EXPECT_EQ(sweeps[0].blocks, (std::vector<size_t>{0, 1, 2, 3}));
  const auto& document = sweeps[0].document;
  EXPECT_NO_THROW(
      checkReportModel({{"schema", kReportSchema}, {"title", ""}, {"blocks", {document}}}));
  EXPECT_EQ(document["title"], "max_bounces of scene, all light");
  EXPECT_EQ(document["subtitle"], "Values of max_bounces: 1, 40. Values of filter: box, center.");
  ASSERT_EQ(document["plots"].size(), 1u);
  const auto& series = document["plots"][0]["series"];
  ASSERT_EQ(series.size(), 4u);
  EXPECT_EQ(series[0]["name"], "path, filter=box");
  EXPECT_EQ(series[0]["points"].size(), 2u);
  EXPECT_EQ(document["plots"][0]["x"]["log"], true);
  blocks.resize(2);
  EXPECT_TRUE(settingSweeps(blocks).empty()) << "a single number";
}

TEST_F(ParameterSweepTest, TheReportHasThePlot) {
  sweep({{{"confidence_cap", "4"}}, {{"confidence_cap", "8"}}});
  const auto document = blockDocument(suite_, summarise(suite_, block_), 1.0f);
  EXPECT_EQ(document.at("plots").at(0).at("id"), "swept-confidence_cap");
}

TEST(SweptAxis, IsLogarithmicWhereValuesAreFarApart) {
  EXPECT_FALSE(sweptAxis({1.0, 20.0}, 20.0).isLog);
  EXPECT_TRUE(sweptAxis({21.0, 1.0}, 20.0).isLog);
  EXPECT_FALSE(sweptAxis({-1.0, 2000.0}, 20.0).isLog);
  EXPECT_FALSE(sweptAxis({0.0, 1.0, 999.0}, 20.0).isLog);
  const SweptAxis zero = sweptAxis({0.0, 1.0, 1000.0}, 20.0);
  EXPECT_TRUE(zero.isLog);
  EXPECT_EQ(zero.at(0.0), 0.1);
  EXPECT_EQ(zero.note, "0 is drawn at 0.1");
}

TEST(SweptValue, IsANumberOrNot) {
  EXPECT_EQ(numberOf({"a", "1_000"}), 1000.0);
  EXPECT_EQ(numberOf({"a", "-2.5e-1"}), -0.25);
  for (const char* text : {"", "box", "inf", "nan", "320x180", "true", "1,2"})
    EXPECT_FALSE(numberOf({"a", text}).has_value()) << text;
}

// The list of units is kept by hand: its names must be those of parameters or settings.
TEST(SweptValue, UnitsAreOfKeysThatExist) {
  std::set<std::string> known;
  for (const std::string& key : settingsKeys()) known.insert(key);
  for (const IntegratorInfo* info : integratorRegistry())
    for (const ParameterInfo& parameter : parametersOf(*info)) known.insert(parameter.name);
  for (const CacheInfo* info : cacheRegistry())
    for (const ParameterInfo& parameter : parametersOf(*info)) known.insert(parameter.name);
  for (const DenoiserInfo* info : denoiserRegistry())
    for (const ParameterInfo& parameter : parametersOf(*info)) known.insert(parameter.name);
  for (const std::string& key : keysWithUnits()) EXPECT_EQ(known.count(key), 1u) << key;
}

}  // namespace

}  // namespace restlab
