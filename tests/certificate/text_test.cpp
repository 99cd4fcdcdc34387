// Texts of certificates: shares, cells and bounds in one text must agree with each other.
#include <gtest/gtest.h>

#include <regex>

#include "experiments/certificate/outputs.h"
#include "experiments/certificate/reference_search.h"
#include "tests/certificate/made_up_runs.h"

namespace restlab::certificate {
namespace {

constexpr uint32_t kTextSide = 32;
constexpr uint64_t kRuns = 128;

// Red is skewed in each pixel but not in the mean; one run in 64 is much brighter in green and
// blue.
Certified oddlySkewed() {
  const Image truth = gradient(kTextSide);
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  const double s = std::sqrt(std::log(1.0 + 2.0 * 2.0));
  Evidence evidence(kTextSide, kTextSide);
  for (uint64_t run = 0; run < kRuns; ++run) {
    Image image = truth;
    const float others = run % 64 == 0 ? 3.0f : 1.0f;
    for (glm::vec3& pixel : image.pixels) {
      pixel.x *= float(std::exp(s * normal(random) - 0.5 * s * s));
      pixel.y *= others * float(1.0 + 0.01 * normal(random));
      pixel.z *= others * float(1.0 + 0.01 * normal(random));
    }
    evidence.add(image);
  }
  Certified c;
  c.name = "odd";
  c.reference = makeReference(truth, 0.005, 2);
  const stats::RunSet runs = evidence.runs();
  c.certificate = judge(evidence, runs, [&] { return runs; }, c.reference, {});
  c.mean = evidence.mean();
  return c;
}

TEST(CertificateText, CellsAndSharesAreOfOneQuantity) {
  const Certified c = oddlySkewed();
  ASSERT_TRUE(c.certificate.image[1].isNormal) << "red";
  ASSERT_FALSE(c.certificate.image[2].isNormal) << "green";
  const std::string text = textOf(c);
  std::smatch found;
  ASSERT_TRUE(std::regex_search(
      text, found,
      std::regex("cells: (\\d+) of (\\w+), the largest ([0-9.]+) % of the image, and ([0-9.]+) % "
                 "of the image in cells that cannot be tested( \\(the image as a whole can in "
                 "red\\))?;")))
      << text;
  EXPECT_NE(found[2], "red") << text;
  EXPECT_LE(std::stod(found[3]) + std::stod(found[4]), 100.0 + 0.1) << text;
  EXPECT_TRUE(found[5].matched) << text;
  // Says why one quantity has an interval and the others do not.
  EXPECT_TRUE(
      std::regex_search(text, std::regex("red +bias [^\\n]*\\] \\(as of [0-9]+, of 400 needed\\)")))
      << text;
  EXPECT_TRUE(
      std::regex_search(text, std::regex("green +bias [^\\n]* %, too skewed for an interval "
                                         "\\(noise as of [0-9.]+ rare events, of 400 "
                                         "needed\\)")))
      << text;
}

TEST(CertificateText, TwoNumbersAreNeverTheSameText) {
  Options options;
  options.rules.margin = 0.005;
  EXPECT_EQ(
      searchText(0.0010003, 64, 1.0, options)
          .rfind("its error is 0.10003 % after 64 spp; wanted is 0.10000 %, a fifth of the margin: "
                 "about 65 spp, 0.016 s more",
                 0),
      0u)
      << searchText(0.0010003, 64, 1.0, options);
  EXPECT_NE(searchText(0.002, 64, 1.0, options).find("wanted is 0.10 %"), std::string::npos);
  EXPECT_NE(searchText(0.002, 64, 1.0, options).find("about 256 spp, 3 s more"), std::string::npos);
}

TEST(CertificateText, ATimeLimitThatIsUsedUpLeavesNoHalves) {
  EXPECT_EQ(timeLimitText(64, 128, 20.0, 0.15),
            "64 runs instead of 128: --time-limit leaves 20 s, half of them for a fresh batch");
  EXPECT_EQ(timeLimitText(32, 128, 0.0, 0.1),
            "32 runs, the fewest that say anything, instead of 128: --time-limit is used up; with "
            "a fresh batch they take about 6.4 s");
}

}  // namespace
}  // namespace restlab::certificate
