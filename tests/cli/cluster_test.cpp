// restlab plan, work, collect, submit --engine local: tasks in any order, killed, twice at once, on
// a full disk; the tables are those of `run`.
#include <signal.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "tests/cli/program.h"
#include "tests/cli/small_disk.h"
#include "tests/cli/small_suite.h"

namespace restlab::cli_test {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// Two tasks of reference chunks and two of runs: 0 and 1, then 2 (runs 0 and 1) and 3 (run 2).
constexpr const char* kPlan =
    "plan suite.toml -o shared --chunk 2 --chunk-spp 1 --set reference.spp=1500 --set "
    "timing=false --estimate none";

class ClusterTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("suite.toml", kSmallSuite);
  }
  void plan() const {
    const ProgramResult made = run(kPlan);
    ASSERT_EQ(made.code, 0) << made.err;
    ASSERT_NE(made.out.find("4 tasks: 2 of references, then 2 tasks of runs"), std::string::npos)
        << made.out;
  }
  ProgramResult work(int index) const {
    return run("work shared --index " + std::to_string(index));
  }
  void workAll() const {
    for (int index = 0; index < 4; ++index) {
      const ProgramResult done = work(index);
      ASSERT_EQ(done.code, 0) << done.err;
    }
  }
  // Makes the same by `run`, with references of its own.
  void runAlone(const std::string& settings = "--set reference.spp=1500 --set timing=false") const {
    fs::remove_all(path("cache/restlab/references"));
    const ProgramResult alone = run("run suite.toml -o alone " + settings);
    ASSERT_EQ(alone.code, 0) << alone.err;
  }
  std::vector<std::string> keys(const std::string& folder) const {
    std::vector<std::string> names;
    for (const fs::path& job : entries(folder + "/jobs")) names.push_back(job.filename());
    return names;
  }
  void expectSameTables(const std::string& folder) const {
    EXPECT_EQ(read(folder + "/summary.csv"), read("alone/summary.csv"));
    EXPECT_EQ(keys(folder), keys("alone"));
    const Json record = Json::parse(read(folder + "/run.json"));
    EXPECT_EQ(record["status"], "finished");
    EXPECT_TRUE(fs::exists(path(folder + "/report.html")));
  }
  Json status() const {
    const ProgramResult said = run("status shared --json");
    EXPECT_EQ(said.code, 0) << said.err;
    return Json::parse(said.out);
  }
};

TEST_F(ClusterTest, TasksInAnyOrderGiveTheTablesOfRun) {
  plan();
  expectError(work(3), 3,
              {"run 2 of cornell-box-all: reference", "is not there", "not done: 0, 1"});
  ASSERT_EQ(work(1).code, 0);
  expectError(work(2), 3, {"is not there", "not done: 0"});
  for (const int index : {0, 3}) ASSERT_EQ(work(index).code, 0);
  EXPECT_EQ(status()["missing"], "2");

  const ProgramResult part = run("collect shared");
  EXPECT_EQ(part.code, 0) << part.err;
  EXPECT_NE(part.err.find("runs of 1 of 4 tasks are missing: 2;"), std::string::npos) << part.err;
  EXPECT_NE(read("shared/table.md").find("Not finished"), std::string::npos);
  EXPECT_EQ(keys("shared").size(), 1u);

  ASSERT_EQ(work(2).code, 0);
  const ProgramResult again = work(2);
  EXPECT_EQ(again.code, 0);
  EXPECT_NE(again.err.find("was done already"), std::string::npos) << again.err;
  EXPECT_EQ(entries("shared/at-work").size(), 0u) << "marks of tasks that are done";
  const ProgramResult whole = run("collect shared"), elsewhere = run("collect shared -o results");
  EXPECT_EQ(whole.code, 0) << whole.err;
  EXPECT_EQ(elsewhere.code, 0) << elsewhere.err;
  runAlone();
  expectSameTables("shared");
  expectSameTables("results");
  // The collected folder is one of results like any other.
  const ProgramResult report = run("report results");
  EXPECT_EQ(report.code, 0) << report.err;
  const ProgramResult reused =
      run("run suite.toml -o results --set reference.spp=1500 --set timing=false");
  EXPECT_NE(reused.err.find("3 of 3 runs were there already"), std::string::npos) << reused.err;
}

