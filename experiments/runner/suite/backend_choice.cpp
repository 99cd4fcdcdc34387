#include "experiments/runner/suite/backend_choice.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/runner/base/log.h"

namespace restlab {

const std::vector<std::string>& rayTracingNames() {
  static const std::vector<std::string> names = {"embree", "bvh", "query"};
  return names;
}

bool mayTraceBy(const std::string& backend, const std::string& rayTracing) {
  return rayTracing == "bvh" || rayTracing == (backend == "cpu" ? "embree" : "query");
}

DeviceUse deviceUseOf(const Session& session) {
  return {session.config().backend, session.device(), session.rayTracing()};
}

void StartupLog::add(const Session& session, const StartupReport& before) {
  const StartupReport& report = session.startup();
  for (size_t i = before.notices.size(); i < report.notices.size(); ++i) {
    const std::string& notice = report.notices[i];
    if (std::find(notices_.begin(), notices_.end(), notice) == notices_.end())
      notices_.push_back(notice);
  }
  if (report.kernels.size() <= before.kernels.size()) return;
  const DeviceUse use = deviceUseOf(session);
  auto entry = std::find_if(entries_.begin(), entries_.end(),
                            [&](const Entry& known) { return known.use == use; });
  if (entry == entries_.end()) entry = entries_.insert(entries_.end(), {use, {}});
  entry->kernels.insert(entry->kernels.end(),
                        report.kernels.begin() + std::ptrdiff_t(before.kernels.size()),
                        report.kernels.end());
  entry->timeMs += report.timeMs - before.timeMs;
}

void StartupLog::print() {
  for (const std::string& notice : notices_) logWarning(notice);
  notices_.clear();
  for (const Entry& entry : entries_) {
    size_t stored = 0;
    for (const KernelReport& kernel : entry.kernels) {
      stored += kernel.fromDisk ? 1 : 0;
      logDetail(fmt::format("kernel {} ({}): {} {:.0f} ms, driver {:.0f} ms", kernel.kernel,
                            featureNames(kernel.mask),
                            kernel.fromDisk ? "from the cache" : "compiled", kernel.compileMs,
                            kernel.driverMs));
    }
    const bool isNothingNew = entry.use.backend == "cpu" && stored == entry.kernels.size();
    (isNothingNew ? logDetail : logInfo)(fmt::format(
        "{}: {} kernel{} ready in {:.2g} s{} on {}", entry.use.backend, entry.kernels.size(),
        entry.kernels.size() == 1 ? "" : "s", entry.timeMs / 1000.0,
        stored > 0 ? fmt::format(" ({} from the cache)", stored) : "", entry.use.device));
  }
  entries_.clear();
}

void logStartup(const Session& session) {
  StartupLog log;
  log.add(session);
  log.print();
}

}  // namespace restlab
