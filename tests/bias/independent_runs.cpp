#include "tests/bias/independent_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <stdexcept>

namespace restlab::bias {
namespace {

// Batches of one method, methods and truths never share a seed.
constexpr uint32_t kFirstBatch = 10'000'000, kSecondBatch = 20'000'000, kPart = 100'000'000;

// Returns the cell with the largest |t|, which may be far from significant.
const stats::CellVerdict* worstCell(const stats::BiasReport& report) {
  const stats::CellVerdict* worst = nullptr;
  for (const stats::CellVerdict& v : report.cells) {
    if (v.testable && (worst == nullptr || std::abs(v.welch.t) > std::abs(worst->welch.t))) {
      worst = &v;
    }
  }
  return worst;
}

// Renders a history and adds its compared frames to `shown`.
void addHistory(Session& session, const Method& method, Image& shown) {
  const float weight = 1.0f / float(method.frames - method.skipped);
  for (uint32_t frame = 0; frame < method.frames; ++frame) {
    if (!method.cameras.empty()) {
      session.setCamera(method.cameras[std::min<size_t>(frame, method.cameras.size() - 1)]);
    }
    if (method.before) method.before(session, frame);
    session.frame();
    if (frame < method.skipped) continue;
    const Image& radiance = session.radiance();
    for (size_t p = 0; p < shown.pixels.size(); ++p) shown.pixels[p] += radiance.pixels[p] * weight;
  }
}

}  // namespace

Method pathMethod(uint32_t frames) {
  Method m;
  m.name = "path";
  m.config.integrator = "path";
  m.config.width = kWidth;
  m.config.height = kHeight;
  m.config.threads = 1;
  m.frames = frames;
  return m;
}

Method restirMethod(uint32_t frames, uint32_t skipped, const ParameterMap& parameters,
                    const std::string& integrator) {
  Method m = pathMethod(frames);
  m.name = integrator + " unbiased";
  m.config.integrator = integrator;
  m.config.mode = "unbiased";
  m.config.parameters = parameters;
  m.skipped = skipped;
  return m;
}

std::shared_ptr<const CompiledScene> builtinScene(const std::string& name) {
  static std::map<std::string, std::shared_ptr<const CompiledScene>> scenes;
  std::shared_ptr<const CompiledScene>& scene = scenes[name];
  if (!scene) scene = CompiledScene::build(makeBuiltinScene(name));
  return scene;
}

uint32_t seedOffset() {
  constexpr uint32_t kLargest = 8, kStep = 1'000'000;  // all offsets stay below the first batch
  const char* text = std::getenv("RESTLAB_TEST_SEED");
  if (text == nullptr || *text == '\0') return 0;
  if (text[0] < '0' || text[0] > char('0' + kLargest) || text[1] != '\0') {
    throw std::invalid_argument(fmt::format("RESTLAB_TEST_SEED is '{}', not 0 to 8", text));
  }
  return uint32_t(text[0] - '0') * kStep;
}

stats::RunSet independentRuns(const std::shared_ptr<const CompiledScene>& scene,
                              const Method& method, uint32_t firstSeed, size_t runs) {
  return independentSums(scene, {method}, firstSeed, runs);
}

namespace {

void forEachSum(const std::shared_ptr<const CompiledScene>& scene,
                const std::vector<Method>& methods, uint32_t firstSeed, size_t runs,
                const std::function<void(const Image&)>& take) {
  const SessionConfig& config = methods.at(0).config;
  std::vector<std::unique_ptr<Session>> sessions;
  for (const Method& m : methods) sessions.push_back(std::make_unique<Session>(scene, m.config));
  const uint32_t first = firstSeed + seedOffset();
  for (size_t run = 0; run < runs; ++run) {
    Image shown(config.width, config.height);
    for (size_t i = 0; i < methods.size(); ++i) {
      // Far from the seeds of the other parts.
      sessions[i]->reset(first + uint32_t(run) + uint32_t(i) * kPart);
      addHistory(*sessions[i], methods[i], shown);
    }
    take(shown);
  }
}

}  // namespace

void forEachRun(const std::shared_ptr<const CompiledScene>& scene, const Method& method,
                uint32_t firstSeed, size_t runs, const std::function<void(const Image&)>& take) {
  forEachSum(scene, {method}, firstSeed, runs, take);
}

stats::RunSet independentSums(const std::shared_ptr<const CompiledScene>& scene,
                              const std::vector<Method>& methods, uint32_t firstSeed, size_t runs) {
  const SessionConfig& config = methods.at(0).config;
  stats::RunSet set(stats::BlockGrid(config.width, config.height));
  forEachSum(scene, methods, firstSeed, runs, [&](const Image& image) { set.add(image); });
  return set;
}

stats::BiasReport testMethod(const std::shared_ptr<const CompiledScene>& scene,
                             const Method& method, const stats::Truth& truth, size_t runs,
                             const stats::BiasOptions& options) {
  const stats::RunSet first = independentRuns(scene, method, kFirstBatch, runs);
  const stats::BiasReport report = stats::testBias(
      first, truth, options, [&] { return independentRuns(scene, method, kSecondBatch, runs); });
  std::printf("%s\n", describe(scene->source().name + ", " + method.name, report).c_str());
  std::fflush(stdout);
  return report;
}

std::string describe(const std::string& name, const stats::BiasReport& report) {
  std::string text = fmt::format("{}: {}", name, report.text());
  if (const stats::CellVerdict* v = worstCell(report)) {
    text += fmt::format("\n  worst cell: blocks x {} y {} size {}, {:+.2f} %, t {:.2f}", v->area.x,
                        v->area.y, v->area.size, 100.0 * v->welch.difference / v->reference,
                        v->welch.t);
  }
  return text;
}

}  // namespace restlab::bias
