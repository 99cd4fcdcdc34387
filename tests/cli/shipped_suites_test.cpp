// Shipped suites, and suites written as docs/experiments.md tells: each loads, states its question
// and its time, and runs.
#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "tests/cli/program.h"

namespace restlab::cli_test {

namespace {

namespace fs = std::filesystem;

const fs::path kSuites = fs::path(RESTLAB_SOURCE_DIR) / "experiments/suites";

std::string textOf(const fs::path& file) {
  std::ifstream in(file);
  EXPECT_TRUE(in.good()) << file;
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<std::string> shippedSuites() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(kSuites)) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string oneLine(const std::string& text) {
  return std::regex_replace(text, std::regex("\\s*\n#?\\s*|\\s+"), " ");
}

constexpr const char* kTiny = " --set width=16 --set height=9 --set max_bounces=2";

class ShippedSuite : public ProgramTest, public ::testing::WithParamInterface<std::string> {
 protected:
  fs::path file() const { return kSuites / (GetParam() + ".toml"); }
};

// Suites must name every integrator, mode and cache, and for certificates every denoiser, also new
// ones.
TEST_F(ProgramTest, LaboratorySuitesHaveEveryMethod) {
  using Json = nlohmann::json;
  const auto namesOf = [&](const char* what) {
    std::set<std::string> names;
    for (const Json& one : Json::parse(run(std::string("list ") + what + " --json").out)) {
      // These suites compare means with the truth, which has all light.
      const bool hasAllLight = one.value("leaves_out", std::string()).empty();
      if (one.value("available", true) && hasAllLight) names.insert(one.at("name"));
    }
    EXPECT_FALSE(names.empty()) << what;
    return names;
  };
  for (const char* suite : {"stress", "stress-quick", "certificates"}) {
    const std::string text = textOf(kSuites / (std::string(suite) + ".toml"));
    std::set<std::string> integrators = namesOf("integrators");
    // Each change pays for it: one method stands for all that share the passes of core/reuse.
    if (suite == std::string("stress-quick")) integrators = {"path", "template", "restir_gi"};
    for (const std::string& integrator : integrators)
      EXPECT_NE(text.find("integrator = \"" + integrator + "\""), std::string::npos)
          << suite << ": " << integrator;
    std::vector<std::string> lists = {"caches"};
    if (suite == std::string("certificates")) lists.push_back("denoisers");
    for (const std::string& list : lists) {
      std::set<std::string> names = namesOf(list.c_str());
      names.erase("oidn");  // not available on every machine
      for (const std::string& name : names)
        EXPECT_NE(text.find("\"" + name + "\""), std::string::npos) << suite << ": " << name;
    }
    EXPECT_NE(text.find("mode = [\"unbiased\", \"biased\"]"), std::string::npos) << suite;
  }
}

TEST_P(ShippedSuite, SaysItsQuestionAndItsTime) {
  const std::string text = textOf(file());
  EXPECT_TRUE(std::regex_search(text, std::regex("\nquestion = \"[^\"]{20,}\\?\"\n"))) << text;
  const std::string comment = oneLine(text.substr(0, text.find("\nname = ")));
  EXPECT_TRUE(std::regex_search(
      comment, std::regex("([Aa]bout \\d+( to \\d+)?|under (a|two)) minutes? on two cores")))
      << comment;
  EXPECT_NE(text.find("name = \"" + GetParam() + "\"\n"), std::string::npos) << text;
  // docs/experiments.md must list it with the same time.
  const std::string table = textOf(fs::path(RESTLAB_SOURCE_DIR) / "docs/experiments.md");
  const size_t row = table.find("| `" + GetParam() + ".toml` |");
  ASSERT_NE(row, std::string::npos) << "docs/experiments.md has no row of it";
  std::smatch minutes;
  if (std::regex_search(comment, minutes, std::regex("[Aa]bout (\\d+( to \\d+)?) minutes"))) {
    EXPECT_NE(table.substr(row, table.find('\n', row) - row).find("(" + minutes[1].str() + " min"),
              std::string::npos)
        << "docs/experiments.md has another time than " << comment;
  }
}

TEST_P(ShippedSuite, IsPlannedWhole) {
  const ProgramResult result = run("run " + file().string() + " --dry-run --out out" + kTiny);
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(result.errors().empty());
  EXPECT_EQ(result.err.find("warning"), std::string::npos) << result.err;
  // Optional scenes are planned or skipped with a line; nothing else may be missing.
  const std::string text = textOf(file());
  std::set<std::string> skipped;
  std::istringstream lines(result.out);
  for (std::string line; std::getline(lines, line);) {
    if (line.find("skipped: ") != std::string::npos) skipped.insert(line);
  }
  const std::regex optional("\noptional = true\n");
  const auto count = std::distance(std::sregex_iterator(text.begin(), text.end(), optional),
                                   std::sregex_iterator());
  EXPECT_LE(ptrdiff_t(skipped.size()), count) << result.out;
  for (const std::string& line : skipped) std::printf("    %s\n", line.c_str());
  EXPECT_TRUE(std::regex_search(result.out, std::regex("\n[1-9]\\d* jobs, 0 there"))) << result.out;
  EXPECT_FALSE(fs::exists(path("out"))) << "--dry-run writes nothing";
}

// Scenes of five million triangles take most of a minute.
const std::string kDear = "stress";

std::vector<std::string> dailySuites() {
  std::vector<std::string> names = shippedSuites();
  std::erase(names, kDear);
  return names;
}

const auto kNameOf = [](const auto& suite) {
  std::string name = suite.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
};
INSTANTIATE_TEST_SUITE_P(All, ShippedSuite, ::testing::ValuesIn(dailySuites()), kNameOf);
INSTANTIATE_TEST_SUITE_P(Nightly, ShippedSuite, ::testing::Values(kDear), kNameOf);

// Returns every file below a folder, by relative path; keys of jobs and references become KEY.
std::set<std::string> filesBelow(const fs::path& folder) {
  std::set<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::string name = fs::relative(entry.path(), folder).generic_string();
    name = std::regex_replace(name, std::regex("^jobs/[0-9a-f]{16,}/"), "jobs/KEY/");
    files.insert(std::regex_replace(name, std::regex("-[0-9a-f]{16,}\\.exr$"), "-KEY.exr"));
  }
  return files;
}

using ConvergenceSuite = ProgramTest;

TEST_F(ConvergenceSuite, LeavesWhatIsDocumented) {
  const ProgramResult result =
      run("run " + (kSuites / "convergence.toml").string() + " --out out --scenes cornell-box" +
          kTiny + " --set runs=8 --set frames=4 --set reference.spp=512");
  ASSERT_EQ(result.code, 0) << result.err;
  std::set<std::string> expected = {"report.html", "results.jsonl", "run.json", "suite.toml",
                                    "summary.csv", "table.md",      "table.tex"};
  const std::vector<std::string> methods = {"path-traced", "path-accumulate", "ReSTIR-GI-biased",
                                            "ReSTIR-GI-unbiased", "ReSTIR-GI-unbiased-accumulate"};
  for (const char* plot : {"error-time", "error-frames", "single-frame", "bars"})
    expected.insert(std::string("plots/cornell-box-all-") + plot + ".svg");
  for (const char* extension : {".exr", ".png"}) {
    expected.insert(std::string("images/cornell-box-all-reference") + extension);
    for (const std::string& method : methods)
      expected.insert("images/cornell-box-all-" + method + extension);
  }
  std::set<std::string> found = filesBelow(path("out"));
  std::erase_if(found, [](const std::string& name) {
    return name.rfind("jobs/KEY/", 0) == 0 || name == ".lock";
  });
  std::erase_if(found, [](const std::string& name) { return name.rfind("references/", 0) == 0; });
  EXPECT_EQ(found, expected);
  EXPECT_EQ(std::distance(fs::directory_iterator(path("out/jobs")), fs::directory_iterator()), 8)
      << "a job a run";
  EXPECT_EQ(std::distance(fs::directory_iterator(path("out/references")), fs::directory_iterator()),
            1);
  // The report holds all tables of table.md, and its data have the numbers of summary.csv.
  const std::string page = read("out/report.html"), table = read("out/table.md");
  for (const char* method : {"path traced", "ReSTIR GI (biased)", "ReSTIR GI (unbiased)"}) {
    EXPECT_NE(page.find(method), std::string::npos) << method;
    EXPECT_NE(table.find(std::string("| ") + method), std::string::npos) << table;
  }
  // Skip the speed-ups: whether such short curves share a time or an error depends on the machine.
  for (const char* column :
       {"MSE", "slope", "efficiency", "relMSE without the worst 0.1 %", "bytes / pixel"})
    EXPECT_NE(page.find(column), std::string::npos) << column << " is in no table of the report";
  const std::string title = "cornell-box, all light";
  EXPECT_NE(table.find("## " + title), std::string::npos) << table;
  EXPECT_NE(page.find(title), std::string::npos);
  EXPECT_NE(page.find("MSE of accumulated frames over time"), std::string::npos);
  EXPECT_NE(table.find("Frames accumulated"), std::string::npos) << table;
  EXPECT_NE(read("out/table.tex").find("\\toprule"), std::string::npos);
  size_t accumulated = 0;
  std::istringstream lines(read("out/results.jsonl"));
  for (std::string line; std::getline(lines, line);)
    accumulated += nlohmann::json::parse(line)["kind"] == "accumulated";
  EXPECT_EQ(accumulated, 5u * 8u * 3u) << "methods x runs x (1, 2 and 4 frames)";
}

// Returns the code blocks of docs/experiments.md, which are indented by four blanks.
std::vector<std::string> codeBlocks() {
  std::vector<std::string> blocks;
  std::istringstream lines(textOf(fs::path(RESTLAB_SOURCE_DIR) / "docs/experiments.md"));
  std::string block, line;
  // A block inside a list is indented by more, and ends where the text continues.
  const auto end = [&] {
    while (!block.empty() && block.ends_with("\n\n")) block.pop_back();
    if (!block.empty()) blocks.push_back(block);
    block.clear();
  };
  while (std::getline(lines, line)) {
    if (line.rfind("    ", 0) == 0) {
      block += line.substr(line.find_first_not_of(' ') == std::string::npos ? 0 : 4) + "\n";
    } else if (line.empty()) {
      if (!block.empty()) block += "\n";
    } else {
      end();
    }
  }
  end();
  return blocks;
}

std::string blockWith(const std::string& words) {
  for (const std::string& block : codeBlocks()) {
    if (block.find(words) != std::string::npos) return block;
  }
  ADD_FAILURE() << "docs/experiments.md has no code block with " << words;
  return "";
}

// Settings that make a run of the document as small as possible.
constexpr const char* kTinyRun =
    " --set width=16 --set height=9 --set max_bounces=2 --set runs=2 --set reference.spp=32 --set "
    "warmup_frames=1";

class ExperimentsDocument : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("radius.toml", blockWith("name = \"radius\""));
  }
  // Returns the arguments of a ./lab command in the document; "" for other commands.
  static std::string ofProgram(std::string command) {
    command = std::regex_replace(command, std::regex("^\\s+"), "");
    return command.rfind("./lab ", 0) == 0 ? command.substr(6) : "";
  }
  static std::vector<std::string> words(const std::string& command) {
    std::vector<std::string> all(1);
    bool isQuoted = false;
    for (const char c : command) {
      if (c == '"') {
        isQuoted = !isQuoted;
      } else if (c == ' ' && !isQuoted) {
        if (!all.back().empty()) all.emplace_back();
      } else {
        all.back() += c;
      }
    }
    if (all.back().empty()) all.pop_back();
    return all;
  }
};

