// restlab run continues where it stopped: jobs, their keys, damage, locks, full disks; status,
// report, clean.
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <thread>

#include "core/image/image.h"
#include "tests/cli/program.h"
#include "tests/cli/small_suite.h"

namespace restlab::cli_test {

namespace {

namespace fs = std::filesystem;

class ResumeTest : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("suite.toml", kSmallSuite);
  }
  std::vector<fs::path> jobs() const { return entries("out/jobs"); }
  size_t lines() const {
    const std::string text = read("out/results.jsonl");
    return size_t(std::count(text.begin(), text.end(), '\n'));
  }
  void expectWhole(const std::string& csv) const {
    EXPECT_EQ(parseCsv(csv).at(0).at("runs"), "3");
    EXPECT_EQ(nlohmann::json::parse(read("out/run.json"))["status"], "finished");
    EXPECT_EQ(jobs().size(), 3u);
    EXPECT_EQ(lines(), 6u);
  }
};

// Drops times, which differ from run to run.
std::vector<std::map<std::string, std::string>> errorsOf(const std::string& csv) {
  auto rows = parseCsv(csv);
  for (auto& row : rows) {
    std::erase_if(row, [](const auto& cell) {
      return cell.first.find("time") != std::string::npos ||
             cell.first.find("efficiency") != std::string::npos ||
             cell.first.find("passes") != std::string::npos;
    });
  }
  return rows;
}

TEST_F(ResumeTest, FinishedRunsAreTakenAsTheyAre) {
  ASSERT_EQ(run("run suite.toml --out out").code, 0);
  const std::string csv = read("out/summary.csv"), table = read("out/table.md");
  expectWhole(csv);
  const ProgramResult again = run("run suite.toml --out out");
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_NE(again.err.find("3 of 3 runs were there already"), std::string::npos) << again.err;
  EXPECT_EQ(read("out/summary.csv"), csv) << "to the last digit, times too";
  EXPECT_EQ(read("out/table.md"), table);
  expectWhole(csv);
  const ProgramResult more = run("run suite.toml --out out --set runs=5");
  EXPECT_NE(more.err.find("3 of 5 runs were there already"), std::string::npos) << more.err;
  EXPECT_EQ(parseCsv(read("out/summary.csv"))[0].at("runs"), "5");
  const size_t before = lines();
  const ProgramResult forced = run("run suite.toml --out out --force");
  EXPECT_EQ(forced.err.find("already"), std::string::npos) << forced.err;
  // Times differ: the log has those shown in tables, marked as replacing others.
  EXPECT_EQ(lines(), before + 6);
  const std::string log = read("out/results.jsonl");
  const auto last = nlohmann::json::parse(log.substr(log.rfind('\n', log.size() - 2) + 1));
  EXPECT_TRUE(last["replaces_earlier"].get<bool>());
  const auto job =
      nlohmann::json::parse(read("out/jobs/" + last["job"].get<std::string>() + "/job.json"));
  EXPECT_EQ(job["methods"][1]["lines"].back()["time_ms"], last["time_ms"]);
  EXPECT_EQ(errorsOf(read("out/summary.csv")), errorsOf(csv)) << "same seeds, same images";
}

TEST_F(ResumeTest, WhatChangesTheNumbersMakesTheRunAnew) {
  ASSERT_EQ(run("run suite.toml --out out").code, 0);
  for (const char* change :
       {"seed=7", "warmup_frames=4", "frames=3", "ages=[1]", "method.gi.confidence_cap=5",
        "max_bounces=4", "reference.spp=64", "temporal=true", "accumulate=true", "threads=1"}) {
    const ProgramResult result = run(std::string("run suite.toml --out out --set ") + change);
    ASSERT_EQ(result.code, 0) << result.err;
    const bool isShifted = std::string(change) == "seed=7";
    EXPECT_EQ(result.err.find("already"), std::string::npos) << change << result.err << isShifted;
  }
  EXPECT_GT(jobs().size(), 10u * 3u);
  EXPECT_EQ(run("run suite.toml --out out").code, 0);
  const ProgramResult cleaned = run("clean out");
  EXPECT_EQ(cleaned.code, 0) << cleaned.err;
  EXPECT_EQ(jobs().size(), 3u) << "those of the last suite";
  EXPECT_NE(run("run suite.toml --out out").err.find("3 of 3"), std::string::npos);
}

