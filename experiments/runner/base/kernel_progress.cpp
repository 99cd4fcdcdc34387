#include "experiments/runner/base/kernel_progress.h"

#include <fmt/format.h>

#include <memory>

#include "core/backend/units/kernel_units.h"
#include "experiments/runner/base/log.h"

namespace restlab {

void logCompiledKernels() {
  kernelUnits().onProgress(
      [progress = std::shared_ptr<Progress>()](size_t done, size_t total) mutable {
        if (done == 0) {
          logInfo(fmt::format("compiling {} kernel{} for the features of the scene; kept in {}",
                              total, total == 1 ? "" : "s", kernelUnits().folder()));
          progress = std::make_shared<Progress>("kernels", total);
        }
        progress->update(done);
        if (done == total) progress.reset();
      });
}

}  // namespace restlab
