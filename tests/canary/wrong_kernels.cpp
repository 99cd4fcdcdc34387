#include "tests/canary/wrong_kernels.h"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace restlab::canary {

std::vector<std::string> canaryNames() {
  std::set<std::string> names;
  for (const WrongKernel& wrong : allWrongKernels()) names.insert(wrong.canary);
  return {names.begin(), names.end()};
}

WrongKernels::WrongKernels(const std::string& canary) : own_(rl::cpuKernelTable()) {
  std::set<std::string> replaced;
  for (const WrongKernel& wrong : allWrongKernels()) {
    if (wrong.canary != canary) continue;
    replaced.insert(wrong.kernel.name);
    rows_.push_back(wrong.kernel);
  }
  if (rows_.empty()) throw std::invalid_argument("there is no canary '" + canary + "'");
  // Leave out all rows of replaced kernels: rows of other masks would be used if they are smaller.
  std::copy_if(own_.rows, own_.rows + own_.count, std::back_inserter(rows_),
               [&](const rl::CpuKernelInfo& row) { return replaced.count(row.name) == 0; });
  rl::registerCpuKernels({rows_.data(), uint32_t(rows_.size())});
}

}  // namespace restlab::canary