TEST_F(ExperimentsDocument, EveryCommandRuns) {
  size_t commands = 0, skipped = 0;
  for (const std::string& block : codeBlocks()) {
    std::istringstream lines(std::regex_replace(block, std::regex("\\\\\n\\s*"), ""));
    for (std::string line; std::getline(lines, line);) {
      const std::string command = ofProgram(line);
      if (command.empty()) {
        if (line.rfind("...", 0) == 0) {
          std::printf("    skipped: %s\n", line.c_str());
          ++skipped;
        }
        continue;
      }
      std::vector<std::string> arguments = words(command);
      // Expand {4,8,16} as a shell would.
      std::vector<std::string> all;
      for (const std::string& word : arguments) {
        const size_t open = word.find('{'), close = word.find('}');
        if (open == std::string::npos || close == std::string::npos) {
          all.push_back(word);
          continue;
        }
        std::istringstream parts(word.substr(open + 1, close - open - 1));
        for (std::string part; std::getline(parts, part, ',');)
          all.push_back(word.substr(0, open) + part + word.substr(close + 1));
      }
      if (all.front() == "run") {
        for (const std::string& word : words(kTinyRun)) all.push_back(word);
      }
      // Scale the crop from an image of 160x90 to one of 16x9.
      std::replace(all.begin(), all.end(), std::string("40,30,32,24"), std::string("4,3,3,2"));
      const ProgramResult result = run(all);
      EXPECT_EQ(result.code, 0) << line << "\n" << result.err;
      ++commands;
    }
  }
  std::printf("    %zu commands ran, %zu lines skipped\n", commands, skipped);
  EXPECT_GE(commands, 6u);
  EXPECT_LE(skipped, 1u);
  for (const char* file : {"results/radius/report.html", "results/radius/table.tex", "crops.svg",
                           "results/after/report.html"})
    EXPECT_TRUE(fs::exists(path(file))) << file;
}

