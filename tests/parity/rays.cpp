#include "tests/parity/rays.h"

#include <cstring>

#include "tests/unit/random_inputs.h"
#include "tests/unit/ray_cases.h"

namespace restlab::parity {

RayTracer::RayTracer(const std::shared_ptr<const CompiledScene>& scene, const std::string& backend,
                     const std::string& rayTracing)
    : scene_(scene) {
  BackendOptions options;
  options.rayTracing = rayTracing;
  backend_ = makeBackend(backend, scene, options);
}

std::vector<rl::TraceResult> RayTracer::trace(const std::vector<rl::TraceQuery>& queries) {
  std::vector<rl::TraceResult> results(queries.size());
  const size_t bytes = results.size() * sizeof results[0];
  PassRun pass;
  pass.kernel = "trace";
  pass.mask = backend_->maskFor("trace", scene_->features());
  pass.buffers = {backend_->allocate(queries.size() * sizeof queries[0]),
                  backend_->allocate(bytes)};
  const rl::TraceParams params{static_cast<uint32_t>(queries.size())};
  pass.params.resize(sizeof params);
  std::memcpy(pass.params.data(), &params, sizeof params);
  rl::FrameData frame{};
  frame.width = 512;
  frame.height = static_cast<uint32_t>((queries.size() + 4095) / 4096 * 8);
  backend_->write(pass.buffers[0], queries.data(), queries.size() * sizeof queries[0]);
  report_ = {};
  backend_->prepare(pass, report_);
  backend_->submit({pass}, frame);
  backend_->collect();
  backend_->read(pass.buffers[1], results.data(), bytes);
  return results;
}

std::vector<rl::TraceQuery> randomQueries(const std::shared_ptr<const CompiledScene>& scene,
                                          size_t count, uint64_t seed) {
  unit::Inputs inputs(seed);
  const auto [low, high] = unit::startBounds(*scene);
  std::vector<rl::TraceQuery> queries(count);
  for (rl::TraceQuery& q : queries) {
    const float x = inputs.uniform(), y = inputs.uniform(), z = inputs.uniform();
    q.ray = {low + (high - low) * glm::vec3(x, y, z), 0.0f, inputs.direction(), 3e38f};
    q.mode = rl::RL_RAY_PATH;
    q.alphaKey = inputs.bits();
  }
  return queries;
}

}  // namespace restlab::parity
