// A callback that may end frames, for as long as it is wanted.
#pragma once

#include <functional>

#include "core/backend/backend.h"

namespace restlab {

// Installs a stop callback for its lifetime.
class Stops {
 public:
  Stops(Backend& backend, const std::function<bool()>& isWanted) : backend_(backend) {
    backend_.stopWhere(isWanted);
  }
  ~Stops() { backend_.stopWhere({}); }
  Stops(const Stops&) = delete;
  Stops& operator=(const Stops&) = delete;

 private:
  Backend& backend_;
};

}  // namespace restlab
