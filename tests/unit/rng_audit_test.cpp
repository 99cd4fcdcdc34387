// No (key, vertex, dimension) is drawn twice in a frame: two decisions that share a draw are
// correlated, which biases the result in ways that no image shows.
#include "tests/unit/rng_audit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <vector>

#include "core/dialect/order.h"
#include "core/frame/frame_graph.h"
#include "core/frame/method.h"
#include "core/resampling/reservoir.h"
#include "core/scene/compiled/compiled_scene.h"
#include "core/scene/scene.h"
#include "tests/bias/few_entries.h"
#include "tests/varied_scenes.h"

namespace restlab::unit {
namespace {

using Draw = std::array<uint32_t, 4>;
std::vector<Draw> recorded;

// Returns the repeated draws of the record, and empties it.
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

struct Audited {
  const char* integrator;
  const char* mode;
  std::map<std::string, rl::CpuKernelEntry> kernels;  // by name of the pass
  const char* cache = "";                             // "": the first one
  ParameterMap parameters = {};
};

// Runs the passes of a cache and an integrator frame by frame with their audited kernels, as a
// session does.
class AuditedRun {
 public:
  AuditedRun(const std::string& sceneName, const Audited& audited)
      : scene_(CompiledScene::build(makeBuiltinScene(sceneName))), kernels_(audited.kernels) {
    const Method method = findMethod(audited.integrator, audited.cache, "none");
    resolved_ = resolveParameters(method, audited.parameters);
    frame_.camera = scene_->camera(scene_->source().cameras[0], kWidth, kHeight);
    frame_.previousCamera = frame_.camera;
    frame_.width = kWidth;
    frame_.height = kHeight;
    frame_.seed = 5;
    frame_.maxBounces = 6;
    frame_.components = rl::RL_COMPONENT_ALL;
    frame_.rouletteStart = rl::RL_ROULETTE_EARLIEST;
    mode_ = audited.mode;
    surfaces_.record = [](FrameGraph& g, const FrameInfo& f) {
      g.shared.surfaces = {g.buffer("gbuffer", f.pixels, 16),
                           g.buffer("gbuffer_previous", f.pixels, 16)};
    };
    parts_ = {&surfaces_};
    for (const PartInfo* part : method.parts())
      if (part != method.denoiser) parts_.push_back(part);
    record();
    // The surfaces are the same in this view and in the last.
    if (method.cache == nullptr) return;
    const std::array<void*, 2> seen = {words_[0].data(), nullptr};
    const uint32_t padding = 0;
    call(rl::findCpuKernel("gbuffer", rl::RL_FEATURE_ALL)->entry, seen.data(), &padding, pixels());
    words_[1] = words_[0];
  }

  AuditedRun(const AuditedRun&) = delete;
  AuditedRun& operator=(const AuditedRun&) = delete;

  void frame() {
    record();
    for (const size_t pass : graph_.order()) run(graph_.passes()[pass]);
    ++frame_.frame;
    // Every other frame is of a still view.
    frame_.stillFrames = frame_.frame % 2;
  }

 private:
  static rl::CpuKernelTile pixels() { return {0, 0, kWidth, kHeight}; }

  void record() {
    graph_.record(parts_, {mode_, resolved_, kWidth * kHeight, frame_.stillFrames == 0, false,
                           scene_.get(), frame_.frame, frame_.frame});
    words_.resize(graph_.buffers().size());
    for (size_t i = 0; i < words_.size(); ++i) {
      const GraphBuffer& buffer = graph_.buffers()[i];
      if (buffer.contents && words_[i].empty()) words_[i] = *buffer.contents;
      words_[i].resize(buffer.bytes() / sizeof(uint32_t));
    }
  }

  void run(const GraphPass& pass) {
    std::vector<void*> addresses;
    for (size_t slot = 0; slot < pass.slots.size(); ++slot) {
      const Buffer buffer = pass.bound(slot);
      addresses.push_back(buffer ? words_[buffer.index].data() : nullptr);
    }
    rl::CpuKernelTile tile = pixels();
    if (pass.entries != 0)
      tile = {0, 0, rl::RL_ENTRY_ROW, (pass.entries + rl::RL_ENTRY_ROW - 1) / rl::RL_ENTRY_ROW};
    const auto audited = kernels_.find(pass.name);
    call(audited != kernels_.end()
             ? audited->second
             : rl::findCpuKernel(pass.kernel.c_str(), rl::RL_FEATURE_ALL)->entry,
         addresses.data(), pass.params.data(), tile);
  }

