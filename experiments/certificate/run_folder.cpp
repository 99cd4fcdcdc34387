#include "experiments/certificate/run_folder.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include "core/backend/stop.h"
#include "core/backend/stop_scope.h"
#include "core/base/error.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/base/interrupt.h"
#include "experiments/runner/base/log.h"
#include "experiments/statistics/image_sum.h"

namespace restlab::certificate {
namespace {

namespace fs = std::filesystem;

// Offsets of the batches' seeds, far enough apart for all runs, and of the batches of the next seed
// that is asked for: another seed gives other runs.
constexpr uint32_t kFirstBatch = 10'000'000, kFreshBatch = 20'000'000, kNextSeed = 40'000'003;
constexpr const char* kHealth = "health";
constexpr const char* kKept = "finished runs are kept; the same command goes on from them";

uint32_t cores() { return std::max(1u, std::thread::hardware_concurrency()); }

// Returns everything that the pixels of the runs depend on, except the number of a run.
std::map<std::string, std::string> wordsOf(const Question& question) {
  std::map<std::string, std::string> words = describe(question.prepared, question.config);
  words["kind"] = "image";
  words["warmup_frames"] = std::to_string(question.warmup);
  words["spp"] = std::to_string(question.frames);
  words["first_seed"] = std::to_string(question.config.seed);
  words["source_hash"] = buildInfo().sourceHash;
  if (!question.change.empty()) words["change"] = question.change;
  std::string lights;
  for (const LightPhase& phase : question.lights)
    lights +=
        fmt::format("{} from frame {}\n", hexHash(phase.prepared.contentHash), phase.firstFrame);
  if (!lights.empty())
    words["lights_by_frame"] = hexHash(XXH3_64bits(lights.data(), lights.size()));
  if (question.motion) {
    std::string cameras;
    for (uint32_t frame = 0; frame < question.warmup + question.frames; ++frame)
      cameras += cameraWords(cameraAt(*question.motion, frame)) + "\n";
    words["cameras"] = hexHash(XXH3_64bits(cameras.data(), cameras.size()));
    describeCamera(cameraAt(*question.motion, question.warmup), words);
  }
  return words;
}

std::string keyOf(const std::map<std::string, std::string>& words) {
  std::string text;
  for (const auto& [key, value] : words) text += fmt::format("{}={}\n", key, value);
  return hexHash(XXH3_64bits(text.data(), text.size()));
}

// Parses counts as HealthSum::text() writes them.
void addHealth(const std::string& text, HealthSum& sum) {
  for (size_t i = 0; i < sum.health.counts.size(); ++i) {
    const char* name = Health::names()[i];
    if (name == nullptr || *name == '\0') continue;
    const std::string start = std::string(name) + "=";
    size_t at = text.find(start);
    while (at != std::string::npos && at > 0 && text[at - 1] != ' ') at = text.find(start, at + 1);
    if (at != std::string::npos)
      sum.health.counts[i] += std::strtoull(text.c_str() + at + start.size(), nullptr, 10);
  }
}

}  // namespace

RunFolder::RunFolder(const Question& question, const fs::path& folder, uint32_t jobs)
    : question_(question), words_(wordsOf(question)), jobs_(jobs == 0 ? cores() : jobs) {
  if (question.config.backend != "cpu") jobs_ = 1;
  folder_ = folder / keyOf(words_);
  makeWritableDirectory(folder_);
}

fs::path RunFolder::file(Batch batch, uint64_t run) const {
  return folder_ / fmt::format("{}-{:05}.exr", batch == Batch::first ? "run" : "fresh", run);
}

uint32_t RunFolder::seedOf(Batch batch, uint64_t run) const {
  return 1 + (question_.config.seed - 1) * kNextSeed +
         (batch == Batch::first ? kFirstBatch : kFreshBatch) + uint32_t(run);
}

void RunFolder::render(Session& session, Batch batch, uint64_t run) {
  session.reset(seedOf(batch, run));
  HealthSum health;
  ImageSum sum;
  for (uint32_t frame = 0; frame < question_.warmup + question_.frames; ++frame) {
    throwIfInterrupted(kKept);
    enterFrame(question_, frame, session);
    health.add(session.frame());
    if (frame >= question_.warmup) sum.add(session.radiance());
  }
  LayeredImage file;
  file.layers[""] = sum.mean();
  file.metadata = words_;
  file.metadata["seed"] = std::to_string(seedOf(batch, run));
  file.metadata[kHealth] = health.text();
  writeExr(this->file(batch, run), file);
}

void RunFolder::make(Batch batch, uint64_t count) {
  std::vector<uint64_t> missing;
  std::error_code status;
  for (uint64_t run = 0; run < count; ++run)
    if (!fs::exists(file(batch, run), status)) missing.push_back(run);
  if (missing.empty()) return;
  const auto workers = uint32_t(std::min<uint64_t>(jobs_, missing.size()));
  SessionConfig config = question_.config;
  if (config.threads == 0) config.threads = int(std::max(1u, cores() / workers));
  Progress progress(batch == Batch::first ? "run" : "fresh run", count, count - missing.size());
  std::atomic<size_t> next{0};
  std::mutex mutex;  // guards done, failure and progress
  uint64_t done = count - missing.size();
  std::exception_ptr failure;
  const auto work = [&, flag = stopFlag()] {
    const StopScope stops(flag);
    try {
      Session session(question_.prepared.scene, config);
      for (size_t i = next++; i < missing.size(); i = next++) {
        render(session, batch, missing[i]);
        const std::lock_guard lock(mutex);
        progress.update(++done);
      }
    } catch (const FrameStopped&) {
      next = missing.size();
      const std::lock_guard lock(mutex);
      failure = std::make_exception_ptr(
          Error(ExitCode::interrupted, fmt::format("interrupted: {}", kKept)));
    } catch (...) {
      next = missing.size();
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> threads;
    for (uint32_t i = 1; i < workers; ++i) threads.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
  progress.finish();
}

void RunFolder::forEach(Batch batch, uint64_t count,
                        const std::function<void(const Image&)>& take) const {
  if (batch == Batch::first) health_ = HealthSum();
  for (uint64_t run = 0; run < count; ++run) {
    const fs::path name = file(batch, run);
    LayeredImage image = readExr(name, {ExrLayers::colours, {""}});
    if (image.metadata["seed"] != std::to_string(seedOf(batch, run))) {
      failInput(fmt::format("{}: is of seed '{}', not {}; delete it, and it is rendered again",
                            name.string(), image.metadata["seed"], seedOf(batch, run)));
    }
    addHealth(image.metadata[kHealth], health_);
    const auto layer = image.layers.find("");
    if (layer == image.layers.end()) {
      failInput(fmt::format("{}: has no R, G, B channels; delete it, and it is rendered again",
                            name.string()));
    }
    take(layer->second);
  }
}

}  // namespace restlab::certificate
