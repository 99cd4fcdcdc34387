// Folder of compiled units: private to the user, shared by processes. A unit is a shared object
// with its check behind it (the loader ignores what follows), under its key.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "core/backend/cpu_kernel.h"

namespace restlab {

class UnitFolder {
 public:
  explicit UnitFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // $XDG_CACHE_HOME/restlab/units or ~/.cache/restlab/units; empty where there is neither.
  static std::filesystem::path defaultFolder();
  const std::filesystem::path& path() const { return folder_; }

  // Makes the folder. Returns one line on why it cannot be used: it cannot be written, or others
  // could write to it; "" if it can.
  std::string open() const;

  struct Loaded {
    rl::CpuKernelEntry entry = nullptr;
    size_t codeBytes = 0;
    std::string why;       // one line on why a file that is there was not loaded
    bool isRight = false;  // the file is what it should be
  };
  // Loads the unit of a key, if there is one: not if it is damaged, of another key or owner. A unit
  // stays loaded until the process ends.
  Loaded load(const std::string& key) const;
  // Moves a shared object into the folder, under its key. Returns why it cannot; "" if it could.
  std::string keep(const std::string& key, const std::filesystem::path& object) const;

  // RAII: the turn to make a unit, among processes and threads. Empty if `isStopped` returned true
  // before it came.
  class Turn {
   public:
    explicit Turn(int descriptor) : descriptor_(descriptor) {}
    ~Turn();
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;

   private:
    int descriptor_;
  };
  std::unique_ptr<Turn> waitForTurn(const std::string& key,
                                    const std::function<bool()>& isStopped) const;

  // Makes an empty folder inside for what one process compiles; empty path if it cannot.
  std::filesystem::path makeWorkFolder() const;
  // Deletes units that were not used for long, down to half of `most` bytes, if the folder has
  // more; and work folders that processes left behind.
  void prune(uint64_t most = uint64_t{512} << 20) const;

 private:
  std::string whyNotLoaded(const std::string& key, const std::filesystem::path& file) const;
  std::filesystem::path fileOf(const std::string& key) const { return folder_ / (key + ".so"); }

  std::filesystem::path folder_;
};

}  // namespace restlab
