// No (key, vertex, dimension) is drawn twice in a frame: two decisions that share a draw are
// correlated, which biases the result in ways that no image shows.
#include "tests/unit/rng_audit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "core/dialect/order.h"
#include "core/method.h"
#include "core/resampling/reservoir.h"
#include "core/scene/compiled_scene.h"
#include "core/scene/scene.h"

namespace restlab::unit {
namespace {

using Draw = std::array<uint32_t, 4>;
std::vector<Draw> recorded;

// The repeated draws of the record, which is emptied.
std::vector<Draw> takeRepeated() {
  std::sort(recorded.begin(), recorded.end());
  std::vector<Draw> repeated;
  for (size_t i = 1; i < recorded.size(); ++i) {
    if (recorded[i] == recorded[i - 1]) repeated.push_back(recorded[i]);
  }
  recorded.clear();
  return repeated;
}

constexpr uint32_t kWidth = 28, kHeight = 20;

// Runs frames of an integrator's passes with their audited kernels, as the session does.
class AuditedRun {
 public:
  AuditedRun(const std::string& sceneName, const std::string& integrator, const std::string& mode,
             const ParameterMap& parameters, std::map<std::string, rl::CpuKernelEntry> audited)
      : scene_(CompiledScene::build(makeBuiltinScene(sceneName))),
        info_(findIntegrator(integrator)),
        audited_(std::move(audited)) {
    const Method method = findMethod(integrator, "", "none");
    const ParameterMap resolved = resolveParameters(method, parameters);
    params_ = info_.packParameters(mode, resolved);
    // What pixels show at their centres, in this view and in the last, which are the same.
    for (size_t i = 0; i < info_.inputs.size(); ++i) {
      storage_.emplace_back(size_t{16} * kWidth * kHeight);
      addresses_.push_back(storage_.back().data());
    }
    addresses_.resize(addresses_.size() + info_.optionalInputs.size(), nullptr);
    own_ = addresses_.size();
    for (const BufferInfo& b : info_.buffers) {
      storage_.emplace_back(bufferBytes(b, resolved, kWidth * kHeight));
      addresses_.push_back(storage_.back().data());
    }
    frame_.camera = scene_->camera(scene_->source().cameras[0], kWidth, kHeight);
    frame_.previousCamera = frame_.camera;
    frame_.width = kWidth;
    frame_.height = kHeight;
    frame_.seed = 5;
    frame_.maxBounces = 6;
    frame_.components = rl::RL_COMPONENT_ALL;
    frame_.rouletteStart = rl::RL_ROULETTE_EARLIEST;
    if (method.cache == nullptr) return;
    rl::CpuKernelCounters counters;
    rl::findCpuKernel("visible", rl::RL_FEATURE_ALL)
        ->entry(arguments(), {0, 0, kWidth, kHeight}, counters);
    std::copy(storage_[0].begin(), storage_[0].end(), storage_[1].begin());
  }

  void frame() {
    rl::CpuKernelCounters counters;
    for (const PassInfo& pass : info_.passes) {
      if (pass.onlyWith != nullptr || (frame_.stillFrames != 0 && pass.onlyOnNewViews)) continue;
      const auto audited = audited_.find(pass.name);
      const rl::CpuKernelEntry entry =
          audited != audited_.end()
              ? audited->second
              : rl::findCpuKernel(pass.kernel.c_str(), rl::RL_FEATURE_ALL)->entry;
      entry(arguments(), {0, 0, kWidth, kHeight}, counters);
    }
    const auto buffers = addresses_.begin() + std::ptrdiff_t(own_);
    for (size_t i = 0; i < info_.buffers.size(); ++i) {
      const int other = info_.buffers[i].swapWith;
      if (other > int(i)) std::swap(buffers[std::ptrdiff_t(i)], buffers[other]);
    }
    ++frame_.frame;
    // Every other frame runs what new views take.
    frame_.stillFrames = frame_.frame % 2;
  }

