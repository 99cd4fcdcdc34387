#include "experiments/runner/suite/light_events.h"

#include <fmt/format.h>
#include <algorithm>

#include "core/base/error.h"
#include "core/scene/compiled/light_factor.h"
#include "experiments/runner/suite/suite.h"

namespace restlab {

namespace {

constexpr double kMaxFactor = 1e6;

struct FileEvent {
  LightEvent event;
  std::string path;  // "": every path
};

FileEvent readEvent(const ConfigTable& table, const std::vector<SuitePath>& paths) {
  for (const char* key : {"frame", "light", "factor"}) {
    if (!table.has(key)) table.fail("", fmt::format("[[event]] needs '{}'", key));
  }
  FileEvent read;
  // Accept any frame here; checkLightEvents() rejects late frames with a reason.
  read.event.frame = uint32_t(table.getInteger("frame", 0, 0, int64_t(1) << 31));
  read.event.light = table.getString("light", "");
  read.event.place = table.place("light");
  read.event.framePlace = table.place("frame");
  read.event.factor = table.getNumber("factor", 1.0, 0.0, kMaxFactor);
  read.path = table.getString("camera_path", "");
  table.finish();
  std::vector<std::string> names;
  for (const SuitePath& path : paths) names.push_back(path.name);
  if (table.has("camera_path") && std::find(names.begin(), names.end(), read.path) == names.end()) {
    table.fail("camera_path", fmt::format("no [[camera_path]] is named '{}'{}", read.path,
                                          didYouMean(read.path, names)));
  }
  return read;
}

}  // namespace

void readLightEvents(const ConfigTable& root, std::vector<SuitePath>& paths) {
  std::vector<FileEvent> all;
  for (const ConfigTable& table : root.getTables("event")) {
    const FileEvent read = readEvent(table, paths);
    for (const FileEvent& other : all) {
      const bool isSamePath = other.path.empty() || read.path.empty() || other.path == read.path;
      if (isSamePath && other.event.frame == read.event.frame &&
          other.event.light == read.event.light) {
        table.fail("", fmt::format("two events are of the light '{}' at frame {}", read.event.light,
                                   read.event.frame));
      }
    }
    all.push_back(read);
    for (SuitePath& path : paths) {
      if (read.path.empty() || read.path == path.name) path.events.push_back(read.event);
    }
  }
  for (SuitePath& path : paths) {
    std::stable_sort(path.events.begin(), path.events.end(),
                     [](const LightEvent& a, const LightEvent& b) { return a.frame < b.frame; });
  }
}

void checkLightEvents(const ConfigTable& settings, const Suite& suite) {
  for (const LightEvent& event : suite.events) {
    if (event.frame <= suite.warmupFrames) continue;
    failUsage(
        fmt::format("{}: 'frame' is {}: the frames from {} ('warmup_frames') on are "
                    "measured, by one light; a lamp is switched at {} at the latest",
                    event.framePlace, event.frame, suite.warmupFrames, suite.warmupFrames));
  }
  if (suite.accumulate && suite.lightChanges()) {
    settings.fail("accumulate", "'accumulate' is of light that stays: " +
                                    eventsText(suite.events, suite.warmupFrames));
  }
}

std::string eventsText(const std::vector<LightEvent>& events, uint32_t frame) {
  std::string text;
  for (const LightEvent& event : events) {
    if (event.frame > frame) break;
    text += fmt::format("{}{} x{:g} from frame {}", text.empty() ? "" : ", ", event.light,
                        event.factor, event.frame);
  }
  return text;
}

std::vector<LightPhase> lightPhases(const Suite& suite, const PreparedScene& prepared) {
  std::vector<LightPhase> phases;
  if (suite.events.empty()) return phases;
  phases.push_back({0, prepared});
  Scene scene = prepared.scene->source();
  std::vector<std::pair<std::vector<float>, size_t>> known = {{lightFactors(scene), 0}};
  for (size_t i = 0; i < suite.events.size(); ++i) {
    const LightEvent& event = suite.events[i];
    atPlace(event.place, [&] { requireLight(scene, event.light); });
    scene = withLightFactor(std::move(scene), event.light, event.factor);
    if (i + 1 < suite.events.size() && suite.events[i + 1].frame == event.frame) continue;
    LightPhase phase{event.frame, prepared};
    const std::vector<float> factors = lightFactors(scene);
    const auto same = std::find_if(known.begin(), known.end(),
                                   [&](const auto& other) { return other.first == factors; });
    std::shared_ptr<const CompiledScene> compiled;
    if (same != known.end()) {
      compiled = phases[same->second].prepared.scene;
    } else {
      compiled = CompiledScene::build(scene);
      known.emplace_back(factors, phases.size());
    }
    phase.prepared = withLights(prepared, compiled, eventsText(suite.events, event.frame));
    phases.push_back(std::move(phase));
  }
  return phases;
}

const PreparedScene& sceneAt(const std::vector<LightPhase>& phases, const PreparedScene& prepared,
                             uint32_t frame) {
  const PreparedScene* found = &prepared;
  for (const LightPhase& phase : phases) {
    if (phase.firstFrame <= frame) found = &phase.prepared;
  }
  return *found;
}

}  // namespace restlab
