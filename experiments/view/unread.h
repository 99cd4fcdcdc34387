// Counts the bytes of texts that clients of the viewer's server have not taken. Thread-safe.
#pragma once

#include <cstddef>
#include <map>
#include <mutex>

#include "experiments/view/server.h"

namespace restlab {

class Unread {
 public:
  void add(ClientId id, size_t bytes) {
    const std::lock_guard lock(mutex_);
    bytes_[id] += bytes;
  }
  void take(ClientId id, size_t bytes) {
    const std::lock_guard lock(mutex_);
    if (const auto found = bytes_.find(id); found != bytes_.end()) found->second -= bytes;
  }
  // Forgets a client that is gone.
  void forget(ClientId id) {
    const std::lock_guard lock(mutex_);
    bytes_.erase(id);
  }
  size_t of(ClientId id) const {
    const std::lock_guard lock(mutex_);
    const auto found = bytes_.find(id);
    return found == bytes_.end() ? 0 : found->second;
  }

 private:
  mutable std::mutex mutex_;
  std::map<ClientId, size_t> bytes_;
};

}  // namespace restlab
