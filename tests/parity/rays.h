// Traces single rays on a backend, by the `trace` kernel.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/backend/backend.h"
#include "core/bench/trace.h"
#include "core/scene/compiled/compiled_scene.h"

namespace restlab::parity {

class RayTracer {
 public:
  RayTracer(const std::shared_ptr<const CompiledScene>& scene, const std::string& backend,
            const std::string& rayTracing);
  // Each call allocates its own buffers.
  std::vector<rl::TraceResult> trace(const std::vector<rl::TraceQuery>& queries);
  bool readsTexels() const { return report_.readsTexels; }  // in the last call

 private:
  std::shared_ptr<const CompiledScene> scene_;
  std::unique_ptr<Backend> backend_;
  StartupReport report_;
};

// Path rays from random points in the scene's bounds in random directions.
std::vector<rl::TraceQuery> randomQueries(const std::shared_ptr<const CompiledScene>& scene,
                                          size_t count, uint64_t seed);

}  // namespace restlab::parity