  void call(rl::CpuKernelEntry entry, const void* buffers, const void* params,
            const rl::CpuKernelTile& tile) {
    rl::CpuKernelArgs args;
    args.scene = &scene_->data();
    args.frame = &frame_;
    args.buffers = buffers;
    args.params = params;
    args.embreeScene = scene_->embreeScene();
    rl::CpuKernelCounters counters;
    entry(args, tile, counters);
  }

  std::shared_ptr<const CompiledScene> scene_;
  std::map<std::string, rl::CpuKernelEntry> kernels_;
  ParameterMap resolved_;
  std::string mode_;
  PartInfo surfaces_;  // leaves the surfaces at pixel centres
  std::vector<const PartInfo*> parts_;
  FrameGraph graph_;
  std::vector<std::vector<uint32_t>> words_;  // by buffer of the graph
  rl::FrameData frame_{};
};

// (vertex, dimension) pairs that were drawn.
using Kinds = std::set<std::pair<uint32_t, uint32_t>>;

Kinds expectNoRepeats(AuditedRun run, const std::string& what) {
  Kinds kinds;
  for (int frame = 0; frame < 4; ++frame) {
    recorded.clear();
    run.frame();
    const size_t draws = recorded.size();
    EXPECT_GT(draws, size_t(kWidth) * kHeight) << what << ", frame " << frame;
    for (const Draw& d : recorded) {
      EXPECT_LT(d[3], rl::RL_DIMENSIONS) << what;
      kinds.insert({d[2], d[3]});
    }
    const std::vector<Draw> repeated = takeRepeated();
    EXPECT_TRUE(repeated.empty()) << what << ", frame " << frame << ": " << repeated.size()
                                  << " of " << draws
                                  << " draws repeat another, the first at vertex " << repeated[0][2]
                                  << ", dimension " << repeated[0][3];
  }
  return kinds;
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

const std::map<std::string, rl::CpuKernelEntry> kRestirKernels = {
    {"light_edges", rl::kernel_restir_gi_light_edges_audited},
    {"initial", rl::kernel_restir_gi_initial_audited},
    {"replay", rl::kernel_changes_trace_audited},
    {"temporal", rl::kernel_restir_gi_temporal_audited},
    {"spatial_shift", rl::kernel_restir_gi_spatial_shift_audited},
    {"spatial", rl::kernel_restir_gi_spatial_audited},
    {"round_1", rl::kernel_restir_gi_spatial_audited},
    {"round_1_shift", rl::kernel_restir_gi_spatial_shift_audited},
    {"cache_reuse", rl::kernel_restir_gi_cache_reuse_audited},
    {"cache_update", rl::kernel_restir_gi_cache_update_audited},
    {"surflet_propose", rl::kernel_surflet_propose_audited},
    {"voxel_propose", rl::kernel_voxel_propose_audited}};

TEST(RngAudit, Path) {
  for (const std::string& name : test::variedScenes()) {
    expectNoRepeats({name, {"path", "unbiased", {{"path", rl::kernel_path_audited}}}},
                    "path, " + name);
  }
}

// Every pixel requests a ray, which the next frame traces beside the pixel's own.
TEST(RngAudit, PathsThatEnd) {
  const ParameterMap ending = {{"secondary", std::string("cache")},
                               {"radiance_entries", int64_t{4096}},
                               {"radiance_every", int64_t{1}}};
  const std::map<std::string, rl::CpuKernelEntry> kernels = {
      {"path", rl::kernel_path_audited}, {"radiance_trace", rl::kernel_radiance_trace_audited}};
  for (const std::string& name : test::variedScenes())
    expectNoRepeats({name, {"path", "unbiased", kernels, "", ending}}, "path that ends, " + name);
}

TEST(RngAudit, Template) {
  for (const std::string& name : test::variedScenes()) {
    expectNoRepeats({name, {"template", "unbiased", {{"template", rl::kernel_template_audited}}}},
                    "template, " + name);
  }
}

TEST(RngAudit, Bdpt) {
  for (const std::string& name : test::variedScenes())
    expectNoRepeats({name, {"bdpt", "unbiased", {{"bdpt", rl::kernel_bdpt_audited}}}},
                    "bdpt, " + name);
}

TEST(RngAudit, Local) {
  // Make every loop over draws run more than once.
  const ParameterMap busy = {{"light_samples", int64_t{5}},
                             {"occlusion", std::string("rays")},
                             {"occlusion_rays", int64_t{3}},
                             {"ambient", 1.0},
                             {"reflections", std::string("glossy")}};
  // Points on the screen, and a sample of each light, also in reflections.
  ParameterMap ofScreen = busy;
  ofScreen["light_samples"] = int64_t{0};
  ofScreen["occlusion"] = std::string("screen");
  ofScreen["ambient_share"] = 0.1;
  ofScreen["shadows"] = std::string("map");
  ofScreen["shadow_map_size"] = int64_t{8};
  for (const std::string& name : test::variedScenes()) {
    for (const char* shading : {"phong", "gouraud", "flat"}) {
      for (const ParameterMap& parameters : {busy, ofScreen}) {
        Audited audited{"local", "biased", {{"local", rl::kernel_local_audited}}, "", parameters};
        audited.parameters["shading"] = std::string(shading);
        expectNoRepeats({name, audited}, std::string("local, ") + shading + ", " + name);
      }
    }
  }
}

// All draws are those of the first frame, when it solves.
TEST(RngAudit, Radiosity) {
  const std::map<std::string, rl::CpuKernelEntry> kernels = {
      {"factors", rl::kernel_radiosity_rays_audited},
      {"direct", rl::kernel_radiosity_direct_audited}};
  const ParameterMap few = {{"elements", int64_t{64}}, {"factor_rays", int64_t{64}}};
  AuditedRun run("cornell-box", {"radiosity", "biased", kernels, "", few});
  recorded.clear();
  run.frame();
  EXPECT_GT(recorded.size(), size_t{10000});
  EXPECT_TRUE(takeRepeated().empty());
}

TEST(RngAudit, RestirGi) {
  // Make every loop over draws run more than once.
  const ParameterMap busy = {{"light_candidates", int64_t{5}},
                             {"validate_every", int64_t{1}},
                             {"spatial_neighbours", int64_t{rl::RL_MAX_DONORS}},
                             {"spatial_rounds", int64_t{2}}};
  for (const std::string& name : test::variedScenes()) {
    for (const std::string mode : {"unbiased", "biased"}) {
      Audited audited{"restir_gi", mode.c_str(), kRestirKernels};
      expectNoRepeats({name, audited}, "restir_gi " + mode + ", " + name);
      audited.parameters = busy;
      expectNoRepeats({name, audited}, "restir_gi " + mode + ", long loops, " + name);
    }
  }
}

// Its other passes draw as those of restir_gi do: they are the same files.
TEST(RngAudit, RestirDi) {
  const std::map<std::string, rl::CpuKernelEntry> kernels = {
      {"initial", rl::kernel_restir_di_initial_audited}};
  for (const std::string& name : test::variedScenes())
    expectNoRepeats({name, {"restir_di", "unbiased", kernels}}, "restir_di, " + name);
}

// With the maximal number of donors and offers, the passes of entries draw beside those of pixels.
TEST(RngAudit, RestirGiWithEntries) {
  const ParameterMap busy = {{"light_candidates", int64_t{2}},
                             {"spatial_neighbours", int64_t{rl::RL_MAX_DONORS}},
                             {"entries", int64_t{4096}},
                             {"entry_proposals", int64_t{rl::RL_MAX_DONORS}},
                             {"feed_every", int64_t{1}}};
  for (const std::string& name : test::variedScenes()) {
    if (name == "media") continue;  // no surface whose paths can be exchanged
    for (const std::string& cache : bias::cachesWithEntries()) {
      ASSERT_TRUE(kRestirKernels.contains(cache + "_propose")) << "it draws, and is not audited";
      const std::string what = std::string("restir_gi with ") + cache + ", " + name;
      const Kinds kinds = expectNoRepeats(
          {name, {"restir_gi", "unbiased", kRestirKernels, cache.c_str(), busy}}, what);
      using namespace rl;
      EXPECT_TRUE(kinds.contains({RL_VERTEX_CACHE_REUSE, RL_DIM_FILTER_X})) << what;
      for (uint32_t k = 0; k < RL_MAX_DONORS; ++k) {
        EXPECT_TRUE(kinds.contains({RL_VERTEX_CACHE_REUSE, RL_DIM_RIS_MERGE + k})) << what;
        EXPECT_TRUE(kinds.contains({RL_VERTEX_CACHE_UPDATE, RL_DIM_RIS_MERGE + k})) << what;
      }
      for (uint32_t k = 1; k < RL_MAX_DONORS; ++k) {
        EXPECT_TRUE(kinds.contains({RL_VERTEX_SPATIAL + k, RL_DIM_DONOR_U})) << what;
        EXPECT_TRUE(kinds.contains({RL_VERTEX_SPATIAL + k, RL_DIM_DONOR_V})) << what;
      }
    }
  }
}

}  // namespace

void auditDraw(uint32_t keyX, uint32_t keyY, uint32_t vertex, uint32_t dimension) {
  recorded.push_back({keyX, keyY, vertex, dimension});
}

}  // namespace restlab::unit
