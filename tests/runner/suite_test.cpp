// Suites of several backends: their methods, what each is compared with, and which settings reach
// which backend. Nothing is rendered.
#include "experiments/runner/suite/suite.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/base/error.h"
#include "experiments/runner/reference/reference.h"
#include "tests/runner/temporary_folder.h"

namespace restlab {

namespace {

class SuiteTest : public TemporaryFolder {
 protected:
  Suite load(const std::string& settings, const std::string& methods,
             const std::vector<std::string>& overrides = {}) const {
    const std::filesystem::path file = folder() / "suite.toml";
    std::ofstream(file) << "scenes = [\"cornell-box\"]\n[settings]\n" << settings << methods;
    return loadSuite(file, overrides);
  }
  std::vector<std::string> names(const Suite& suite) const {
    std::vector<std::string> all;
    for (const SuiteMethod& method : suite.methods) all.push_back(method.name);
    return all;
  }
};

using Names = std::vector<std::string>;

constexpr const char* kMethods =
    "[[method]]\nname = \"gi\"\nintegrator = \"restir_gi\"\n[[method]]\nname = \"path\"\n";

TEST_F(SuiteTest, EveryMethodRunsOnEveryBackend) {
  const Suite suite = load("backend = [\"vulkan\", \"cpu\"]\n", kMethods);
  EXPECT_EQ(names(suite), (Names{"gi @vulkan", "gi @cpu", "path @vulkan", "path @cpu"}));
  EXPECT_EQ(suite.methodBackends(), (Names{"vulkan", "cpu"}));
  EXPECT_EQ(suite.methods[1].session.backend, "cpu");
  // The baseline is on the method's own backend, the counterpart on the first.
  EXPECT_EQ(suite.baselineOf(0), 2u);
  EXPECT_EQ(suite.baselineOf(1), 3u);
  EXPECT_EQ(suite.baselineOf(3), 3u);
  EXPECT_EQ(suite.onFirstBackend(0), 0u);
  EXPECT_EQ(suite.onFirstBackend(1), 0u);
  EXPECT_EQ(suite.onFirstBackend(3), 2u);
}

TEST_F(SuiteTest, OneBackendLeavesNamesAlone) {
  EXPECT_EQ(names(load("", kMethods)), (Names{"gi", "path"}));
  EXPECT_EQ(load("", kMethods).methods[0].session.backend, "cpu");
  const Suite suite = load("backend = \"cpu\"\n", kMethods, {"backend=vulkan"});
  EXPECT_EQ(names(suite), (Names{"gi", "path"}));
  EXPECT_EQ(suite.methods[0].session.backend, "vulkan");
  EXPECT_EQ(suite.referenceBackend, "cpu") << "references do not follow the methods";
  EXPECT_EQ(load("", kMethods, {"reference.backend=vulkan"}).referenceBackend, "vulkan");
  EXPECT_EQ(suite.referenceIntegrator, "path");
  EXPECT_EQ(load("", kMethods, {"reference.integrator=bdpt"}).referenceIntegrator, "bdpt");
}

// A method whose frames have no mean of their own cannot be the reference.
TEST_F(SuiteTest, AMethodMayBeTheReference) {
  const std::string methods =
      std::string(kMethods) + "[[method]]\nname = \"lit\"\nintegrator = \"local\"\nambient = 0.5\n";
  const Suite suite = load("", methods, {"reference.method=lit"});
  const ReferenceConfig config = referenceOfSuite(suite, suite.methods[1].session);
  EXPECT_EQ(config.integrator, "local");
  EXPECT_EQ(std::get<double>(config.parameters.at("ambient")), 0.5);
  // Rows on several backends have other names.
  const Suite both = load("backend = [\"cpu\", \"vulkan\"]\n", methods, {"reference.method=lit"});
  EXPECT_EQ(referenceOfSuite(both, both.methods[1].session).integrator, "local");
  EXPECT_THROW(load("", methods, {"reference.method=lit", "reference.integrator=bdpt"}), Error);
  EXPECT_EQ(referenceOfSuite(load("", methods), suite.methods[1].session).integrator, "path");
  const auto messageOf = [&](const char* method) {
    try {
      load("", methods, {std::string("reference.method=") + method});
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_NE(messageOf("gi").find("'gi': its frames depend on earlier ones"), std::string::npos)
      << messageOf("gi");
  EXPECT_NE(messageOf("lid").find("no such method"), std::string::npos) << messageOf("lid");
  EXPECT_NE(messageOf("lid").find("'lit'"), std::string::npos) << messageOf("lid");
}

TEST_F(SuiteTest, AMethodsOwnBackendWins) {
  const std::string own = std::string(kMethods) + "backend = \"vulkan\"\n";
  const Suite suite = load("backend = [\"cpu\", \"vulkan\"]\n", own);
  EXPECT_EQ(names(suite), (Names{"gi @cpu", "gi @vulkan", "path @vulkan"}));
  EXPECT_EQ(suite.baselineOf(0), suite.methods.size()) << "no path on the CPU";
  EXPECT_EQ(suite.baselineOf(1), 2u);
  EXPECT_EQ(names(load("", own)), (Names{"gi @cpu", "path @vulkan"}));
  EXPECT_EQ(names(load("", kMethods, {"method.path.backend=[\"cpu\",\"vulkan\"]"})),
            (Names{"gi @cpu", "path @cpu", "path @vulkan"}));
  EXPECT_EQ(names(load("", kMethods, {"method.backend=vulkan"})), (Names{"gi", "path"}));
}

TEST_F(SuiteTest, MethodsThatDifferInMoreThanTheBackendAreNotCompared) {
  const std::string gi = "[[method]]\nname = \"gi\"\nintegrator = \"restir_gi\"\n";
  const Suite same = load("", gi + gi + "backend = \"vulkan\"\n");
  EXPECT_EQ(names(same), (Names{"gi @cpu", "gi @vulkan"}));
  EXPECT_EQ(same.onFirstBackend(1), 0u);
  const Suite other = load("", gi + gi + "backend = \"vulkan\"\nconfidence_cap = 3.0\n");
  EXPECT_EQ(other.onFirstBackend(1), 1u);
  EXPECT_THROW(load("", gi + gi), Error) << "two methods of one name on one backend";
}

TEST_F(SuiteTest, SettingsReachTheBackendsThatHaveThem) {
  const Suite suite = load(
      "backend = [\"cpu\", \"vulkan\"]\ndevice = \"x\"\nvalidate = true\nray_tracing = \"query\"\n",
      kMethods);
  for (const SuiteMethod& method : suite.methods) {
    const bool vulkan = method.session.backend == "vulkan";
    EXPECT_EQ(method.session.device, vulkan ? "x" : "");
    EXPECT_EQ(method.session.validate, vulkan);
    EXPECT_EQ(method.session.rayTracing, vulkan ? "query" : "");
  }
  const Suite both = load("backend = [\"cpu\", \"vulkan\"]\nray_tracing = \"bvh\"\n", kMethods);
  for (const SuiteMethod& method : both.methods) EXPECT_EQ(method.session.rayTracing, "bvh");
  EXPECT_THROW(load("ray_tracing = \"query\"\n", kMethods), Error);
  EXPECT_THROW(load("device = \"x\"\n", kMethods), Error);
  EXPECT_THROW(load("validate = true\n", kMethods), Error);
  EXPECT_EQ(load("device = \"x\"\n", kMethods, {"reference.backend=vulkan"}).device, "x");
}

}  // namespace

}  // namespace restlab
