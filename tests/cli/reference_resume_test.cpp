// References with too few samples are continued, also after an interrupt or kill: the image equals
// that of one rendering, to the last bit.
#include <fmt/format.h>

#include <regex>

#include "tests/cli/reference_files.h"

namespace restlab::cli_test {

namespace {

namespace fs = std::filesystem;

constexpr const char* kScene = " cornell-box --resolution 24x16 --max-bounces 3 ";

class ReferenceResume : public ReferenceFilesTest {
 protected:
  // Renders towards an unreachable target until `signal` ends the program.
  ProgramResult endBy(int signal, const std::function<bool()>& when) const {
    Circumstances circumstances;
    circumstances.signal = signal;
    circumstances.signalWhen = when;
    return run(std::string("reference -o ref.exr --spp 100000000 --checkpoint 0.02") + kScene,
               circumstances);
  }
};

TEST_F(ReferenceResume, ExtendedIsBitForBitThatOfOneGo) {
  for (const uint64_t spp : {3, 32, 65}) {
    const bool isFirst = keptSpp() == 0;
    const std::string options = fmt::format("--spp {}{}", spp, kScene);
    const ProgramResult result = run("reference -o ref.exr " + options);
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(has(result.err, "less than wanted: continues after the "), !isFirst) << result.err;
    expectInOneGo("ref.exr", options);
  }
  EXPECT_EQ(keptSpp(), 65u);
  // Progress is found under any output name: its key identifies what is rendered.
  const ProgramResult other = run(std::string("reference -o other.exr --spp 70") + kScene);
  EXPECT_TRUE(has(other.err, "reference: continues after the 65 spp of ")) << other.err;
  expectInOneGo("other.exr", std::string("--spp 70") + kScene);
}

TEST_F(ReferenceResume, EnoughSamplesStayAsTheyAre) {
  ASSERT_EQ(run(std::string("reference -o ref.exr --spp 32") + kScene).code, 0);
  const std::string before = read("ref.exr");
  const ProgramResult fewer = run(std::string("reference -o ref.exr --spp 8") + kScene);
  EXPECT_EQ(fewer.code, 0);
  EXPECT_TRUE(has(fewer.err, "ref.exr: is of this scene and these settings already")) << fewer.err;
  EXPECT_TRUE(has(fewer.err, "ref.exr: 32 spp")) << fewer.err;
  EXPECT_EQ(read("ref.exr"), before);
  // --anew gives exactly the requested samples.
  ASSERT_EQ(run(std::string("reference -o ref.exr --anew --spp 8") + kScene).code, 0);
  EXPECT_EQ(readExr(path("ref.exr")).metadata.at("spp"), "8");
  EXPECT_EQ(keptSpp(), 32u) << "which leaves the progress alone";
}

TEST_F(ReferenceResume, OfAnotherKeySeedOrVersionIsRenderedAnew) {
  ASSERT_EQ(run(std::string("reference -o ref.exr --spp 8") + kScene).code, 0);
  for (const char* options : {"--spp 8 --max-bounces 2", "--spp 8 --max-bounces 2 --seed 2",
                              "--spp 8 --max-bounces 2 --seed 2 --filter center"}) {
    const std::string other = std::string(options) + " cornell-box --resolution 24x16";
    const ProgramResult result = run("reference -o ref.exr " + other);
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_TRUE(std::regex_search(result.err, std::regex("ref.exr: is of .*; rendered anew\n")))
        << result.err;
    expectInOneGo("ref.exr", other);
  }
  EXPECT_EQ(states().size(), 4u);
  write("ref.exr", "no image");
  const ProgramResult damaged = run(std::string("reference -o ref.exr --spp 16") + kScene);
  EXPECT_TRUE(std::regex_search(damaged.err, std::regex("ref.exr: .*: continues after the 8 spp")))
      << damaged.err;
  expectInOneGo("ref.exr", std::string("--spp 16") + kScene);
}

TEST_F(ReferenceResume, WithoutItsProgressItIsRenderedAnew) {
  ASSERT_EQ(run(std::string("reference -o ref.exr --spp 8") + kScene).code, 0);
  fs::remove_all(path("cache"));
  const ProgramResult result = run(std::string("reference -o ref.exr --spp 16") + kScene);
  EXPECT_TRUE(has(result.err, "ref.exr: has 8 spp, less than wanted; rendered anew"));
  expectInOneGo("ref.exr", std::string("--spp 16") + kScene);
}

TEST_F(ReferenceResume, InterruptedContinues) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const uint64_t before = keptSpp();
    const ProgramResult result = endBy(signal, [&] { return keptSpp() > before + 20; });
    EXPECT_EQ(result.code, 130) << result.err;
    EXPECT_FALSE(fs::exists(path("ref.exr")));
    // All samples are kept, not only those of the last checkpoint.
    std::smatch said;
    ASSERT_TRUE(std::regex_search(result.err, said,
                                  std::regex("not finished; its (\\d+) spp are kept, and the same "
                                             "command continues")))
        << result.err;
    EXPECT_EQ(std::stoul(said[1]), keptSpp());
  }
  const std::string options = fmt::format("--spp {}{}", keptSpp() + 5, kScene);
  ASSERT_EQ(run("reference -o ref.exr " + options).code, 0);
  expectInOneGo("ref.exr", options);
}

