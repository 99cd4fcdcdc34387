// Kernels with one mistake each (made by tests/canary/CMakeLists.txt).
#pragma once

#include <string>
#include <vector>

#include "core/backend/cpu_kernel.h"

namespace restlab::canary {

struct WrongKernel {
  const char* canary;
  rl::CpuKernelInfo kernel;  // has the name of the program's kernel
};
// Generated at build time.
const std::vector<WrongKernel>& allWrongKernels();

// The canaries' names, each once.
std::vector<std::string> canaryNames();

// RAII: sessions constructed during its lifetime use a canary's kernels instead of the program's,
// and must end before it. Only one may exist at a time.
class WrongKernels {
 public:
  // Throws std::invalid_argument if there is no such canary.
  explicit WrongKernels(const std::string& canary);
  ~WrongKernels() { rl::registerCpuKernels(own_); }
  WrongKernels(const WrongKernels&) = delete;
  WrongKernels& operator=(const WrongKernels&) = delete;

 private:
  rl::CpuKernelTable own_;
  std::vector<rl::CpuKernelInfo> rows_;
};

}  // namespace restlab::canary
