// Progress of kernels that are compiled for a scene.
#pragma once

namespace restlab {

// From now on, tells on stderr which kernels of the CPU are compiled, and where they are kept.
void logCompiledKernels();

}  // namespace restlab