TEST_F(ClusterTest, AWorkerThatIsKilledLeavesNoResult) {
  ASSERT_EQ(run("plan suite.toml -o shared --set runs=1 --set frames=100000 --estimate none").code,
            0);
  ASSERT_EQ(work(0).code, 0);
  Circumstances killed;
  killed.signal = SIGKILL;
  killed.signalWhen = [&] { return fs::exists(path("shared/at-work/000001.json")); };
  EXPECT_EQ(run("work shared --index 1", killed).code, 128 + SIGKILL);
  EXPECT_EQ(entries("shared/done").size(), 0u);
  const Json said = status();
  EXPECT_EQ(said["missing"], "1");
  ASSERT_EQ(said["ended_without_a_result"].size(), 1u) << said;
  EXPECT_EQ(said["ended_without_a_result"][0]["why"], "was killed, or its node was lost");
  EXPECT_EQ(said["at_work"], 0);
}

TEST_F(ClusterTest, TwoWorkersOnOneTaskLeaveOneResult) {
  plan();
  for (const int index : {0, 1}) ASSERT_EQ(work(index).code, 0);
  std::vector<ProgramResult> both(2);
  {
    std::vector<std::jthread> workers;
    for (ProgramResult& result : both) workers.emplace_back([&] { result = work(2); });
  }
  for (const ProgramResult& result : both) EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(entries("shared/done").size(), 1u);
  ASSERT_EQ(work(3).code, 0);
  ASSERT_EQ(run("collect shared").code, 0);
  runAlone();
  expectSameTables("shared");
}

TEST_F(ClusterTest, ADamagedResultIsMissingAndDoneAnew) {
  plan();
  workAll();
  const fs::path file = path("shared/done/000002.tar");
  const auto size = fs::file_size(file);
  fs::resize_file(file, size / 2);
  const ProgramResult part = run("collect shared");
  EXPECT_EQ(part.code, 0) << part.err;
  EXPECT_NE(part.err.find("000002.tar: is damaged"), std::string::npos) << part.err;
  EXPECT_NE(part.err.find("are missing: 2;"), std::string::npos) << part.err;
  EXPECT_EQ(keys("shared").size(), 1u) << "nothing of the damaged one";
  EXPECT_FALSE(fs::exists(file)) << "nobody takes it for done";
  EXPECT_EQ(work(2).code, 0);
  // One byte of an image, with no length changed.
  std::string bytes = read("shared/done/000003.tar");
  const size_t image = bytes.find("\x76\x2f\x31\x01");
  ASSERT_LT(image, bytes.size());
  bytes[image + 3000] = char(bytes[image + 3000] ^ 1);
  write("shared/done/000003.tar", bytes);
  const ProgramResult anew = work(3);
  EXPECT_EQ(anew.code, 0) << anew.err;
  EXPECT_NE(anew.err.find("000003.tar: is damaged"), std::string::npos) << anew.err;
  write("shared/done/000003.tar", bytes);
  EXPECT_NE(run("collect shared -o other").err.find("000003.tar: is damaged"), std::string::npos);
  EXPECT_EQ(work(3).code, 0);
  ASSERT_EQ(run("collect shared").code, 0);
  runAlone();
  expectSameTables("shared");
}

TEST_F(ClusterTest, TasksOfAnotherSuiteOrReferenceAreNotMixed) {
  plan();
  workAll();
  std::string bytes = read("shared/done/000003.tar");
  const std::string word = "\"reference_hash\": \"";
  const size_t hash = bytes.find(word);
  ASSERT_LT(hash, bytes.size());
  char& digit = bytes[hash + word.size()];
  digit = digit == '0' ? '1' : '0';
  write("shared/done/000003.tar", bytes);
  // It is made anew by the same call.
  const ProgramResult made = run("submit shared");
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_NE(made.err.find("000003.tar: is measured against another reference than task 2"),
            std::string::npos)
      << made.err;
  runAlone();
  expectSameTables("shared");

  const ProgramResult more = run("submit shared -q --set runs=9");
  EXPECT_EQ(more.code, 2);
  EXPECT_NE(more.err.find("--set was settled when this was planned"), std::string::npos)
      << more.err;
  fs::remove(path("shared/done/000003.tar"));
  write("shared/suite.toml", read("shared/suite.toml") + "\n");
  const ProgramResult other = work(3);
  EXPECT_EQ(other.code, 3);
  EXPECT_NE(other.err.find("suite.toml: was changed since this was planned"), std::string::npos)
      << other.err;
}

