// Kernels that are compiled when a scene first asks for their features, and kept for later runs.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "core/backend/backend.h"
#include "core/backend/units/unit_compiler.h"
#include "core/backend/units/unit_folder.h"
#include "core/backend/units/unit_source.h"

namespace restlab {

class KernelUnits {
 public:
  KernelUnits(UnitCompiler compiler, std::filesystem::path folder);
  KernelUnits(const KernelUnits&) = delete;
  KernelUnits& operator=(const KernelUnits&) = delete;

  // Returns whether units can be made, as far as is known: the compiler is there, and nothing has
  // failed in this process.
  bool areThere();
  // Returns the unit's kernel; null if it was not made ready.
  rl::CpuKernelEntry find(const KernelUnit& unit) const;
  size_t codeBytes(const KernelUnit& unit) const;  // 0 if it was not made ready
  // Makes units ready: from the folder, or by the compiler, on all cores. Adds those that were not
  // ready before, and one notice where something failed, to `report`. Returns false if not all are
  // ready. Throws Error (interrupted) after a signal.
  bool prepare(const std::vector<KernelUnit>& units, StartupReport& report);

  // Adds the notice that units cannot be made, if it was not given before.
  void notice(StartupReport& report);

  // Called with the number of units that were compiled, out of how many: before the first one and
  // after each.
  using Progress = std::function<void(size_t done, size_t total)>;
  void onProgress(Progress progress);
  std::string folder() const { return folder_.path().string(); }

 private:
  struct Job;
  std::string keyOf(const KernelUnit& unit, const std::string& text,
                    const std::vector<DialectSource>& sources) const;
  void compile(std::vector<Job>& jobs);
  void compile(Job& job, const std::filesystem::path& work);
  UnitFolder::Loaded load(const Job& job);
  void fail(const std::string& why);

  const UnitCompiler compiler_;
  const UnitFolder folder_;
  mutable std::mutex mutex_;  // guards what follows
  std::mutex turn_;           // one session of this process compiles at a time
  std::map<KernelUnit, UnitFolder::Loaded> ready_;
  std::vector<std::string> warnings_;
  std::string failure_;  // first one; empty: none
  bool isNoticed_ = false;
  Progress progress_;
};

// The units of this process: with unitCompiler(), in UnitFolder::defaultFolder().
KernelUnits& kernelUnits();

}  // namespace restlab