 private:
  rl::CpuKernelArgs arguments() {
    rl::CpuKernelArgs args;
    args.scene = &scene_->data();
    args.frame = &frame_;
    args.buffers = addresses_.data();
    args.params = params_.data();
    args.embreeScene = scene_->embreeScene();
    return args;
  }

  std::shared_ptr<const CompiledScene> scene_;
  const IntegratorInfo& info_;
  std::map<std::string, rl::CpuKernelEntry> audited_;  // by the name of the pass
  std::vector<std::byte> params_;
  std::vector<std::vector<std::byte>> storage_;
  std::vector<void*> addresses_;
  size_t own_ = 0;  // where the integrator's buffers begin
  rl::FrameData frame_{};
};

void expectNoRepeats(AuditedRun& run, size_t leastDraws, const std::string& what) {
  for (int frame = 0; frame < 4; ++frame) {
    recorded.clear();
    run.frame();
    const size_t draws = recorded.size();
    EXPECT_GT(draws, leastDraws) << what << ", frame " << frame;
    for (const Draw& d : recorded) ASSERT_LT(d[3], rl::RL_DIMENSIONS) << what;
    const std::vector<Draw> repeated = takeRepeated();
    EXPECT_TRUE(repeated.empty()) << what << ", frame " << frame << ": " << repeated.size()
                                  << " of " << draws
                                  << " draws repeat another, the first at vertex " << repeated[0][2]
                                  << ", dimension " << repeated[0][3];
  }
}

TEST(RngAudit, TheRecordFindsARepeatedDraw) {
  recorded.clear();
  auditDraw(1, 2, 3, 4);
  auditDraw(1, 2, 3, 5);
  auditDraw(1, 2, 4, 4);
  auditDraw(2, 1, 3, 4);
  EXPECT_TRUE(takeRepeated().empty());
  auditDraw(1, 2, 3, 4);
  auditDraw(7, 7, 7, 7);
  auditDraw(1, 2, 3, 4);
  EXPECT_EQ(takeRepeated().size(), 1u);
}

TEST(RngAudit, Path) {
  for (const std::string& name : builtinSceneNames()) {
    AuditedRun run(name, "path", "unbiased", {}, {{"path", rl::kernel_path_audited}});
    expectNoRepeats(run, size_t(kWidth) * kHeight, "path, " + name);
  }
}

TEST(RngAudit, Template) {
  for (const std::string& name : builtinSceneNames()) {
    AuditedRun run(name, "template", "unbiased", {}, {{"template", rl::kernel_template_audited}});
    expectNoRepeats(run, size_t(kWidth) * kHeight, "template, " + name);
  }
}

TEST(RngAudit, RestirGi) {
  const std::map<std::string, rl::CpuKernelEntry> passes = {
      {"lights_in_view", rl::kernel_restir_gi_lights_in_view_audited},
      {"initial", rl::kernel_restir_gi_initial_audited},
      {"temporal", rl::kernel_restir_gi_temporal_audited},
      {"exchange", rl::kernel_restir_gi_exchange_audited},
      {"spatial", rl::kernel_restir_gi_spatial_audited}};
  // Every loop over draws runs more than once.
  const ParameterMap busy = {{"light_candidates", int64_t{5}},
                             {"spatial_neighbours", int64_t{rl::RL_MAX_DONORS}}};
  for (const std::string& name : builtinSceneNames()) {
    for (const std::string mode : {"unbiased", "biased"}) {
      AuditedRun plain(name, "restir_gi", mode, {}, passes);
      expectNoRepeats(plain, size_t(kWidth) * kHeight, "restir_gi " + mode + ", " + name);
      AuditedRun loops(name, "restir_gi", mode, busy, passes);
      expectNoRepeats(loops, size_t(kWidth) * kHeight,
                      "restir_gi " + mode + ", long loops, " + name);
    }
  }
}

}  // namespace

void auditDraw(uint32_t keyX, uint32_t keyY, uint32_t vertex, uint32_t dimension) {
  recorded.push_back({keyX, keyY, vertex, dimension});
}

}  // namespace restlab::unit