TEST_F(ResumeTest, InterruptedAndKilledRunsGoOn) {
  ASSERT_EQ(run("run suite.toml --out whole").code, 0);
  const std::string whole = read("whole/summary.csv");
  // Enough runs for the signal to come before the last.
  const std::string many = "run suite.toml --out out --set runs=100000";
  EXPECT_EQ(runUntil([&] { return jobs().size() >= 4; }, many).code, 130);
  const size_t interrupted = jobs().size();
  Circumstances killed;
  killed.signal = SIGKILL;
  killed.signalWhen = [&] { return jobs().size() >= interrupted + 4; };
  EXPECT_EQ(run(many, killed).code, 128 + SIGKILL);
  for (const fs::path& job : jobs()) {
    EXPECT_TRUE(fs::exists(job / "job.json")) << "whole or not at all";
  }
  const ProgramResult rest = run("run suite.toml --out out");
  ASSERT_EQ(rest.code, 0) << rest.err;
  EXPECT_NE(rest.err.find("3 of 3 runs were there already"), std::string::npos) << rest.err;
  EXPECT_EQ(errorsOf(read("out/summary.csv")), errorsOf(whole));
  ASSERT_EQ(run("clean out").code, 0);
  EXPECT_EQ(jobs().size(), 3u);
}

TEST_F(ResumeTest, DamagedJobsAreMadeAnewWithALine) {
  ASSERT_EQ(run("run suite.toml --out out").code, 0);
  const std::string csv = read("out/summary.csv");
  const auto damage = [&](const std::string& file, const auto& how) {
    const fs::path name = jobs().front() / file;
    std::string bytes = read(name.string());
    how(bytes);
    write(name.string(), bytes);
    const ProgramResult result = run("run suite.toml --out out");
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_NE(result.err.find("made anew"), std::string::npos) << file << result.err;
    EXPECT_NE(result.err.find("2 of 3 runs were there already"), std::string::npos) << result.err;
    EXPECT_EQ(errorsOf(read("out/summary.csv")), errorsOf(csv));
  };
  damage("job.json", [](std::string& bytes) { bytes.resize(bytes.size() / 2); });
  damage("job.json", [](std::string& bytes) { bytes.clear(); });
  damage("job.json", [](std::string& bytes) {
    const size_t at = bytes.find("\"mse\": ") + 7;
    bytes[at] = bytes[at] == '1' ? '2' : '1';  // a number that still parses
  });
  damage("method0.exr", [](std::string& bytes) { bytes[bytes.size() - 9] ^= 1; });
  damage("method1.exr", [](std::string& bytes) { bytes.resize(100); });
  fs::remove(jobs().front() / "method1.exr");
  EXPECT_NE(run("run suite.toml --out out").err.find("made anew"), std::string::npos);
  EXPECT_EQ(lines(), 6u + 6u * 2u) << "a line of each method that replaces the earlier one";
}

TEST_F(ResumeTest, ATornLineIsCutOffAndWrittenAgain) {
  ASSERT_EQ(run("run suite.toml --out out").code, 0);
  std::string text = read("out/results.jsonl");
  const std::string whole = text;
  // Damage the last job's two lines: one complete, one torn.
  text.resize(text.size() - 40);
  write("out/results.jsonl", text);
  const ProgramResult result = run("run suite.toml --out out");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.err.find("cut off"), std::string::npos) << result.err;
  EXPECT_EQ(read("out/results.jsonl"), whole) << "nothing is lost, nothing is there twice";
  write("out/results.jsonl", "no JSON\n");
  expectError(run("run suite.toml --out out -q"), 3, {"results.jsonl:1", "no JSON object"});
}

