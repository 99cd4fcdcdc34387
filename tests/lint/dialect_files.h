// Which files are written in the dialect, found by following the includes of every kernel and of
// every traceRay().
#pragma once

#include <string>
#include <vector>

namespace restlab::lint {

// A kernel of rl_add_kernel; paths relative to the repository.
struct Kernel {
  std::string name, file, header;
};
const std::vector<Kernel>& kernels();

// The files with a traceRay() that both languages share; backends name them beside the kernel
// (RL_KERNEL_TRACE, GlslKernel::traceFile), so that no include leads there.
const std::vector<std::string>& traceFiles();

// Text of a file of the repository; fails the test when it cannot be read.
std::string readSource(const std::string& path);

// Every file that some kernel or trace file includes, directly or not, and these: sorted, each
// once.
const std::vector<std::string>& dialectFiles();
std::vector<std::string> dialectHeaders();

// Every .glsl under core/ and integrators/, included or not; but for core/backend/, where GLSL is
// that of devices alone.
std::vector<std::string> allGlslFiles();

}  // namespace restlab::lint
