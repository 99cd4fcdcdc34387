// Kernels that read through texels and uniform blocks (fastest for a software driver) against the
// same kernels that read by addresses (every other device): the bits must be equal.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstring>

#include "core/base/error.h"
#include "tests/parity/frames.h"
#include "tests/parity/kernel_runner.h"
#include "tests/parity/rays.h"
#include "tests/parity/reads.h"

namespace restlab::parity {
namespace {

// Images of the third frame, then of a layer, whose buffers are allocated later and lie elsewhere.
std::vector<Image> seenBy(const char* how, const std::string& scene, const Combination& what) {
  const Reads reads(how);
  Session session(sceneNamed(scene), configOf(what, kVulkanSpecialised, 64, 48, 11));
  EXPECT_EQ(session.startup().readsTexels, std::string(how) == "texels");
  session.frames(3);
  return {session.radiance(), session.aov("albedo")};
}

class ReadsTest : public testing::TestWithParam<Combination> {};

TEST_P(ReadsTest, ByTexelsAndByAddressesGiveTheSameBits) {
  if (!hasVulkan()) GTEST_SKIP() << kNoDevice;
  // Modes differ in weights, not in reads.
  if (GetParam().mode != "unbiased") GTEST_SKIP() << "SKIPPED: of unbiased modes alone";
  // A scene with all features, and one without most of them.
  for (const char* scene : {"everything", "cornell-box"}) {
    SCOPED_TRACE(scene);
    const std::vector<Image> texels = seenBy("texels", scene, GetParam());
    const std::vector<Image> addresses = seenBy("addresses", scene, GetParam());
    for (size_t i = 0; i < texels.size(); ++i) {
      const auto& a = texels[i].pixels;
      const auto& b = addresses[i].pixels;
      ASSERT_EQ(a.size(), b.size());
      EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]), 0) << "image " << i;
      EXPECT_TRUE(std::any_of(a.begin(), a.end(), [](const glm::vec3& v) { return v.x > 0.0f; }));
    }
  }
}

// Texels do not reach buffers allocated after the first pass: kernels must read those all the same.
TEST(Reads, BuffersThatCameLaterAreRead) {
  if (!hasVulkan()) GTEST_SKIP() << kNoDevice;
  const Reads reads("texels");
  const auto scene = sceneNamed("cornell-box");
  const std::vector<rl::TraceQuery> queries = randomQueries(scene, 4096, 3);
  RayTracer tracer(scene, "vulkan", "bvh");
  const std::vector<rl::TraceResult> first = tracer.trace(queries);
  EXPECT_TRUE(tracer.readsTexels());
  const std::vector<rl::TraceResult> later = tracer.trace(queries);
  EXPECT_FALSE(tracer.readsTexels());
  ASSERT_EQ(first.size(), later.size());
  EXPECT_EQ(std::memcmp(first.data(), later.data(), first.size() * sizeof first[0]), 0);
}

TEST(Reads, AnotherWordIsRefused) {
  if (!hasVulkan()) GTEST_SKIP() << kNoDevice;
  try {
    seenBy("both", "cornell-box", {"path", "", ""});
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::badUsage);
    EXPECT_NE(std::string(error.what()).find("texels or addresses"), std::string::npos);
  }
}

const auto kNameOf = [](const auto& test) {
  std::string name = test.param.name();
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
};
INSTANTIATE_TEST_SUITE_P(, ReadsTest, testing::ValuesIn(everyPassOnce()), kNameOf);
INSTANTIATE_TEST_SUITE_P(Nightly, ReadsTest, testing::ValuesIn(combinationsThatTrace()), kNameOf);

}  // namespace
}  // namespace restlab::parity