TEST_F(ClusterTest, WhatIsDamagedByItselfIsMadeAnew) {
  plan();
  workAll();
  ASSERT_EQ(run("collect shared").code, 0);
  runAlone();
  // An image of an unpacked job.
  const fs::path image = path("shared/jobs/" + keys("shared")[0] + "/method0.exr");
  fs::resize_file(image, fs::file_size(image) / 2);
  write("shared/done/000002.tar.tmp-1-0-node", "of a killed worker");
  write("shared/done/000004.tar.tmp-1-0-node", "of no task that is done");
  ASSERT_EQ(run("collect shared").code, 0);
  expectSameTables("shared");
  EXPECT_FALSE(fs::exists(path("shared/done/000002.tar.tmp-1-0-node")));
  EXPECT_TRUE(fs::exists(path("shared/done/000004.tar.tmp-1-0-node")));
  // A chunk, before it is merged.
  for (const char* folder : {"shared/references", "shared/done", "shared/jobs"})
    for (const fs::path& entry : entries(folder)) fs::remove_all(entry);
  const fs::path chunk = entries("shared/chunks")[0];
  fs::resize_file(chunk, fs::file_size(chunk) / 2);
  const ProgramResult made = run("submit shared");
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_NE(made.err.find("; task 0 is to be done anew"), std::string::npos) << made.err;
  expectSameTables("shared");
}

// A node that does not see yet what others have made.
TEST_F(ClusterTest, AWorkerWaitsForReferencesThatAreThereElsewhere) {
  plan();
  std::jthread later([&] {
    for (const int index : {0, 1}) EXPECT_EQ(work(index).code, 0);
  });
  const ProgramResult waited = run("work shared --index 3 --wait 100 --json");
  later.join();
  EXPECT_EQ(waited.code, 0) << waited.err;
  EXPECT_NE(waited.err.find("is not to be seen here yet"), std::string::npos) << waited.err;
  const Json said = Json::parse(waited.out);
  ASSERT_EQ(said["tasks"].size(), 1u);
  EXPECT_EQ(said["tasks"][0]["task"], 3);
  EXPECT_EQ(said["tasks"][0]["was_done_already"], false);
  const ProgramResult all = run("submit shared --json");
  EXPECT_EQ(all.code, 0) << all.err;
  const Json made = Json::parse(all.out);
  EXPECT_EQ(made["tasks"], 4);
  EXPECT_EQ(made["missing"], "");
}

TEST_F(ClusterTest, AReferenceFileThatChangesIsRefused) {
  const auto reference = [&](const char* seed) {
    ASSERT_EQ(run({"reference", "cornell-box", "--width", "24", "--height", "16", "--max-bounces",
                   "3", "--spp", "16", "--seed", seed, "-o", "own.exr"})
                  .code,
              0);
  };
  reference("1");
  std::string text = kSmallSuite;
  const std::string list = "scenes = [\"cornell-box\"]\n";
  text.erase(text.find(list), list.size());
  write("suite.toml", text + "[[scene]]\nscene = \"cornell-box\"\nreference = \"own.exr\"\n");
  const ProgramResult made = run("plan suite.toml -o shared --set timing=false --estimate none");
  ASSERT_EQ(made.code, 0) << made.err;
  ASSERT_EQ(work(0).code, 0);
  const std::string before = read("own.exr");
  reference("2");
  expectError(work(1), 3,
              {"own.exr: is not the reference that was planned with", "another folder"});
  expectError(run("collect shared"), 3, {"own.exr: is not the reference that was planned with"});
  write("own.exr", before);
  for (const int index : {1, 2}) EXPECT_EQ(work(index).code, 0);
  EXPECT_EQ(run("collect shared").code, 0);
  EXPECT_EQ(Json::parse(read("shared/run.json"))["status"], "finished");
}

TEST_F(ClusterTest, AFullFolderIsOneLineAndLaterThereIsRoom) {
  fs::create_directory(path("shared"));
  SmallDisk disk(path("shared"), "size=128k");
  if (!disk.whyNot().empty()) GTEST_SKIP() << disk.whyNot();
  plan();
  // Room for a mark, but not for a result.
  constexpr uintmax_t kLeft = 12 << 10;
  const uintmax_t room = fs::space(path("shared")).available;
  ASSERT_GT(room, kLeft);
  write("shared/ballast", std::string(room - kLeft, 'x'));
  expectError(work(0), 3, {"shared/chunks", ".chunk", "cannot be written"});
  EXPECT_EQ(entries("shared/chunks").size() + entries("shared/done").size(), 0u);
  EXPECT_NE(status()["ended_without_a_result"].dump().find("cannot be written"), std::string::npos);
  write("shared/more", std::string(kLeft, 'x'));
  expectError(work(1), 3, {"shared/at-work", "cannot be written"});
  fs::remove(path("shared/more"));
  fs::remove(path("shared/ballast"));
  ASSERT_TRUE(disk.remount("size=2m"));
  workAll();
  EXPECT_EQ(status()["missing"], "");
}

