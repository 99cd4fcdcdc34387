// A denoiser whose library was missing when the program was built: the error says why.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"
#include "tests/cli/small_suite.h"

namespace restlab::cli_test {
namespace {

using MissingDenoiserTest = ProgramTest;

TEST_F(MissingDenoiserTest, OidnSaysWhy) {
  const ProgramResult list = run("list denoisers --json");
  ASSERT_EQ(list.code, 0) << list.err;
  nlohmann::json oidn;
  for (const auto& denoiser : nlohmann::json::parse(list.out))
    if (denoiser["name"] == "oidn") oidn = denoiser;
  ASSERT_TRUE(oidn.is_object()) << list.out;
  if (oidn["available"] == true) GTEST_SKIP() << "SKIPPED: this program has oidn";
  const std::string why = oidn["why_not"];
  EXPECT_NE(why.find("OpenImageDenoise"), std::string::npos) << why;
  const ProgramResult text = run("list denoisers");
  EXPECT_NE(text.out.find("\noidn "), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("(not available: " + why + ")"), std::string::npos) << text.out;

  expectError(run("render cornell-box -o a.exr --denoiser oidn"), 2, {"oidn", "OpenImageDenoise"});
  EXPECT_FALSE(std::filesystem::exists(path("a.exr")));
  expectError(run("denoise a.exr -o b.exr --denoiser oidn"), 2, {"oidn", "OpenImageDenoise"});
  write("suite.toml", std::string(kSmallSuite) + "denoiser = \"oidn\"\n");
  expectError(run("run suite.toml --out out"), 2, {"suite.toml:17", "oidn", "OpenImageDenoise"});
  // A missing denoiser is not suggested.
  const ProgramResult near = run("render cornell-box -o a.exr --denoiser oidm");
  expectError(near, 2, {"oidm"});
  EXPECT_EQ(near.err.find("'oidn'"), std::string::npos) << near.err;
}

}  // namespace
}  // namespace restlab::cli_test
