#include "core/backend/units/kernel_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <thread>

#include "core/backend/kernel_cache.h"
#include "core/backend/stop_scope.h"
#include "core/base/error.h"
#include "core/base/memory.h"

namespace restlab {

namespace fs = std::filesystem;

struct KernelUnits::Job {
  KernelUnit unit;
  std::string key, text;
  UnitFolder::Loaded loaded;
  bool fromDisk = false;
  double timeMs = 0.0;
  std::string why;  // it was not made
  bool isReady() const { return loaded.entry != nullptr; }
};

namespace {

using Clock = std::chrono::steady_clock;

double msSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// RAII: a folder that is removed with all that is in it.
struct WorkFolder {
  fs::path path;
  ~WorkFolder() {
    std::error_code ignored;
    if (!path.empty()) fs::remove_all(path, ignored);
  }
};

// Writes files below a folder. Returns why it cannot; "" if it could.
std::string writeSources(const fs::path& folder, const std::vector<DialectSource>& sources) {
  for (const DialectSource& source : sources) {
    const fs::path file = folder / source.path;
    std::error_code status;
    if (fs::exists(file, status)) continue;
    fs::create_directories(file.parent_path(), status);
    std::ofstream stream(file, std::ios::binary);
    stream.write(source.text.data(), std::streamsize(source.text.size()));
    stream.close();
    if (!stream) return fmt::format("{}: cannot be written (is the disk full?)", folder.string());
  }
  return "";
}

// One for each core, and for each 1.5 GB of memory that is available.
size_t compilersAtOnce() {
  constexpr uint64_t kBytesEach = 1'500'000'000;
  const size_t cores = std::max(1u, std::thread::hardware_concurrency());
  const uint64_t fit = availableMemory().value_or(~uint64_t{0}) / kBytesEach;
  return std::max<size_t>(1, std::min<uint64_t>(cores, fit));
}

}  // namespace

KernelUnits::KernelUnits(UnitCompiler compiler, fs::path folder)
    : compiler_(std::move(compiler)), folder_(std::move(folder)) {}

bool KernelUnits::areThere() {
  const std::string missing = whyNotThere(compiler_);
  const std::lock_guard lock(mutex_);
  if (failure_.empty()) failure_ = missing;
  return failure_.empty();
}

void KernelUnits::notice(StartupReport& report) {
  const std::lock_guard lock(mutex_);
  if (failure_.empty() || isNoticed_) return;
  isNoticed_ = true;
  report.notices.push_back(
      fmt::format("kernels are not compiled for the scene ({}): built-in ones run, which leave out "
                  "less",
                  failure_));
}

rl::CpuKernelEntry KernelUnits::find(const KernelUnit& unit) const {
  const std::lock_guard lock(mutex_);
  const auto found = ready_.find(unit);
  return found == ready_.end() ? nullptr : found->second.entry;
}

size_t KernelUnits::codeBytes(const KernelUnit& unit) const {
  const std::lock_guard lock(mutex_);
  const auto found = ready_.find(unit);
  return found == ready_.end() ? 0 : found->second.codeBytes;
}

void KernelUnits::onProgress(Progress progress) {
  const std::lock_guard lock(mutex_);
  progress_ = std::move(progress);
}

void KernelUnits::fail(const std::string& why) {
  const std::lock_guard lock(mutex_);
  if (failure_.empty()) failure_ = why;
}

// Names all that decides about the code: sources, flags, and in `text` the versions of the compiler
// and of the libraries whose headers are included.
std::string KernelUnits::keyOf(const KernelUnit& unit, const std::string& text,
                               const std::vector<DialectSource>& sources) const {
  std::string all = text;
  for (const DialectSource& source : sources) {
    all += source.path;
    all += '\n';
    all += source.text;
  }
  for (const std::string& flag : compiler_.flags) all += flag + '\n';
  return fmt::format("{}-{:x}-{}", unit.kernel, unit.mask, contentKey(all));
}

bool KernelUnits::prepare(const std::vector<KernelUnit>& units, StartupReport& report) {
  const auto isReady = [&](const KernelUnit& unit) { return find(unit) != nullptr; };
  if (std::all_of(units.begin(), units.end(), isReady)) return true;
  const std::lock_guard turn(turn_);
  const auto start = Clock::now();
  std::vector<Job> jobs;
  for (const KernelUnit& unit : units) {
    const bool isListed =
        std::any_of(jobs.begin(), jobs.end(), [&](const Job& job) { return job.unit == unit; });
    if (find(unit) == nullptr && !isListed) jobs.emplace_back().unit = unit;
  }
  if (jobs.empty()) return true;
  {
    const std::lock_guard lock(mutex_);
    if (!failure_.empty()) return false;
  }
  if (const std::string why = folder_.open(); !why.empty()) {
    fail(why);
  } else {
    compile(jobs);
  }
  bool isWhole = true;
  {
    const std::lock_guard lock(mutex_);
    for (const Job& job : jobs) {
      if (!job.isReady()) {
        isWhole = false;
        if (failure_.empty())
          failure_ = job.why;  // empty where an earlier failure stopped the rest
        continue;
      }
      ready_.emplace(job.unit, job.loaded);
      report.kernels.push_back({job.unit.kernel, job.unit.mask, job.fromDisk, job.timeMs, 0.0});
    }
    report.timeMs += msSince(start);
    report.notices.insert(report.notices.end(), warnings_.begin(), warnings_.end());
    warnings_.clear();
  }
  if (!isWhole) notice(report);
  return isWhole;
}

// Takes from the folder what is there, and compiles the rest.
void KernelUnits::compile(std::vector<Job>& jobs) {
  std::vector<Job*> missing;
  for (Job& job : jobs) {
    const auto start = Clock::now();
    job.text = unitText(job.unit, compiler_.version);
    job.key = keyOf(job.unit, job.text, unitSources(job.unit));
    job.loaded = load(job);
    job.fromDisk = job.isReady();
    job.timeMs = msSince(start);
    // The compiler would make it once more, to no avail.
    if (!job.fromDisk && job.loaded.isRight) return fail(job.loaded.why);
    if (!job.fromDisk) missing.push_back(&job);
  }
  if (missing.empty()) return;
  if (const std::string why = whyNotThere(compiler_); !why.empty()) return fail(why);
  const WorkFolder work{folder_.makeWorkFolder()};
  if (work.path.empty()) return fail(fmt::format("{}: cannot be written", folder()));
  for (const Job* job : missing) {
    if (const std::string why = writeSources(work.path, unitSources(job->unit)); !why.empty())
      return fail(why);
  }
  Progress progress;
  {
    const std::lock_guard lock(mutex_);
    progress = progress_;
  }
  if (progress) progress(0, missing.size());
  std::atomic<size_t> next = 0;
  std::mutex progressMutex;
  size_t done = 0;
  {
    std::vector<std::jthread> workers;
    const StopFlag flag = stopFlag();
    const size_t count = std::min(compilersAtOnce(), missing.size());
    for (size_t i = 0; i < count; ++i) {
      workers.emplace_back([&] {
        const StopScope stops(flag);
        for (size_t job = next++; job < missing.size(); job = next++) {
          if (framesStopped()) return;
          try {
            compile(*missing[job], work.path);
          } catch (const std::exception& error) {
            missing[job]->why = error.what();
          }
          if (!missing[job]->isReady()) next = missing.size();  // the others would fail, too
          const std::lock_guard lock(progressMutex);
          if (progress && missing[job]->isReady()) progress(++done, missing.size());
        }
      });
    }
  }
  if (framesStopped())
    throw Error(ExitCode::interrupted, "interrupted: while kernels were compiled");
  folder_.prune();
}

// Loads what an earlier run has left; a warning says why a file is of no use.
UnitFolder::Loaded KernelUnits::load(const Job& job) {
  UnitFolder::Loaded loaded = folder_.load(job.key);
  if (!loaded.why.empty() && !loaded.isRight) {
    const std::lock_guard lock(mutex_);
    warnings_.push_back(loaded.why + "; compiled anew");
  }
  return loaded;
}

void KernelUnits::compile(Job& job, const fs::path& work) {
  const auto start = Clock::now();
  const auto turn = folder_.waitForTurn(job.key, framesStopped);
  if (turn == nullptr) return;
  // Another process may have made it meanwhile.
  job.loaded = folder_.load(job.key);
  if (!job.isReady()) {
    const fs::path source = work / (job.key + ".cpp"), object = work / (job.key + ".so");
    std::ofstream(source) << job.text;
    job.why = compileUnit(compiler_, work, source, object, framesStopped);
    if (job.why.empty()) job.why = folder_.keep(job.key, object);
    if (job.why.empty()) {
      job.loaded = folder_.load(job.key);
      job.why = job.loaded.why;
      if (!job.isReady() && job.why.empty())
        job.why = fmt::format("{}: a unit was deleted as soon as it was made", folder());
    }
  }
  job.timeMs = msSince(start);
}

KernelUnits& kernelUnits() {
  static KernelUnits units(unitCompiler(), UnitFolder::defaultFolder());
  return units;
}

}  // namespace restlab
