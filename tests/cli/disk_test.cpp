// restlab run on full or read-only disks: files are complete, and the same command continues once
// there is room.
#include <nlohmann/json.hpp>

#include "core/image/image.h"
#include "tests/cli/program.h"
#include "tests/cli/small_suite.h"
#include "tests/cli/small_disk.h"

namespace restlab::cli_test {

namespace {

namespace fs = std::filesystem;

class DiskTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("suite.toml", kSmallSuite);
    fs::create_directory(path("disk"));
  }
  std::vector<std::string> errors(const std::string& folder) const {
    std::vector<std::string> all;
    for (const auto& row : parseCsv(read(folder + "/summary.csv")))
      all.push_back(row.at("mse") + " " + row.at("mse_ci_lo") + " " + row.at("runs"));
    return all;
  }
  // Expects every file with a final name to be readable to its end.
  void expectWhole(const fs::path& folder) const {
    std::error_code status;
    for (const auto& entry : fs::recursive_directory_iterator(folder, status)) {
      const fs::path& file = entry.path();
      const std::string name = file.filename().string();
      if (file.string().find("/.unfinished-") != std::string::npos) continue;
      if (file.extension() == ".exr") {
        EXPECT_NO_THROW(readExr(file)) << file;
      } else if (file.extension() == ".json") {
        EXPECT_TRUE(nlohmann::json::accept(readText(file))) << file;
      } else if (name == "report.html") {
        EXPECT_NE(readText(file).find("</html>"), std::string::npos);
      } else if (name == "summary.csv") {
        EXPECT_EQ(readText(file).back(), '\n');
      }
    }
  }
  std::string readText(const fs::path& file) const {
    return read(fs::relative(file, folder_).string());
  }
};

TEST_F(DiskTest, AFullOneLosesAtMostTheRunInProgress) {
  ASSERT_EQ(run("run suite.toml -o good").code, 0);
  SmallDisk disk(path("disk"), "size=16k");
  if (!disk.whyNot().empty()) GTEST_SKIP() << disk.whyNot();
  // Sizes at which the disk is full in the reference, the jobs, the images and the report.
  size_t failures = 0, withJobs = 0;
  for (const int kib : {16, 48, 96, 128, 192, 224, 256, 288, 320, 384, 512}) {
    ASSERT_TRUE(disk.remount("size=" + std::to_string(kib) + "k"));
    const ProgramResult result = run("run suite.toml -o disk/out");
    expectWhole(path("disk"));
    if (result.code == 0) break;
    ++failures;
    EXPECT_EQ(result.code, 3) << kib << ": " << result.err;
    EXPECT_EQ(result.errors().size(), 1u) << kib << ": " << result.err;
    EXPECT_NE(result.err.find("disk/out"), std::string::npos) << "names the file: " << result.err;
    EXPECT_FALSE(fs::exists(path("disk/out/report.html")) &&
                 nlohmann::json::parse(read("disk/out/run.json"))["status"] == "finished");
    withJobs += result.err.find("runs were there") != std::string::npos ||
                fs::exists(path("disk/out/jobs"));
  }
  EXPECT_GE(failures, 4u) << "sizes at which something did not fit";
  EXPECT_GE(withJobs, 1u);
  ASSERT_TRUE(disk.remount("size=16m"));
  const ProgramResult rest = run("run suite.toml -o disk/out");
  ASSERT_EQ(rest.code, 0) << rest.err;
  EXPECT_EQ(errors("disk/out"), errors("good"));
  EXPECT_EQ(nlohmann::json::parse(read("disk/out/run.json"))["status"], "finished");
  expectWhole(path("disk"));
}

TEST_F(DiskTest, AReadOnlyOneIsToldBeforeAnythingIsRendered) {
  SmallDisk disk(path("disk"), "size=16m");
  if (!disk.whyNot().empty()) GTEST_SKIP() << disk.whyNot();
  ASSERT_EQ(run("run suite.toml -o disk/out").code, 0);
  const std::string csv = read("disk/out/summary.csv");
  ASSERT_TRUE(disk.remount("size=16m", true));
  const std::vector<std::string> said = {"disk/", "ead-only"};
  expectError(run("run suite.toml -o disk/new -q --set reference.spp=1000000000"), 3, said);
  expectError(run("run suite.toml -o disk/out -q --set runs=9"), 3, said);
  expectError(run("report disk/out -q"), 3, said);
  expectError(run("clean disk/out -q"), 3, said);
  EXPECT_EQ(run("status disk/out").code, 0) << "looking is free";
  EXPECT_EQ(run("compare disk/out disk/out").code, 0);
  EXPECT_EQ(read("disk/out/summary.csv"), csv);
}

}  // namespace

}  // namespace restlab::cli_test