TEST_F(ResumeTest, TwoProgramsInOneFolder) {
  ASSERT_EQ(run("run suite.toml --out out").code, 0);
  const size_t before = jobs().size();
  std::atomic<bool> isEnough{false};
  std::thread first([&] {
    const std::string many = "run suite.toml --out out --set runs=100000";
    EXPECT_EQ(runUntil([&] { return isEnough.load(); }, many).code, 130);
  });
  const auto started = std::chrono::steady_clock::now();
  while (jobs().size() == before &&
         std::chrono::steady_clock::now() - started < std::chrono::seconds(60)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  expectError(run("run suite.toml --out out -q"), 3, {"another restlab", "process"});
  expectError(run("report out -q"), 3, {"another restlab"});
  expectError(run("clean out -q"), 3, {"another restlab"});
  EXPECT_EQ(run("status out").code, 0) << "looking is free";
  isEnough = true;
  first.join();
  EXPECT_EQ(run("run suite.toml --out out").code, 0) << "a program that ended holds no lock";
}

TEST_F(ResumeTest, AFullDiskLeavesNothingThatLooksWhole) {
  ASSERT_EQ(run("run suite.toml --out out").code, 0);
  const std::string csv = read("out/summary.csv");
  // A limit on file sizes acts like a full disk.
  for (const uint64_t kib : {1, 4, 8}) {
    Circumstances full;
    full.maxFileBytes = kib * 1024;
    fs::remove_all(path("out/jobs"));
    fs::remove_all(path("out/results.jsonl"));
    const ProgramResult result = run("run suite.toml --out out", full);
    EXPECT_EQ(result.code, 3) << kib << result.err;
    ASSERT_EQ(result.errors().size(), 1u) << result.err;
    if (!fs::exists(path("out/jobs"))) continue;
    for (const fs::path& job : jobs()) EXPECT_TRUE(fs::exists(job / "job.json")) << job;
  }
  const ProgramResult rest = run("run suite.toml --out out");
  ASSERT_EQ(rest.code, 0) << rest.err;
  EXPECT_EQ(errorsOf(read("out/summary.csv")), errorsOf(csv));
  expectWhole(read("out/summary.csv"));
}

TEST_F(ResumeTest, ReportMakesTheSameFilesAgain) {
  ASSERT_EQ(run("run suite.toml --out out --methods gi,path --sweep max_bounces=1,3").code, 0);
  const std::string csv = read("out/summary.csv"), table = read("out/table.md");
  fs::remove(path("out/summary.csv"));
  fs::remove(path("out/table.md"));
  fs::remove_all(path("out/images"));
  const ProgramResult result = run("report out");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(read("out/summary.csv"), csv);
  EXPECT_EQ(read("out/table.md"), table);
  EXPECT_EQ(readExr(path("out/images/cornell-box-all-max_bounces-3-gi.exr")).layers.at("").width,
            24u);
  const auto status = nlohmann::json::parse(run("status out --json").out);
  EXPECT_EQ(status["blocks"].size(), 2u);
  for (const auto& block : status["blocks"]) EXPECT_EQ(block["runs_there"], 3);
  // Remove the first run of a table, whose images are shown, and one more.
  const auto plan = nlohmann::json::parse(read("out/run.json"))["plan"];
  fs::remove_all(path("out/jobs/" + plan[0]["jobs"][0].get<std::string>()));
  fs::remove_all(path("out/jobs/" + plan[1]["jobs"][2].get<std::string>()));
  const ProgramResult less = run("report out");
  EXPECT_EQ(less.code, 0) << less.err;
  EXPECT_NE(less.err.find("missing or damaged"), std::string::npos) << less.err;
  EXPECT_NE(read("out/table.md").find("Not finished"), std::string::npos);
  EXPECT_EQ(parseCsv(read("out/summary.csv"))[0].at("runs"), "2");
  expectError(run("report nowhere -q"), 3, {"nowhere/run.json"});
  expectError(run("status nowhere -q"), 3, {"nowhere/run.json"});
}

TEST_F(ResumeTest, ReportKeepsWarnings) {
  const std::string dark =
      "run suite.toml --out out --methods path --set max_bounces=1 --set components=indirect";
  const ProgramResult rendered = run(dark);
  ASSERT_EQ(rendered.code, 0) << rendered.err;
  const std::string table = read("out/table.md");
  EXPECT_NE(table.find("its reference is black"), std::string::npos) << table;
  ASSERT_EQ(run("report out").code, 0);
  EXPECT_EQ(read("out/table.md"), table);
}

TEST_F(ResumeTest, ADryRunWritesNothingAndKnowsWhatIsThere) {
  const std::string line = "run suite.toml --out out --sweep max_bounces=2,3 --dry-run";
  const ProgramResult first = run(line);
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_FALSE(fs::exists(path("out")));
  EXPECT_NE(first.out.find("| cornell-box-all-max_bounces-3 | 24x16 | 2 | 0 of 3 | to be made |"),
            std::string::npos)
      << first.out;
  EXPECT_NE(first.out.find("6 jobs, 0 there"), std::string::npos) << first.out;
  ASSERT_EQ(run("run suite.toml --out out --sweep max_bounces=2").code, 0);
  const ProgramResult second = run(line);
  EXPECT_NE(second.out.find("6 jobs, 3 there"), std::string::npos) << second.out;
  expectError(run("run suite.toml --dry-run -q --set width=0"), 2, {"--set width"});
}

TEST_F(ResumeTest, ADryRunIsTheMatrixAndSaysWhatItDoesNotKnow) {
  write("theirs.toml",
        std::string(kSmallSuite) + "[[method]]\nname = \"theirs\"\nimage = \"their.exr\"\n");
  const ProgramResult methods =
      run("run theirs.toml --out out --dry-run --methods path,gi --sweep confidence_cap=4.0,8.0 "
          "--sweep max_bounces=1,2");
  ASSERT_EQ(methods.code, 0) << methods.err;
  const std::string row =
      "| gi, confidence_cap=8.0 | restir_gi, unbiased | pixel | cpu | none | "
      "confidence_cap = 8 |\n";
  ASSERT_NE(methods.out.find(row), std::string::npos) << methods.out;
  EXPECT_EQ(methods.out.find(row), methods.out.rfind(row)) << "once, not for each point";
  EXPECT_NE(methods.out.find("| path | path, unbiased | none | cpu | none |  |"),
            std::string::npos);
  // The time until a relmse is reached is unknown.
  EXPECT_NE(methods.out.find("; about "), std::string::npos) << methods.out;
  write("relmse.toml",
        std::string(kSmallSuite)
            .replace(std::string(kSmallSuite).find("spp = 32"), 8, "target_relmse = 1e-3"));
  const ProgramResult relmse = run("run relmse.toml --out out --dry-run");
  ASSERT_EQ(relmse.code, 0) << relmse.err;
  EXPECT_NE(relmse.out.find("| to be made | at least "), std::string::npos) << relmse.out;
  EXPECT_NE(relmse.out.find("0 there; at least "), std::string::npos) << relmse.out;
  EXPECT_NE(relmse.out.find("relmse is not known"), std::string::npos) << relmse.out;
  const ProgramResult limited =
      run("run relmse.toml --out out --dry-run --set reference.time_limit=3600");
  EXPECT_NE(limited.out.find("| to be made | 60 min |"), std::string::npos) << limited.out;
  EXPECT_EQ(limited.out.find("at least"), std::string::npos) << limited.out;
}

TEST_F(ResumeTest, ADryRunCountsSecondReferencesAndRunsSideBySide) {
  const std::string text = kSmallSuite;
  write("orbit.toml", std::string(text).replace(text.find("spp = 32"), 8, "time_limit = 3600.0") +
                          "[[camera_path]]\nname = \"orbit\"\nkind = \"orbit\"\n"
                          "degrees_per_frame = 2.0\n");
  const std::string line = "run orbit.toml --out out --dry-run --set camera_path=orbit";
  EXPECT_NE(run(line).out.find("| to be made | 60 min |"), std::string::npos);
  const ProgramResult two = run(line + " --set temporal=true");
  EXPECT_NE(two.out.find("| 2 to be made | 120 min |"), std::string::npos) << two.out;
  // Each parallel run has its own buffers; 256x256 pixels make several MiB.
  const auto memory = [&](const std::string& jobs) {
    const std::string said = run("run suite.toml --out out --dry-run --set width=256 --set "
                                 "height=256 --set timing=false" +
                                 jobs)
                                 .out;
    const size_t at = said.find(" MiB of buffers");
    return std::stod(said.substr(said.rfind(' ', at - 1)));
  };
  EXPECT_NEAR(memory(" -j 3"), 3.0 * memory(""), 2.0);
  EXPECT_EQ(memory(" -j 64"), memory(" -j 3")) << "there are three runs";
}

TEST_F(ResumeTest, CleanTakesWhatNoTableUsesAndSaysWhat) {
  ASSERT_EQ(run("run suite.toml --out out --sweep max_bounces=1,2").code, 0);
  ASSERT_EQ(run("run suite.toml --out out").code, 0);
  const fs::path used = path("out/references/cornell-box-all-Camera-24x16.exr");
  EXPECT_TRUE(fs::exists(used));
  write("out/references/notes.txt", "mine");
  write("out/references/x.exr.tmp-4999999-0", "half");
  write("out/summary.csv.tmp-4999999-0", "half");
  fs::create_directories(path("out/jobs/.unfinished-abc-4999999"));
  const ProgramResult cleaned = run("clean out");
  ASSERT_EQ(cleaned.code, 0) << cleaned.err;
  EXPECT_NE(cleaned.err.find("removed 6 folders of jobs, 2 references: "
                             "cornell-box-all-max_bounces-1-Camera-24x16.exr, "
                             "cornell-box-all-max_bounces-2-Camera-24x16.exr and 3 half-made"),
            std::string::npos)
      << cleaned.err;
  EXPECT_NE(cleaned.err.find("kept 3 jobs"), std::string::npos) << cleaned.err;
  EXPECT_TRUE(fs::exists(used));
  EXPECT_EQ(read("out/references/notes.txt"), "mine");
  EXPECT_EQ(std::distance(fs::directory_iterator(path("out/references")), {}), 2);
  EXPECT_FALSE(fs::exists(path("out/summary.csv.tmp-4999999-0")));
  EXPECT_EQ(jobs().size(), 3u);
  EXPECT_EQ(run("report out").code, 0);
  EXPECT_NE(run("clean out").err.find("removed 0 folders of jobs, 0 references and 0 half-made"),
            std::string::npos);
}

TEST_F(ResumeTest, CleanStaysInItsFolderAndAtItsOwn) {
  ASSERT_EQ(run("run suite.toml --out out --set runs=1").code, 0);
  // References shared by several folders, and a foreign folder beside the jobs.
  fs::create_directories(path("shared"));
  write("shared/other.exr", "of another suite");
  for (const auto& entry : fs::directory_iterator(path("out/references")))
    fs::rename(entry.path(), path("shared") / entry.path().filename());
  fs::remove(path("out/references"));
  fs::create_directory_symlink(path("shared"), path("out/references"));
  write("out/jobs/backup/file", "mine");
  // A file being written by a running process: this one.
  const std::string writing = "out/images/x.exr.tmp-" + std::to_string(getpid()) + "-0";
  write(writing, "half");
  const ProgramResult cleaned = run("clean out");
  ASSERT_EQ(cleaned.code, 0) << cleaned.err;
  EXPECT_NE(cleaned.err.find("references: is a link; nothing is removed there"), std::string::npos)
      << cleaned.err;
  EXPECT_EQ(read("shared/other.exr"), "of another suite");
  EXPECT_EQ(read("out/jobs/backup/file"), "mine");
  EXPECT_EQ(read(writing), "half");
}

TEST_F(ResumeTest, CleanKeepsWhatAnUnfinishedSuiteMayNeed) {
  const std::string sweep = "run suite.toml --out out --sweep max_bounces=1,2";
  ASSERT_EQ(run(sweep).code, 0);
  // Simulate an interrupt before the second table.
  auto record = nlohmann::ordered_json::parse(read("out/run.json"));
  record["status"] = "interrupted";
  record["plan"][1]["jobs"].clear();
  record["plan"][1]["reference"] = "";
  write("out/run.json", record.dump());
  write("out/references/x.exr.tmp-4999999-0", "half");
  const ProgramResult cleaned = run("clean out");
  EXPECT_EQ(cleaned.code, 0) << cleaned.err;
  EXPECT_NE(cleaned.err.find("not finished"), std::string::npos) << cleaned.err;
  EXPECT_FALSE(fs::exists(path("out/references/x.exr.tmp-4999999-0")));
  EXPECT_NE(run(sweep).err.find("6 of 6 runs were there already"), std::string::npos);
}

TEST_F(ResumeTest, CleanKeepsBothReferencesOfAMovingCamera) {
  write("suite.toml", std::string(kSmallSuite) +
                          "[[camera_path]]\nname = \"orbit\"\nkind = \"orbit\"\n"
                          "degrees_per_frame = 2.0\n");
  ASSERT_EQ(
      run("run suite.toml --out out --set temporal=true --set camera_path=orbit --set runs=2").code,
      0);
  const ProgramResult cleaned = run("clean out");
  EXPECT_NE(cleaned.err.find(" 0 references"), std::string::npos) << cleaned.err;
  EXPECT_NE(cleaned.err.find("kept 2 jobs and 2 references"), std::string::npos) << cleaned.err;
}

TEST_F(ResumeTest, EveryRowAndImageSaysWhereItComesFrom) {
  ASSERT_EQ(run("render cornell-box --resolution 24x16 --max-bounces 3 -o theirs.exr").code, 0);
  const std::string image = "[[method]]\nname = \"theirs\"\nimage = \"theirs.exr\"\n";
  write("suite.toml", read("suite.toml") + image);
  ASSERT_EQ(run({"run", "suite.toml", "--out", "out", "--set", "name=it's", "--set",
                 "accumulate=true", "--set", "warmup_frames=0", "--set", "ages=[1]"})
                .code,
            0);
  std::istringstream text(read("out/results.jsonl"));
  size_t count = 0;
  std::set<std::string> kinds;
  for (std::string line; std::getline(text, line); ++count) {
    const auto row = nlohmann::json::parse(line);
    kinds.insert(row["kind"].get<std::string>());
    EXPECT_EQ(row["source_hash"].get<std::string>().size(), 16u);
    const auto& provenance = row["provenance"];
    EXPECT_NE(provenance["command"].get<std::string>().find("run suite.toml --out out --set "),
              std::string::npos);
    EXPECT_FALSE(provenance["build"]["git_commit"].get<std::string>().empty());
    EXPECT_FALSE(provenance["build"]["compiler"].get<std::string>().empty());
    EXPECT_FALSE(provenance["machine"]["cpu"].get<std::string>().empty());
    EXPECT_GT(provenance["peak_resident_mib"].get<double>(), 1.0);
    EXPECT_EQ(provenance["utc"].get<std::string>().back(), 'Z');
  }
  EXPECT_GT(count, 6u);
  EXPECT_EQ(kinds, (std::set<std::string>{"run", "age", "accumulated", "image"}));
  std::vector<fs::path> files = {path("out/images/cornell-box-all-gi.exr"),
                                 path("out/images/cornell-box-all-reference.exr")};
  for (const auto& entry : fs::directory_iterator(path("out/references")))
    files.push_back(entry.path());
  EXPECT_EQ(files.size(), 3u);
  for (const fs::path& file : files) {
    const auto words = readExr(file).metadata;
    for (const char* word :
         {"git_commit", "compiler", "cpu", "cores", "load_1min", "governor", "libraries", "utc",
          "command", "seed", "device", "peak_resident_mib", "kind"})
      EXPECT_NE(words.count(word), 0u) << file << word;
    EXPECT_NE(words.at("libraries").find("OpenEXR 3"), std::string::npos) << words.at("libraries");
  }
}

TEST_F(ResumeTest, CamerasMoveAlongPaths) {
  const std::string paths =
      "[[camera_path]]\nname = \"orbit\"\nkind = \"orbit\"\ndegrees_per_frame = 2.0\n"
      "[[camera_path]]\nname = \"cut\"\nkind = \"cut\"\nframe = 3\ndegrees = 20.0\n";
  write("suite.toml", kSmallSuite + paths);
  const std::string line =
      "run suite.toml --out out --set temporal=true --sweep camera_path=still,orbit,cut";
  const ProgramResult result = run(line);
  ASSERT_EQ(result.code, 0) << result.err;
  const auto rows = parseCsv(read("out/summary.csv"));
  ASSERT_EQ(rows.size(), 6u);
  EXPECT_EQ(rows[2].at("camera_path"), "orbit");
  EXPECT_EQ(rows[0].at("temporal_difference_of_reference"), "0");
  for (const size_t moving : {2u, 3u, 4u, 5u}) {
    EXPECT_GT(std::stod(rows[moving].at("temporal_difference_of_reference")), 0.0);
    EXPECT_GT(std::stod(rows[moving].at("temporal_difference")), 0.0);
    EXPECT_EQ(rows[moving].at("temporal_variance"), "nan");
    EXPECT_GT(std::stod(rows[moving].at("temporal_error_difference_squared")), 0.0);
    EXPECT_GT(std::stod(rows[moving].at("temporal_error_difference_squared_ci_hi")), 0.0);
    EXPECT_GT(std::stod(rows[moving].at("temporal_difference_of_reference_noise")), 0.0);
  }
  EXPECT_EQ(rows[0].at("temporal_variance").find("nan"), std::string::npos);
  // Reference and images are of the measured frame's camera: their errors are only noise.
  for (const auto& row : rows) EXPECT_NEAR(std::stod(row.at("energy_ratio")), 1.0, 0.5);
  const auto still = readExr(path("out/images/cornell-box-all-camera_path-still-path.exr"));
  const auto orbit = readExr(path("out/images/cornell-box-all-camera_path-orbit-path.exr"));
  EXPECT_EQ(orbit.metadata.at("camera_path"), "orbit");
  EXPECT_NE(orbit.metadata.at("camera_to_world"), still.metadata.at("camera_to_world"));
  const ProgramResult compared =
      run({"compare", "--ref", "out/images/cornell-box-all-camera_path-orbit-reference.exr",
           "out/images/cornell-box-all-camera_path-orbit-path.exr"});
  EXPECT_EQ(compared.code, 0) << compared.err;
  const ProgramResult again = run(line);
  EXPECT_NE(again.err.find("9 of 9 runs were there"), std::string::npos) << again.err;
  EXPECT_NE(run(line + " --dry-run").out.find("9 jobs, 9 there"), std::string::npos);
  expectError(run("run suite.toml --out o -q --set camera_path=orbt"), 2, {"'orbt'", "'orbit'"});
  expectError(run("run suite.toml --out o -q --set camera_path=orbit --set accumulate=true"), 2,
              {"--set accumulate", "still camera"});
  expectError(run("run suite.toml --out o -q --set camera_path=orbit --set ages=[1]"), 2,
              {"--set ages", "orbit", "reference"});
  write("suite.toml",
        std::string(kSmallSuite) + "[[camera_path]]\nname = \"x\"\nkind = \"orbt\"\n");
  expectError(run("run suite.toml --out o -q"), 2, {"suite.toml:19:8", "orbit"});
}

TEST_F(ResumeTest, SweepsMakeTablesAndMethods) {
  const ProgramResult result =
      run("run suite.toml --out out --sweep max_bounces=1..2 --sweep confidence_cap=4.0,8.0 --set "
          "runs=2");
  ASSERT_EQ(result.code, 0) << result.err;
  const auto rows = parseCsv(read("out/summary.csv"));
  ASSERT_EQ(rows.size(), 6u);
  for (size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(rows[i].at("point"), i < 3 ? "max_bounces=1" : "max_bounces=2");
    EXPECT_EQ(rows[i].at("max_bounces"), i < 3 ? "1" : "2");
  }
  EXPECT_EQ(rows[1].at("method"), "gi, confidence_cap=4.0");
  EXPECT_NE(rows[2].at("parameters").find("confidence_cap=8"), std::string::npos);
  EXPECT_NE(result.out.find("## cornell-box, all light, max_bounces=2"), std::string::npos);
  const std::string tex = read("out/table.tex");
  EXPECT_NE(tex.find("gi, confidence\\_cap=4.0 & "), std::string::npos) << tex;
  EXPECT_NE(tex.find("\\toprule"), std::string::npos);
  EXPECT_EQ(std::count(tex.begin(), tex.end(), '{'), std::count(tex.begin(), tex.end(), '}'));
}

}  // namespace

}  // namespace restlab::cli_test