// The reference must be good enough to fit a line through the errors.
constexpr const char* kFewFrames = " --set runs=4 --set frames=4 --set reference.spp=1024";

// Adds the keys from the document to the suite from the document.
TEST_F(ExperimentsDocument, FurtherKeysAreOfASuite) {
  const std::string suite = read("radius.toml");
  const std::string accumulate = blockWith("accumulate = true");
  const std::string heading = "[settings]\n";
  const size_t at = suite.find(heading);
  ASSERT_NE(at, std::string::npos);
  std::string text = suite;
  // `temporal` and `metrics` only appear in the text of the document.
  text.insert(at + heading.size(), accumulate + "metrics = [\"flip_hdr\", \"ssim\"]\n");
  text += blockWith("[[mask]]");
  text = std::regex_replace(text, std::regex("rectangle = \\[60, 20, 90, 70\\]"),
                            "rectangle = [6, 2, 9, 7]");
  write("further.toml", text);
  const ProgramResult missing =
      run(std::string("run further.toml --out out") + kTinyRun + kFewFrames);
  expectError(missing, 3, {"door-ajar-1.exr"});
  // Stand-ins for images of another program.
  for (const char* file : {"door-ajar-1.exr", "door-ajar-2.exr"}) {
    const std::string seed = file[10] == '1' ? "1" : "2";
    ASSERT_EQ(run("render door-ajar --resolution 16x9 --max-bounces 2 -o " + std::string(file) +
                  " --seed " + seed)
                  .code,
              0);
  }
  const ProgramResult result =
      run(std::string("run further.toml --out out") + kTinyRun + kFewFrames);
  ASSERT_EQ(result.code, 0) << result.err;
  const auto rows = parseCsv(read("out/summary.csv"));
  ASSERT_EQ(rows.size(), 5u) << "path, three radii, theirs";
  EXPECT_EQ(rows.back().at("method"), "theirs");
  EXPECT_EQ(rows.front().count("mse@door"), 1u);
  EXPECT_EQ(rows.front().count("flip_hdr"), 1u);
  EXPECT_NE(rows.front().at("accumulated_slope"), "nan");
}

}  // namespace

}  // namespace restlab::cli_test
