// restlab bias --images: certificates of existing images.
#include <fmt/format.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <random>

#include "core/image/image.h"
#include "tests/cli/program.h"

namespace restlab::cli_test {
namespace {

using Json = nlohmann::json;

class BiasImagesTest : public ProgramTest {
 protected:
  // One bounce from a lamp to a floor: little noise, and an exact image.
  const std::string small_ = "bias quad-light --resolution 16x16 --max-bounces 1 -o out";
};

// Only one image of 64 is bright in a pixel: the noise of its cell is that of one rare event.
TEST_F(BiasImagesTest, RareEventsArePrinted) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(0.9f, 1.1f);
  std::filesystem::create_directory(path("runs"));
  for (int i = 0; i < 64; ++i) {
    Image image(8, 8);
    for (glm::vec3& p : image.pixels) p = glm::vec3(uniform(random));
    if (i == 10) image.at(5, 2) = glm::vec3(1e5f);
    writeExr(path(fmt::format("runs/{:02}.exr", i)), {{{"", image}}, {}});
  }
  writeExr(path("truth.exr"), {{{"", Image(8, 8, glm::vec3(1.0f))}}, {}});
  const ProgramResult result = run("bias --images runs/*.exr --ref truth.exr -o out");
  EXPECT_EQ(result.code, 1) << result.err;
  EXPECT_NE(result.out.find("heavy tails: the noise of the worst cell is like that of 1.1 rare "
                            "events in 32 runs"),
            std::string::npos)
      << result.out;
  EXPECT_NE(result.out.find("taken as exact"), std::string::npos) << result.out;
  const Json document = Json::parse(read("out/certificates.json")).at("certificates").at(0);
  // n q (1 - q) / (1 - 2 q)^2 with q = 1 / 32.
  EXPECT_NEAR(document.at("fewest_rare_events").get<double>(), 1.102, 0.001);
}

// Certifies the runs of a certificate as if they were images of another program.
TEST_F(BiasImagesTest, AreCertifiedAlike) {
  ASSERT_EQ(run(small_ + " --runs 64 --frames 32 -q").code, 0);
  const std::string runs = entries("out/runs").at(0).string();
  std::string reference;
  for (const auto& file : entries("out/references")) reference = file.string();
  const std::vector<std::string> command = {
      "bias", "--images", runs + "/run-*.exr", "--ref", reference, "-o", "theirs"};
  const ProgramResult result = run(command);
  EXPECT_EQ(result.code, 0) << result.err << result.out;
  EXPECT_NE(result.out.find("equivalent"), std::string::npos) << result.out;

  // An image with the pixels of another, then one with its seed.
  std::filesystem::copy(runs + "/run-00003.exr", runs + "/run-00003-again.exr");
  expectError(run(command), 3, {"run-00003-again.exr", "run-00003.exr", "independent"});
  LayeredImage image = readExr(runs + "/run-00004.exr");
  std::filesystem::remove(runs + "/run-00003-again.exr");
  image.layers[""].pixels[0].x += 1.0f;
  writeExr(runs + "/run-00004-again.exr", image);
  expectError(run(command), 3, {"run-00004-again.exr", "seed", "run-00004.exr"});
  std::filesystem::remove(runs + "/run-00004-again.exr");
  writeExr(runs + "/run-99999.exr", {{{"", Image(8, 8)}}, {}});
  expectError(run(command), 3, {"run-99999.exr", "8x8", "16x16"});
  // A single image, then a reference that does not exist or has another size.
  expectError(run({"bias", "--images", runs + "/run-00007.exr", "--ref", reference}), 3,
              {"--images: 1 file, the first of which is", "run-00007.exr", "at least 64"});
  std::filesystem::remove(runs + "/run-99999.exr");
  expectError(run({"bias", "--images", runs + "/run-*.exr", "--ref", "no.exr"}), 3, {"no.exr"});
  writeExr(path("small.exr"), {{{"", Image(4, 4, glm::vec3(1.0f))}}, {}});
  expectError(run({"bias", "--images", runs + "/run-*.exr", "--ref", "small.exr"}), 3,
              {"run-00000.exr", "16x16", "small.exr", "4x4"});
  // A file in the folder of a certificate that is a copy of another run.
  std::filesystem::copy(runs + "/run-00005.exr", runs + "/run-00006.exr",
                        std::filesystem::copy_options::overwrite_existing);
  expectError(run(small_ + " --runs 64 --frames 32 -q"), 3,
              {"run-00006.exr", "10000006", "not", "delete it"});
}

// Refuses images that are not runs of one method of what the reference shows.
TEST_F(BiasImagesTest, ThatDoNotBelongTogetherAreRefused) {
  const auto images = [&](const std::string& folder, const char* key,
                          const std::function<std::string(int)>& value) {
    std::filesystem::create_directory(path(folder));
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(0.9f, 1.1f);
    for (int i = 0; i < 64; ++i) {
      LayeredImage image;
      image.layers[""] = Image(8, 8, glm::vec3(uniform(random)));
      image.metadata[key] = value(i);
      writeExr(path(fmt::format("{}/{:02}.exr", folder, i)), image);
    }
  };
  const auto certify = [&](const std::string& pattern, const std::string& reference) {
    return run({"bias", "--images", pattern, "--ref", reference, "-o", "out"});
  };
  writeExr(path("truth.exr"), {{{"", Image(8, 8, glm::vec3(1.0f))}}, {}});
  images("mixed", "integrator", [](int i) { return i == 40 ? "path" : "restir_gi"; });
  expectError(certify("mixed/*.exr", "truth.exr"), 3,
              {"mixed/40.exr", "integrator is 'path'", "'restir_gi' in mixed/00.exr"});
  images("other", "max_bounces", [](int) { return "3"; });
  LayeredImage ours;
  ours.layers[""] = Image(8, 8, glm::vec3(1.0f));
  ours.metadata = {{"kind", "reference"}, {"scene_hash", "1"}, {"max_bounces", "8"}};
  writeExr(path("ours.exr"), ours);
  expectError(certify("other/*.exr", "ours.exr"), 3,
              {"ours.exr, for other/00.exr", "max_bounces is 8, not 3"});
  std::filesystem::copy(path("truth.exr"), path("other/99.exr"));
  expectError(certify("other/*.exr", "truth.exr"), 3,
              {"other/99.exr", "the pixels of the reference truth.exr"});
  std::filesystem::remove(path("other/99.exr"));
  EXPECT_FALSE(std::filesystem::exists(path("out"))) << "nothing is left of what is refused";
  // Other programs' variance may be of a sample, not of the mean: ignored.
  LayeredImage theirs;
  theirs.layers[""] = Image(8, 8, glm::vec3(1.0f));
  theirs.layers["variance"] = Image(8, 8, glm::vec3(-1.0f));
  writeExr(path("theirs.exr"), theirs);
  const ProgramResult result = certify("other/*.exr", "theirs.exr");
  EXPECT_NE(result.out.find("taken as exact"), std::string::npos) << result.out << result.err;
  for (const char* option : {"--integrator path", "--max-bounces 3", "--frames 4", "-j 2",
                             "--runs 64", "--max-runs 64", "--set mis=pairwise"})
    expectError(run(std::string("bias --images other/*.exr --ref truth.exr ") + option), 2,
                {"nothing is rendered for --images"});
}

}  // namespace
}  // namespace restlab::cli_test
