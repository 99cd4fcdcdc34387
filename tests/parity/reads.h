// RAII: sets how kernels read on a Vulkan device, for a scope.
#pragma once

#include <stdlib.h>

namespace restlab::parity {

class Reads {
 public:
  // "texels" or "addresses".
  explicit Reads(const char* how) { setenv("RESTLAB_VULKAN_READS", how, 1); }
  ~Reads() { unsetenv("RESTLAB_VULKAN_READS"); }
  Reads(const Reads&) = delete;
  Reads& operator=(const Reads&) = delete;
};

}  // namespace restlab::parity