TEST_F(ClusterTest, ACollectorMayWorkBesideWorkers) {
  ASSERT_EQ(run("plan suite.toml -o shared --set runs=12 --set timing=false --estimate none").code,
            0);
  ASSERT_EQ(work(0).code, 0);
  std::atomic<bool> isOver = false;
  std::jthread workers([&] {
    EXPECT_EQ(run("work shared --index 1 --count 12").code, 0);
    isOver = true;
  });
  size_t before = 0;
  while (!isOver) {
    const ProgramResult part = run("collect shared");
    EXPECT_EQ(part.code, 0) << part.err;
    EXPECT_EQ(part.err.find("damaged"), std::string::npos) << part.err;
    EXPECT_GE(keys("shared").size(), before);
    before = keys("shared").size();
  }
  ASSERT_EQ(run("collect shared").code, 0);
  runAlone("--set runs=12 --set timing=false");
  expectSameTables("shared");
}

TEST_F(ClusterTest, WrongPlansAndIndicesAreOneLine) {
  plan();
  expectError(run("work shared --index 4"), 2, {"--index 4", "tasks 0 to 3"});
  expectError(run("work absent --index 0"), 3, {"absent/plan.json", "restlab plan"});
  expectError(run("plan suite.toml -o shared --chunk 3 --estimate none -q"), 3,
              {"plan.json", "of another", "-o"});
  EXPECT_EQ(run(kPlan).code, 0) << "the same plan stays";
  const std::string whole = read("shared/plan.json");
  Json other = Json::parse(whole);
  other["build"]["source_hash"] = "0123456789abcdef";
  other["build"]["version"] = "9.8.7";
  write("shared/plan.json", other.dump());
  for (const char* verb : {"work shared --index 0", "collect shared", "status shared"})
    expectError(run(verb), 3, {"9.8.7", "01234567", "this program is"});
  write("shared/plan.json", whole.substr(0, whole.size() / 2));
  expectError(work(0), 3, {"plan.json"});
  write("shared/plan.json", whole);
  fs::remove_all(path("shared/at-work"));
  expectError(work(0), 3, {"shared/at-work", "is not there"});
  EXPECT_EQ(run("submit suite.toml --engine moon").code, 2);
  {
    const Variable nothing("PATH", "/nowhere");
    expectError(run("submit shared --engine slurm"), 2, {"there is no sbatch here", "local"});
  }
}

TEST_F(ClusterTest, SubmitMakesMoreChunksUntilTheErrorIsReached) {
  const std::string settings =
      "--set reference.spp=1000000 --set reference.target_relmse=2e-4 "
      "--set timing=false";
  const ProgramResult made = run(
      "submit suite.toml -o shared --chunk 2 --chunk-spp 2000 --estimate none -j 2 " + settings);
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_NE(made.err.find("spp are not enough"), std::string::npos) << made.err;
  const Json plan = Json::parse(read("shared/plan.json"));
  ASSERT_GT(plan["groups"].size(), 2u);
  EXPECT_EQ(plan["groups"][2]["each"], 2048) << "as --chunk-spp asks";
  runAlone(settings);
  expectSameTables("shared");
}

// Bounds of memory and time do not depend on the number of runs.
TEST_F(ClusterTest, APlanOfManyRunsIsSmall) {
  const ProgramResult few = run("plan suite.toml -o few --set runs=10 --estimate none"),
                      many = run("plan suite.toml -o many --set runs=100000 --estimate none");
  ASSERT_EQ(few.code, 0) << few.err;
  ASSERT_EQ(many.code, 0) << many.err;
  EXPECT_NE(many.out.find("100001 tasks"), std::string::npos) << many.out;
  EXPECT_LT(fs::file_size(path("many/plan.json")), fs::file_size(path("few/plan.json")) + 100);
  EXPECT_LT(many.peakBytes, few.peakBytes + (uint64_t(16) << 20));
  EXPECT_EQ(run("work many --index 0").code, 0);
  EXPECT_EQ(run("work many --index 100000").code, 0);
}

}  // namespace

}  // namespace restlab::cli_test
