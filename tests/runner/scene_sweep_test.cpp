// Sweeps of a scene's parameter: which scenes form one, and up to which value a method holds.
#include "experiments/runner/tables/scene_sweep.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/base/error.h"
#include "experiments/report/report_model.h"
#include "experiments/runner/results/outputs.h"
#include "tests/runner/temporary_folder.h"

namespace restlab {

namespace {

std::string errorOf(const std::vector<std::string>& names) {
  try {
    sweptParameter(names);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(SweptParameter, IsTheOneThatDiffers) {
  const SweptParameter swept =
      sweptParameter({"furnace?scale=2&albedo=0.5", "furnace?albedo=9e-1&scale=2"});
  EXPECT_EQ(swept.name, "albedo");
  EXPECT_EQ(swept.scene, "furnace?scale=2");
  EXPECT_EQ(swept.values, (std::vector<double>{0.5, 0.9}));
  EXPECT_EQ(swept.texts, (std::vector<std::string>{"0.5", "9e-1"}));
  EXPECT_EQ(sweptParameter({"furnace", "furnace?albedo=0.9"}).texts.front(), "0.5")
      << "the default is a value";
}

TEST(SweptParameter, OthersAreErrors) {
  const auto expectError = [](const std::vector<std::string>& names, const std::string& words) {
    EXPECT_NE(errorOf(names).find(words), std::string::npos) << errorOf(names);
  };
  expectError({"furnace?albedo=0.5", "quad-light?edge=1"}, "is not of furnace");
  expectError({"furnace?albedo=0.5", "a.gltf"}, "'a.gltf' is none");
  expectError({"furnace?albedo=0.4&scale=2", "furnace?albedo=0.9"}, "'albedo' and 'scale'");
  expectError({"furnace", "furnace?albedo=0.5"}, "all the same");
  expectError({"furnace?scale=2", "furnace?scale=4", "furnace?scale=2^1"}, "a value twice");
  expectError({"furnace", "furnace?fov=90"}, "does not say it");
}

TEST(Holds, WhereTheIntervalTouches) {
  const double nan = kUnknown;
  EXPECT_EQ(holds({1.0, 0.99, 1.01}, 0, 0.01), Holding::yes);
  EXPECT_EQ(holds({0.97, 0.955, 0.991}, 0, 0.01), Holding::yes);
  EXPECT_EQ(holds({0.97, 0.95, 0.985}, 0, 0.01), Holding::no);
  EXPECT_EQ(holds({1.03, 1.009, 1.049}, 0, 0.01), Holding::yes);
  EXPECT_EQ(holds({1.03, 1.02, 1.05}, 0, 0.01), Holding::no);
  EXPECT_EQ(holds({1.0, 0.99, 1.01}, 1, 0.01), Holding::no) << "a value that is not finite";
  EXPECT_EQ(holds({nan, nan, nan}, 0, 1.0), Holding::no);
  EXPECT_EQ(holds({1.0, nan, nan}, 0, 0.01), Holding::notDecided) << "one run";
}

// A noisy result must not hold just because its interval is wide.
TEST(Holds, IsNotDecidedByAWideInterval) {
  EXPECT_EQ(holds({1.0, 0.951, 1.049}, 0, 0.01), Holding::yes);
  EXPECT_EQ(holds({1.0, 0.949, 1.051}, 0, 0.01), Holding::notDecided);
  EXPECT_EQ(holds({0.6, 0.1, 1.1}, 0, 0.01), Holding::notDecided);
  EXPECT_EQ(holds({1.058, 1.009, 1.107}, 0, 0.01), Holding::notDecided);
  EXPECT_EQ(holds({0.6, 0.3, 0.9}, 0, 0.01), Holding::no);
}

TEST(IsFarOff, BeyondTheToleranceAndThreeHalfWidths) {
  EXPECT_FALSE(isFarOff({1.0, 1.0, 1.0}, 0.01));
  EXPECT_FALSE(isFarOff({0.97, 0.96, 0.98}, 0.01)) << "does not hold, and may be chance";
  EXPECT_FALSE(isFarOff({0.961, 0.951, 0.971}, 0.01));
  EXPECT_TRUE(isFarOff({0.959, 0.949, 0.969}, 0.01));
  EXPECT_TRUE(isFarOff({1.041, 1.031, 1.051}, 0.01));
  EXPECT_FALSE(isFarOff({0.5, kUnknown, kUnknown}, 0.01)) << "one run";
}

// A suite with a sweep of three scenes and two methods. Tests let the second method lose energy or
// have values that are not finite.
class SceneSweepTest : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    const std::filesystem::path file = folder() / "suite.toml";
    std::ofstream(file) << "[[scene]]\nname = \"light\"\ntruth = \"exact\"\nmax_bounces = 3\n"
                           "scene = [\"furnace?albedo=0.5\", \"furnace?albedo=0.75\", "
                           "\"furnace?albedo=0.9\"]\n"
                           "[[scene]]\nscene = \"cornell-box\"\n"
                           "[[method]]\nname = \"path\"\n"
                           "[[method]]\nname = \"gi\"\nintegrator = \"restir_gi\"\n";
    suite_ = loadSuite(file, {});
  }
  // Makes the results of both methods on one scene.
  BlockResult block(size_t scene, double energyOfGi, uint64_t nonfinite) const {
    BlockResult block;
    block.scene = suite_.scenes.at(scene).name;
    block.width = block.height = 2;
    block.reference.mean = Image(2, 2, glm::vec3(2.0f));
    block.reference.half0 = block.reference.half1 = block.reference.mean;
    block.methods.resize(2);
    for (size_t m = 0; m < 2; ++m) {
      for (uint32_t r = 0; r < 4; ++r) {
        RunResult run;
        run.method = m;
        run.run = r;
        run.measured.mse = 0.25;
        run.measured.energyRatio = (m == 0 ? 1.0 : energyOfGi) + (r % 2 == 0 ? 1e-3 : -1e-3);
        run.measured.nonfinite = m == 1 && r == 0 ? nonfinite : 0;
        block.methods[m].runs.push_back(run);
        block.methods[m].measured.add(Image(2, 2, glm::vec3(2.0f)));
      }
      block.methods[m].shown = Image(2, 2, glm::vec3(2.0f));
    }
    return block;
  }
  // Adds a block for each scene of the sweep.
  struct OfGi {
    double energy;
    uint64_t nonfinite;
  };
  void add(Outputs& outputs, const Suite& own, const std::vector<OfGi>& values) const {
    for (size_t scene = 0; scene < values.size(); ++scene)
      outputs.add(own, block(scene, values[scene].energy, values[scene].nonfinite));
  }
  Suite suite_;

  // Rows of all scenes of the sweep in which both methods are right; tests change some.
  struct Right {
    explicit Right(const SceneSweepTest& test) : own(ofScene(test.suite_, test.suite_.scenes[0])) {
      for (size_t i = 0; i < 3; ++i) results.push_back(test.block(i, 1.0, 0));
      for (const BlockResult& result : results) rows.push_back(summarise(own, result));
    }
    std::vector<SweptBlock> blocks() const {
      std::vector<SweptBlock> all;
      for (const auto& row : rows) all.push_back({&own, &row, 2.0});
      return all;
    }
    Suite own;
    std::vector<BlockResult> results;
    std::vector<std::vector<MethodSummary>> rows;
  };
};

TEST_F(SceneSweepTest, ScenesOfATableAreOneSweep) {
  ASSERT_EQ(suite_.scenes.size(), 4u);
  EXPECT_EQ(suite_.scenes[1].name, "light: furnace?albedo=0.75");
  EXPECT_EQ(suite_.scenes[1].sweep, suite_.scenes[2].sweep);
  EXPECT_NE(suite_.scenes[1].sweep, 0u);
  EXPECT_EQ(suite_.scenes[3].sweep, 0u);
  EXPECT_EQ(suite_.scenes[0].truth, Truth::exact);
  EXPECT_EQ(ofScene(suite_, suite_.scenes[0]).maxBounces, 3u);
  EXPECT_EQ(ofScene(suite_, suite_.scenes[3]).maxBounces, suite_.maxBounces);
}

TEST_F(SceneSweepTest, SaysTheLastValueThatHolds) {
  const Suite own = ofScene(suite_, suite_.scenes[0]);
  Outputs outputs(folder());
  add(outputs, own, {{1.0, 0}, {1.005, 0}, {0.9, 0}});
  const std::string table = outputs.sweepTables();
  EXPECT_NE(table.find("## light, albedo of furnace, all light, 3 scattering events"),
            std::string::npos)
      << table;
  EXPECT_NE(table.find("Values of albedo: 0.5, 0.75, 0.9.\n"), std::string::npos) << table;
  EXPECT_NE(table.find("| method | last that holds | energy | error | bias^2 / MSE, % |\n"),
            std::string::npos)
      << table;
  EXPECT_NE(table.find("| path | 0.9 | 1 [0.9982, 1.002] at 0.5 | 0.250"), std::string::npos)
      << table;
  EXPECT_NE(table.find("| gi | 0.75 | 0.9000 [0.8982, 0.9018] at 0.9 | 0.250"), std::string::npos)
      << table;
  EXPECT_NE(table.find("- does not hold at albedo = 0.9, energy 0.9000 [0.8982, 0.9018]: gi\n"),
            std::string::npos)
      << table;
  EXPECT_EQ(outputs.nonfinite(), "");
  outputs.write(own, {}, true);
  std::ifstream in(folder() / "table.md");
  const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  EXPECT_LT(text.find("last that holds"), text.find("## light: furnace?albedo=0.5, all light"));
}

TEST_F(SceneSweepTest, NamesTheFirstWrongEnergy) {
  const Suite own = ofScene(suite_, suite_.scenes[0]);
  Outputs outputs(folder());
  add(outputs, own, {{1.0, 0}, {1.012, 0}});
  EXPECT_EQ(outputs.wrongEnergies(), "") << "1.2 % within an interval of 0.2 % and 1 %";
  add(outputs, own, {{1.0, 0}, {1.0, 0}, {0.9, 0}});
  EXPECT_EQ(outputs.wrongEnergies(),
            "the energy of 1 row is not that of the reference; the first is gi in light: "
            "furnace?albedo=0.9, with 0.9000 [0.8982, 0.9018]");
}

// Each figure is shown at its worst value.
TEST_F(SceneSweepTest, FiguresAreOfTheWorstValue) {
  Right right(*this);
  std::vector<std::vector<MethodSummary>>& rows = right.rows;
  MethodSummary& worst = rows[1][1];
  worst.mse = {4.0, 3.24, 4.84};
  worst.biasShare = {0.02, 0.01, 0.03};
  rows[2][1].biasShare = {0.05, -0.2, 0.3};  // larger only by noise
  worst.timeMsMedian = 8.0;
  rows[0][1].timeMsMedian = 3.0;
  worst.health.health.counts[rl::RL_HEALTH_NONFINITE] = 5;
  rows[2][1].health.health.counts[rl::RL_HEALTH_NONFINITE] = 2;
  const std::vector<SweptBlock> blocks = right.blocks();
  const SceneSweep sweep = sceneSweeps(blocks).at(0);
  const std::string table = sweepTable(sweep);
  EXPECT_NE(table.find("| 1 [0.900, 1.10] at 0.75 | 2 [1, 3] at 0.75 | 8 at 0.75 |\n"),
            std::string::npos)
      << table;
  EXPECT_NE(table.find("- 7 faults of health: gi\n"), std::string::npos) << table;
  EXPECT_EQ(table.find(": path\n"), std::string::npos) << table;
  const nlohmann::ordered_json row = sweepDocument(sweep)["rows"][1];
  EXPECT_EQ(row["cells"]["error"]["note"], "at 0.75");
  EXPECT_EQ(row["cells"]["time"]["value"], 8.0);
  EXPECT_EQ(row["cells"]["faults"]["value"], 7);
  EXPECT_EQ(sweepDocument(sweep)["plots"].size(), 3u);
}

// 0 also has a place on a logarithmic axis.
TEST_F(SceneSweepTest, ZeroStandsLeftOfAll) {
  SceneSweep sweep;
  sweep.suite = &suite_;
  sweep.methods = {"path"};
  const auto plotOver = [&](const std::vector<double>& values) {
    sweep.parameter = {"gap", "furnace", values, std::vector<std::string>(values.size(), "x")};
    SweptCell cell;
    cell.energy = cell.error = {1.0, 1.0, 1.0};
    sweep.cells = {std::vector<SweptCell>(values.size(), cell)};
    sweep.blocks.assign(values.size(), 0);
    return sweepDocument(sweep)["plots"][0];
  };
  const auto far = plotOver({0.8, 1e-5, 0.0});
  EXPECT_TRUE(far["x"]["log"].get<bool>());
  EXPECT_EQ(far["x"]["note"], "0 is drawn at 1e-06");
  EXPECT_DOUBLE_EQ(far["series"][0]["points"][0][0].get<double>(), 1e-6);
  const auto near = plotOver({0.0, 45.0, 89.0});
  EXPECT_FALSE(near["x"]["log"].get<bool>());
  EXPECT_EQ(near["series"][0]["points"][0][0], 0.0);
}

// A value that is too noisy to decide is not the last that holds, and does not end the count.
TEST_F(SceneSweepTest, AWideIntervalIsNotDecided) {
  Right right(*this);
  std::vector<std::vector<MethodSummary>>& rows = right.rows;
  rows[1][0].energyRatio = rows[2][1].energyRatio = {0.9, 0.7, 1.1};
  const std::vector<SweptBlock> blocks = right.blocks();
  const SceneSweep sweep = sceneSweeps(blocks).at(0);
  EXPECT_EQ(sweep.lastThatHolds(0), 2u);
  // Noise at all values is no failure at the first.
  for (auto& row : rows) row[0].energyRatio = {0.9, 0.7, 1.1};
  EXPECT_NE(sweepTable(sceneSweeps(blocks).at(0)).find("| path | not decided | "),
            std::string::npos);
  EXPECT_EQ(sweep.lastThatHolds(1), 1u);
  const std::string table = sweepTable(sweep);
  EXPECT_NE(table.find("- is not decided at albedo = 0.75, energy 0.9000 [0.7000, 1.100]: path\n"),
            std::string::npos)
      << table;
}

// The report lists scenes under their sweep.
TEST_F(SceneSweepTest, ScenesArePartsOfTheSweep) {
  const Suite own = ofScene(suite_, suite_.scenes[0]);
  Outputs outputs(folder());
  add(outputs, own, {{1.0, 0}, {1.0, 0}, {1.0, 0}});
  outputs.add(suite_, block(3, 1.0, 0));
  const std::vector<nlohmann::ordered_json> documents = outputs.documents();
  ASSERT_EQ(documents.size(), 5u);
  for (size_t i = 1; i < 4; ++i)
    EXPECT_EQ(documents[i].value("part_of", ""), documents[0].value("id", "none"));
  EXPECT_FALSE(documents[4].contains("part_of"));
  checkReportModel({{"schema", kReportSchema}, {"title", "x"}, {"blocks", documents}});
}

// The count ends at the first failure, even if a later value holds.
TEST_F(SceneSweepTest, EndsAtTheFirstThatDoesNot) {
  const Suite own = ofScene(suite_, suite_.scenes[0]);
  Outputs outputs(folder());
  add(outputs, own, {{1.0, 0}, {1.0, 7}, {1.0, 0}});
  const std::string table = outputs.sweepTables();
  EXPECT_NE(
      table.find("- does not hold at albedo = 0.75, energy not known: 7 values not finite: gi\n"),
      std::string::npos)
      << table;
  EXPECT_NE(table.find("| gi | 0.5 |"), std::string::npos) << table;
  EXPECT_EQ(outputs.nonfinite(),
            "7 values are not finite, in 1 row, the first of which is gi in light: "
            "furnace?albedo=0.75");
}

TEST_F(SceneSweepTest, WhatIsNotThereYetIsLeftOut) {
  Outputs outputs(folder());
  EXPECT_EQ(outputs.sweepTables(), "");
  const Suite own = ofScene(suite_, suite_.scenes[0]);
  outputs.add(own, block(0, 0.5, 0));
  const std::string table = outputs.sweepTables();
  EXPECT_EQ(table.find("0.75"), std::string::npos) << table;
  EXPECT_NE(table.find("| gi | none |"), std::string::npos) << table;
}

TEST_F(SceneSweepTest, TheReportHasItsPlot) {
  const Right right(*this);
  const std::vector<SweptBlock> blocks = right.blocks();
  const std::vector<SceneSweep> sweeps = sceneSweeps(blocks);
  ASSERT_EQ(sweeps.size(), 1u);
  const nlohmann::ordered_json document = sweepDocument(sweeps[0]);
  checkReportModel({{"schema", kReportSchema}, {"title", "x"}, {"blocks", {document}}});
  ASSERT_EQ(document["plots"].size(), 2u) << "no times, no plot of them";
  EXPECT_EQ(document["plots"][0]["id"], "energy");
  const auto& plot = document["plots"][1];
  EXPECT_TRUE(plot["x"]["log"].get<bool>());
  EXPECT_EQ(plot["series"][1]["name"], "gi");
  EXPECT_EQ(plot["series"][1]["points"][2][0], 0.9);
  EXPECT_NEAR(plot["series"][1]["points"][2][1].get<double>(), 0.25, 1e-12)
      << "the root of an MSE of 0.25 over a mean of 2";
}

}  // namespace

}  // namespace restlab
