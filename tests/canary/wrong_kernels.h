// Kernels with one mistake each (tests/canary/CMakeLists.txt makes them).
#pragma once

#include <string>
#include <vector>

#include "core/backend/cpu_kernel.h"

namespace restlab::canary {

struct WrongKernel {
  const char* canary;
  rl::CpuKernelInfo kernel;  // named as the one of the program
};
// Generated.
const std::vector<WrongKernel>& allWrongKernels();

// The canaries' names, each once.
std::vector<std::string> canaryNames();

// Sessions that are made while it lives run a canary's kernels in place of the program's, and must
// end before it. One at a time.
class WrongKernels {
 public:
  // Throws std::invalid_argument where there is no such canary.
  explicit WrongKernels(const std::string& canary);
  ~WrongKernels() { rl::registerCpuKernels(own_); }
  WrongKernels(const WrongKernels&) = delete;
  WrongKernels& operator=(const WrongKernels&) = delete;

 private:
  rl::CpuKernelTable own_;
  std::vector<rl::CpuKernelInfo> rows_;
};

}  // namespace restlab::canary
