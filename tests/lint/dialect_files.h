// Lists the files written in the dialect, by following the includes of every kernel and of every
// traceRay().
#pragma once

#include <string>
#include <vector>

namespace restlab::lint {

// A kernel of rl_add_kernel; paths relative to the repository.
struct Kernel {
  std::string name, file, header;
};
const std::vector<Kernel>& kernels();

// Files with a traceRay() for both languages. Backends name them beside the kernel
// (RL_KERNEL_TRACE, GlslKernel::traceFile): no include leads to them.
const std::vector<std::string>& traceFiles();

// Returns the text of a file of the repository; fails the test if it cannot be read.
std::string readSource(const std::string& path);

// Every file that some kernel or trace file includes, directly or not, and these themselves:
// sorted, without duplicates.
const std::vector<std::string>& dialectFiles();
std::vector<std::string> dialectHeaders();

// Every .glsl under core/ and integrators/, included or not; except core/backend/, where GLSL is
// for devices only.
std::vector<std::string> allGlslFiles();

}  // namespace restlab::lint
