// restlab submit --engine slurm with a scheduler of shell scripts: refusals, lost tasks, and a job
// that goes on and is gone.
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/program.h"
#include "tests/cli/small_suite.h"

namespace restlab::cli_test {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// Five chunks of a reference in three arrays of at most two, then three runs.
constexpr const char* kSubmit =
    "submit suite.toml -o shared --engine slurm --threads 1 --chunk-spp 1 --set "
    "reference.spp=5000 --set timing=false --estimate none";

class SchedulerTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("suite.toml", kSmallSuite);
    fs::create_directory(path("bin"));
    for (const char* file : {"submitted", "queue", "ended", "accounted", "asked", "refused"})
      write(file, "");
    // Jobs are numbered by calls from 101 on. The file `refused` lists calls that are refused.
    script("sbatch", R"([ "$1" = --version ] && exit
echo "$2" >>submitted; call=$(($(wc -l <submitted) + 100))
grep -qx $call refused && { echo "sbatch: error: too many jobs" >&2; exit 1; }
echo $call)");
    script("scontrol", R"([ "$2" = config ] && echo "MaxArraySize            = 2"; true)");
    script("squeue",
           R"(case "$*" in *"-t all"*) echo squeue >>asked; cat ended;; *) cat queue;; esac)");
    script("sacct", R"(echo "sacct ${!#}" >>asked; cat accounted)");
  }
  void script(const std::string& name, const std::string& text) const {
    write("bin/" + name, "#!/bin/bash\ncd '" + path("").string() + "'\n" + text + "\n");
    fs::permissions(path("bin/" + name), fs::perms::owner_all);
  }
  // Writes the mark that a worker of a job leaves.
  void mark(int task, const std::string& job, const std::string& error) const {
    const Json json = {{"node", "n1"}, {"process", 1}, {"job", job}, {"error", error}};
    write("shared/at-work/00000" + std::to_string(task) + ".json", json.dump());
  }
  // Expects a refusal in one line, behind what was taken.
  void expectRefusal(const ProgramResult& result, const std::vector<std::string>& words) const {
    EXPECT_EQ(result.code, 3);
    ASSERT_EQ(result.errors().size(), 1u) << result.err;
    for (const std::string& word : words)
      EXPECT_NE(result.errors()[0].find(word), std::string::npos) << result.err;
  }
  Json submissions() const { return Json::parse(read("shared/submissions.json"))["submissions"]; }
  const Variable path_{"PATH", (path("bin").string() + ":" + std::getenv("PATH")).c_str()};
};

TEST_F(SchedulerTest, WhatWasTakenBeforeARefusalIsKnownAndGoesOn) {
  write("refused", "103\n");
  expectRefusal(run(kSubmit), {"003.sh: sbatch refuses it: sbatch: error: too many jobs",
                               "2 jobs, 101 first", "job 104 goes on with the rest"});
  ASSERT_EQ(submissions().size(), 3u);
  EXPECT_EQ(submissions()[1]["id"], "102");
  EXPECT_EQ(submissions()[1]["tasks"], "2-3");
  EXPECT_EQ(submissions()[2]["tasks"], "") << "the job that goes on";

  write("queue", "104 PENDING\n");
  EXPECT_EQ(run("status shared").out.find("goes on"), std::string::npos);
  write("queue", "");
  write("ended", "104 TIMEOUT\n");
  EXPECT_NE(run("status shared").out.find("job 104 is gone: TIMEOUT;"), std::string::npos);

  // By hand, with room for one job alone.
  write("refused", "106\n107\n108\n");
  expectRefusal(run("submit shared --engine slurm"), {"006.sh", "too many jobs", "1 job, 105 first",
                                                      "when they have ended", "restlab submit"});
  EXPECT_NE(run("status shared").out.find("no job for it was taken"), std::string::npos);
}

TEST_F(SchedulerTest, TablesAreMadeThoughAllIsRefused) {
  ASSERT_EQ(run(kSubmit).code, 0);
  mark(0, "101_0", "");
  write("refused", "105\n106\n107\n108\n109\n");
  expectRefusal(run("submit shared --engine slurm --go-on"), {"005.sh: sbatch refuses it"});
  EXPECT_EQ(Json::parse(read("shared/run.json"))["status"], "3 of 8 tasks are missing");
  EXPECT_EQ(run("status shared").out.find("goes on"), std::string::npos);
}

TEST_F(SchedulerTest, NothingIsHandedOverBesideTheQueue) {
  ASSERT_EQ(run(kSubmit).code, 0);
  write("queue", "101_0 PENDING\n104 RUNNING\n");
  const ProgramResult here = run("submit shared");
  EXPECT_EQ(here.code, 2);
  EXPECT_NE(here.err.find("2 jobs of this plan are in the queue already"), std::string::npos);
  // The job that goes on, requeued: another one is to go on, once.
  const Variable job("SLURM_JOB_ID", "104");
  EXPECT_EQ(run("submit shared --engine slurm --go-on").out, "105 goes on when they have ended\n");
  EXPECT_NE(read("shared/slurm/005.sh").find("afterany:101\n"), std::string::npos);
  write("queue", "101_0 PENDING\n105 PENDING\n");
  EXPECT_EQ(run("submit shared --engine slurm --go-on").out, "");
  EXPECT_EQ(submissions().size(), 5u);
}

TEST_F(SchedulerTest, LostTasksAreAskedForTogetherAndTriedAgainByWhatTheyAskedFor) {
  std::vector<std::string> words = {"--sbatch", "--mem=300M --time=10"};
  std::istringstream given(kSubmit);
  words.insert(words.begin(), std::istream_iterator<std::string>(given), {});
  ASSERT_EQ(run(words).code, 0);
  mark(0, "101_0", "");
  mark(1, "101_1", "the disk is full");
  mark(2, "102_0", "");
  mark(3, "99_1", "of an earlier call by hand");
  write("ended", "101_0 OUT_OF_MEMORY\n101_1 FAILED\n");
  write("accounted", "102_0|CANCELLED by 7\n102_1|COMPLETED\n");
  const ProgramResult next = run("submit shared --engine slurm --go-on --json");
  EXPECT_EQ(next.code, 0) << next.err;
  EXPECT_EQ(read("asked"), "squeue\nsacct 102\n");
  for (const char* line :
       {"n1: OUT_OF_MEMORY, with 300 MiB and 10 min asked for; it is tried again with 600 MiB and "
        "20 min",
        "n1: CANCELLED, with"})
    EXPECT_NE(next.err.find(line), std::string::npos) << next.err;
  // Tasks 3 and 4 as they were, then 0 and 2, then the job that goes on; never task 1.
  const Json jobs = Json::parse(next.out)["jobs"];
  ASSERT_EQ(jobs.size(), 5u) << next.out;
  std::vector<std::string> tasks;
  for (const Json& job : jobs) tasks.push_back(job["tasks"]);
  EXPECT_EQ(tasks, (std::vector<std::string>{"3", "4", "0", "2", ""}));
  const std::string first = read("shared/slurm/005.sh"), again = read("shared/slurm/007.sh");
  EXPECT_NE(first.find("#SBATCH --mem=300M\n#SBATCH --time=10\n"), std::string::npos) << first;
  EXPECT_NE(again.find("#SBATCH --mem=600M\n#SBATCH --time=20\n"), std::string::npos) << again;
}

}  // namespace

}  // namespace restlab::cli_test
