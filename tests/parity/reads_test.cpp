// The choice between reads through texels and reads by addresses. What both see: frames_test.cpp.
#include <gtest/gtest.h>

#include <cstring>

#include "core/base/error.h"
#include "tests/parity/frames.h"
#include "tests/parity/kernel_runner.h"
#include "tests/parity/rays.h"
#include "tests/parity/reads.h"

namespace restlab::parity {
namespace {

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
    const Reads reads("both");
    Session(sceneNamed("cornell-box"), configOf({"path", "", ""}, kVulkanSpecialised, 64, 48, 11));
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::badUsage);
    EXPECT_NE(std::string(error.what()).find("texels or addresses"), std::string::npos);
  }
}

}  // namespace
}  // namespace restlab::parity
