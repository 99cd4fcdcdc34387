// restlab submit --engine slurm on a real Slurm of one node, which the test starts in a folder of
// its own (private_slurm.sh).
#include <signal.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/cli/program.h"
#include "tests/cli/small_suite.h"

namespace restlab::cli_test {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* kScript = RESTLAB_SOURCE_DIR "/tests/cli/private_slurm.sh";
// Longest wait for the scheduler; a test that works takes a few seconds.
constexpr std::chrono::seconds kPatience{120};

std::string firstLine(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

int shell(const std::string& command) { return std::system(command.c_str()); }

class SlurmTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    const std::string said = path("slurm-said").string();
    fs::create_directory(path("slurm"));
    if (shell(std::string(kScript) + " start " + path("slurm").string() + " >" + said) != 0)
      GTEST_SKIP() << "SKIPPED: no Slurm can be started here: " << firstLine(said);
    setenv("SLURM_CONF", path("slurm/slurm.conf").c_str(), 1);
    write("suite.toml", kSmallSuite);
  }
  void TearDown() override {
    shell(std::string(kScript) + " stop " + path("slurm").string());
    unsetenv("SLURM_CONF");
    ProgramTest::TearDown();
  }
  // Expects that `is` returns true in time.
  void waitUntil(const char* what, const std::function<bool()>& is) const {
    const auto start = std::chrono::steady_clock::now();
    while (!is()) {
      ASSERT_LT(std::chrono::steady_clock::now() - start, kPatience) << what << '\n'
                                                                     << run("status shared").out;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }
  bool isFinished() const {
    const Json record = Json::parse(read("shared/run.json"), nullptr, false);
    return record.is_object() && record["status"] == "finished";
  }
  void submit(const std::string& options) const {
    const ProgramResult made =
        run("submit suite.toml -o shared --engine slurm --threads 1 " + options);
    ASSERT_EQ(made.code, 0) << made.err;
    ASSERT_NE(made.out.find("goes on when they have ended"), std::string::npos) << made.out;
  }
  // Waits for the mark of a task at work and returns its process.
  pid_t processOf(const char* mark) const {
    Json said;
    waitUntil("a task at work", [&] {
      said = Json::parse(read(std::string("shared/at-work/") + mark), nullptr, false);
      return said.is_object();
    });
    return said.is_object() ? said["process"].get<pid_t>() : 0;
  }
};

TEST_F(SlurmTest, AnArrayGivesTheTablesOfRun) {
  submit("--chunk 2 --chunk-spp 1 --set reference.spp=1500 --set timing=false");
  const ProgramResult refused = run({"submit", "suite.toml", "-o", "refused", "--engine", "slurm",
                                     "--estimate", "none", "--sbatch", "--partition=absent -c 1"});
  EXPECT_EQ(refused.code, 3);
  ASSERT_EQ(refused.errors().size(), 1u) << refused.err;
  EXPECT_NE(refused.errors()[0].find("sbatch refuses it: "), std::string::npos) << refused.err;
  EXPECT_NE(refused.errors()[0].find("partition"), std::string::npos) << refused.err;
  expectError(run("submit shared --engine slurm"), 2, {"in the queue already", "restlab status"});
  waitUntil("results", [&] { return isFinished(); });
  fs::remove_all(path("cache/restlab/references"));
  ASSERT_EQ(
      run("run suite.toml -o alone --threads 1 --set reference.spp=1500 --set timing=false").code,
      0);
  EXPECT_EQ(read("shared/summary.csv"), read("alone/summary.csv"));
  EXPECT_TRUE(fs::exists(path("shared/report.html")));
  const Json status = Json::parse(run("status shared --json").out);
  EXPECT_EQ(status["done"], status["tasks"]);
  const std::string script = read("shared/slurm/001.sh");
  for (const char* line :
       {"#SBATCH --mem=", "#SBATCH --time=", "#SBATCH --array=0-1", "#SBATCH --cpus-per-task=1"})
    EXPECT_NE(script.find(line), std::string::npos) << script;
}

TEST_F(SlurmTest, NightlyAKilledWorkerIsAskedForAgainWithTwiceAsMuch) {
  submit("--set runs=1 --set timing=false --set frames=4000");
  const pid_t worker = processOf("000001.json");
  ASSERT_GT(worker, 0);
  ASSERT_EQ(kill(worker, SIGKILL), 0);
  waitUntil("results", [&] { return isFinished(); });
  const auto asked = [&](const char* script) {
    const std::string text = read(script);
    const size_t at = text.find("--mem=");
    return at == std::string::npos ? 0.0 : std::stod(text.substr(at + 6));
  };
  EXPECT_NEAR(asked("shared/slurm/005.sh") / asked("shared/slurm/003.sh"), 2.0, 0.01);
  std::string log;
  for (const fs::path& file : entries("shared/slurm"))
    if (file.extension() == ".log") log += read("shared/slurm/" + file.filename().string());
  EXPECT_NE(log.find("task 1 (run 0 of cornell-box-all) ended without a result on"),
            std::string::npos)
      << log;
  EXPECT_NE(log.find("it is tried again with"), std::string::npos) << log;
}

TEST_F(SlurmTest, NightlyANodeThatGoesDownAndComesBackLosesNothing) {
  submit("--chunk 1 --set runs=2 --set timing=false --set frames=2000");
  ASSERT_GT(processOf("000001.json"), 0);
  ASSERT_EQ(shell("scontrol update nodename=ALL state=down reason=test"), 0);
  // Without effect if Slurm has taken the node back already.
  shell("scontrol update nodename=ALL state=resume 2>/dev/null");
  // Slurm lets jobs that lost their node wait for two minutes.
  waitUntil("results", [&] {
    shell(
        "for job in $(squeue -h -o %A); do scontrol update jobid=$job StartTime=now; done "
        "2>/dev/null >/dev/null");
    return isFinished();
  });
  EXPECT_EQ(shell("scontrol -o show job | grep -q Restarts=[1-9]"), 0) << "no job was lost";
  fs::remove_all(path("cache/restlab/references"));
  ASSERT_EQ(
      run("run suite.toml -o alone --threads 1 --set runs=2 --set timing=false --set frames=2000")
          .code,
      0);
  EXPECT_EQ(read("shared/summary.csv"), read("alone/summary.csv"));
}

}  // namespace

}  // namespace restlab::cli_test
