// The values of `mis` in mis_values.h match the registered ones.
#include "tests/exact/mis_values.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "core/frame/frame_graph.h"
#include "core/frame/method.h"
#include "core/frame/session.h"
#include "integrators/restir_gi/restir_gi.h"

namespace restlab {
namespace {

std::vector<std::string> listed() {
  std::vector<std::string> names;
  for (const rl::MisValue& value : rl::kMisValues) names.push_back(value.name);
  return names;
}

TEST(MisValues, AreAllThatAreRegistered) {
  size_t found = 0;
  for (const IntegratorInfo* integrator : integratorRegistry()) {
    for (const ParameterInfo& parameter : integrator->parameters) {
      if (parameter.name != "mis") continue;
      ++found;
      EXPECT_EQ(parameter.choices, listed())
          << integrator->name
          << ": a new value is to be one of kMisValues (tests/exact/mis_values.h)";
    }
  }
  EXPECT_GT(found, 0u);
}

TEST(MisValues, ReachTheReuseLoopAsTheyAreListed) {
  const IntegratorInfo& integrator = findIntegrator("restir_gi");
  constexpr rl::uint kOfWeights = rl::RL_REUSE_PAIRWISE | rl::RL_REUSE_DEFENSIVE;
  SessionConfig config;
  config.integrator = integrator.name;
  for (const rl::MisValue& value : rl::kMisValues) {
    const ParameterMap parameters =
        resolveParameters(findMethod(config), {{"mis", std::string(value.name)}});
    FrameGraph graph;
    graph.record({&integrator}, {"unbiased", parameters, 1, true});
    const std::vector<std::byte>& bytes = graph.passes().front().params;
    rl::PathReuseParams packed{};
    ASSERT_EQ(bytes.size(), sizeof packed);
    std::memcpy(&packed, bytes.data(), sizeof packed);
    EXPECT_EQ(packed.reuse.temporalFlags & kOfWeights, value.flags) << value.name;
    EXPECT_EQ(packed.reuse.spatialFlags & kOfWeights, value.flags) << value.name;
    const BiasClass bias = integrator.biasOfParameters("unbiased", parameters);
    EXPECT_EQ(bias == BiasClass::unbiased, value.isUnbiased) << value.name;
  }
}

}  // namespace
}  // namespace restlab