TEST_F(ReferenceResume, KilledContinuesFromItsLastCheckpoint) {
  for (int round = 0; round < 4; ++round) {
    const uint64_t before = keptSpp();
    const ProgramResult result = endBy(SIGKILL, [&] { return keptSpp() > before + 7; });
    EXPECT_EQ(result.code, 128 + SIGKILL) << result.err;
    EXPECT_EQ(has(result.err, "continues after"), round > 0) << result.err;
    EXPECT_FALSE(fs::exists(path("ref.exr")));
    EXPECT_GT(keptSpp(), before);
  }
  const std::string options = fmt::format("--spp {}{}", keptSpp() + 5, kScene);
  ASSERT_EQ(run("reference -o ref.exr " + options).code, 0);
  expectInOneGo("ref.exr", options);
}

TEST_F(ReferenceResume, AnewKeepsNothing) {
  const ProgramResult result =
      runUntil([] { return true; },
               std::string("reference -o ref.exr --anew --spp 100000000 --checkpoint 0") + kScene);
  EXPECT_EQ(result.code, 130) << result.err;
  EXPECT_TRUE(has(result.err, "its samples are not kept")) << result.err;
  EXPECT_FALSE(fs::exists(path("ref.exr")));
  EXPECT_TRUE(states().empty());
}

constexpr const char* kReferenceSuite = R"(scenes = ["cornell-box"]
[settings]
width = 24
height = 16
max_bounces = 3
warmup_frames = 0
frames = 1
runs = 2
[reference]
spp = 32
[[method]]
integrator = "path"
)";

TEST_F(ReferenceResume, SuitesContinueToo) {
  write("suite.toml", kReferenceSuite);
  const ProgramResult cut =
      runUntil([&] { return isSaid("\"total\":100000000"); },
               "run suite.toml --out out --json --set reference.spp=100000000");
  ASSERT_EQ(cut.code, 130) << cut.err;
  const uint64_t kept = keptSpp();
  ASSERT_GT(kept, 32u);
  // Same key: the stored samples are more than enough.
  const ProgramResult enough = run("run suite.toml --out out");
  ASSERT_EQ(enough.code, 0) << enough.err;
  EXPECT_TRUE(has(enough.err, fmt::format("made of the {} spp of ", kept))) << enough.err;
  const std::vector<fs::path> made(fs::directory_iterator(path("out/references")), {});
  ASSERT_EQ(made.size(), 1u);
  const std::string file = "out/references/" + made[0].filename().string();
  EXPECT_EQ(readExr(path(file)).metadata.at("spp"), std::to_string(kept));
  // A suite with another seed and more samples continues the stored sequence.
  const std::string more = fmt::format("reference.spp={}", kept + 11);
  const ProgramResult extended = run("run suite.toml --out out --set seed=5 --set " + more);
  ASSERT_EQ(extended.code, 0) << extended.err;
  EXPECT_TRUE(has(extended.err, fmt::format("less than wanted: continues after the {} spp", kept)))
      << extended.err;
  expectInOneGo(file, fmt::format("--spp {}{}", kept + 11, kScene));
  EXPECT_EQ(parseCsv(read("out/summary.csv"))[0].at("reference_spp"), std::to_string(kept + 11));
}

}  // namespace

}  // namespace restlab::cli_test
