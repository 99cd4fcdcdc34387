// The frame in code: what parts record is what runs.
#include "core/frame/frame_graph.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/frame/method.h"
#include "core/scene/compiled/compiled_scene.h"
#include "core/scene/scene.h"
#include "core/gbuffer/view_parts.h"

namespace restlab::unit {
namespace {

struct TwoBuffers {
  uint64_t first, second;
};

struct Recording {
  FrameGraph graph;
  ParameterMap parameters;
  std::string mode;
  PartInfo part;

  explicit Recording(std::function<void(FrameGraph&, const FrameInfo&)> record) {
    part.name = "part";
    part.record = std::move(record);
  }
  void frame(bool isNewView = true) { graph.record({&part}, {mode, parameters, 6, isNewView}); }
};

TEST(FrameGraph, AHistoryTakesTurnsEachTimeItAdvances) {
  std::vector<History> seen;
  Recording recording([&](FrameGraph& g, const FrameInfo& f) {
    History history = g.history("light", f.pixels, 16);
    if (f.isNewView) history = g.advance(history);
    seen.push_back(history);
  });
  recording.frame();
  EXPECT_EQ(recording.graph.find("light"), seen[0].now);
  EXPECT_EQ(recording.graph.find("light_previous"), seen[0].previous);
  recording.frame();
  EXPECT_EQ(seen[1].previous, seen[0].now);
  EXPECT_EQ(seen[1].now, seen[0].previous);
  recording.frame(false);
  EXPECT_EQ(seen[2].now, seen[1].now);
  EXPECT_EQ(recording.graph.find("light"), seen[1].now);
  EXPECT_EQ(recording.graph.buffers().size(), 2u) << "the same buffers in every frame";
}

TEST(FrameGraph, AKernelFindsDeclaredBuffersAlone) {
  Recording recording([](FrameGraph& g, const FrameInfo& f) {
    const Buffer a = g.buffer("a", f.pixels, 4), b = g.buffer("b", f.groups(4), 4);
    g.kernels<TwoBuffers>(uint32_t{7}, {a, b}).pass("write", "kernel").writes({b});
    g.kernels<TwoBuffers>(uint32_t{7}, {a, b}).pass("change", "kernel").over(2).updates({a});
  });
  recording.frame();
  const std::vector<GraphPass>& passes = recording.graph.passes();
  ASSERT_EQ(passes.size(), 2u);
  EXPECT_FALSE(passes[0].bound(0));
  EXPECT_EQ(passes[0].bound(1), recording.graph.find("b"));
  EXPECT_EQ(passes[1].bound(0), recording.graph.find("a"));
  EXPECT_EQ(passes[1].read, passes[1].written);
  EXPECT_EQ(passes[1].entries, 2u);
  EXPECT_EQ(recording.graph.buffers()[1].bytes(), 8u) << "two groups of up to four pixels";
}

TEST(FrameGraph, ABufferOfNoElementsIsNotThere) {
  Recording recording([](FrameGraph& g, const FrameInfo&) {
    const Buffer none = g.buffer("none", 0, 4);
    EXPECT_FALSE(none);
    g.kernels<TwoBuffers>(uint32_t{0}, {none, none}).pass("idle", "kernel").reads({none});
  });
  recording.frame();
  EXPECT_TRUE(recording.graph.buffers().empty());
  EXPECT_FALSE(recording.graph.find("none"));
}

TEST(FrameGraph, MistakesOfARecordingAreNamed) {
  const auto expectRefused = [](const std::function<void(FrameGraph&)>& mistake,
                                const std::string& word) {
    Recording recording([&](FrameGraph& g, const FrameInfo&) { mistake(g); });
    try {
      recording.frame();
      ADD_FAILURE() << "taken: " << word;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  expectRefused(
      [](FrameGraph& g) {
        g.buffer("twice", 1, 4);
        g.buffer("twice", 1, 8);
      },
      "'twice' is declared twice");
  expectRefused(
      [](FrameGraph& g) {
        const Kernels kernels = g.kernels<TwoBuffers>(uint32_t{0}, {Buffer{}, Buffer{}});
        kernels.pass("blur", "kernel");
        kernels.pass("blur", "kernel");
      },
      "pass blur");
  expectRefused(
      [](FrameGraph& g) {
        g.kernels<TwoBuffers>(uint32_t{0}, {Buffer{}, Buffer{}}).pass("idle", "kernel").over(0);
      },
      "pass idle: runs over no element");
  expectRefused([](FrameGraph& g) { g.kernels<TwoBuffers>(uint32_t{0}, {Buffer{}}); },
                "1 buffers for the 2 slots");
  expectRefused(
      [](FrameGraph& g) {
        const Buffer a = g.buffer("a", 1, 4), b = g.buffer("b", 1, 4);
        g.kernels<TwoBuffers>(uint32_t{0}, {a, Buffer{}}).pass("stray", "kernel").reads({b});
      },
      "pass stray");
}

// Passes of a still view are among those of a new view, in the same order: tables of times have one
// column for each.
TEST(FrameGraph, AStillViewLeavesPassesOut) {
  const auto scene = CompiledScene::build(makeBuiltinScene("cornell-box"));
  for (const IntegratorInfo* integrator : integratorRegistry()) {
    for (const DenoiserInfo* denoiser : denoiserRegistry()) {
      for (const CacheInfo* cache : cacheRegistry()) {
        const std::string name = integrator->usesCache ? cache->name : "";
        const Method method = findMethod(integrator->name, name, denoiser->name);
        ParameterMap given;
        if (integrator->endsPaths) given["secondary"] = std::string("cache");
        if (integrator->followsChanges || denoiser->followsChanges)
          given["validate_every"] = int64_t{8};
        const ParameterMap parameters = resolveParameters(method, given);
        FrameGraph graph;
        const auto names = [&](bool isNewView) {
          graph.record(withViewParts(method.parts()),
                       {integrator->modes.front().name, parameters, 64, isNewView, false,
                        scene.get(), isNewView ? 0u : 1u, isNewView ? 0u : 1u});
          std::vector<std::string> all;
          for (const GraphPass& pass : graph.passes()) all.push_back(pass.name);
          return all;
        };
        const std::vector<std::string> moving = names(true), still = names(false);
        auto at = moving.begin();
        for (const std::string& pass : still) {
          at = std::find(at, moving.end(), pass);
          ASSERT_NE(at, moving.end()) << integrator->name << " " << name << " " << pass;
          ++at;
        }
      }
    }
  }
}

// Records a frame with a history `light` and a buffer `scratch` that is written late, shares
// memory, and returns whether the last frame's light lends its memory.
struct Lending {
  bool advancesInStillView = true;
  bool readsBeforeLate = false;  // reads the last frame's light after the scratch is written
  bool updatesNow = false;       // this frame's light depends on what its memory held
  bool readsBeforeInStill = false;
  uint32_t scratchBytes = 16;

  bool lends() const {
    const auto record = [this](FrameGraph& g, const FrameInfo& f) {
      History light = g.history("light", f.pixels, 16);
      if (f.isNewView || advancesInStillView) light = g.advance(light);
      const Buffer scratch = g.transient("scratch", f.pixels, scratchBytes);
      struct Slots {
        uint64_t now, before, scratch;
      };
      const Kernels kernels = g.kernels<Slots>(uint32_t{0}, {light.now, light.previous, scratch});
      if (f.isNewView || advancesInStillView) {
        GraphPass& shade = kernels.pass("shade", "shade").reads({light.previous});
        updatesNow ? shade.updates({light.now}) : shade.writes({light.now});
      } else if (readsBeforeInStill) {
        kernels.pass("again", "again").reads({light.previous});
      }
      kernels.pass("mark", "mark").reads({light.now}).writes({scratch});
      if (readsBeforeLate) kernels.pass("late", "late").reads({light.previous});
    };
    Recording recording(record);
    recording.frame();
    Recording still = recording;
    still.frame(false);
    recording.graph.shareMemory(still.graph);
    const Buffer scratch = recording.graph.find("scratch");
    const Buffer lender = recording.graph.lenderOf(scratch);
    EXPECT_FALSE(recording.graph.lenderOf(recording.graph.find("light")));
    if (!lender) return false;
    EXPECT_EQ(lender, recording.graph.find("light_previous"));
    recording.frame();
    EXPECT_EQ(recording.graph.lenderOf(scratch), recording.graph.find("light_previous"));
    return true;
  }
};

TEST(FrameGraph, ABufferSharesMemoryOfAHistoryThatIsReadNoMore) {
  EXPECT_TRUE(Lending{}.lends());
  EXPECT_TRUE(Lending{.advancesInStillView = false}.lends());
  EXPECT_TRUE(Lending{.scratchBytes = 12}.lends());
  EXPECT_FALSE(Lending{.readsBeforeLate = true}.lends());
  EXPECT_FALSE(Lending{.updatesNow = true}.lends());
  EXPECT_FALSE((Lending{.advancesInStillView = false, .readsBeforeInStill = true}.lends()));
  EXPECT_FALSE(Lending{.scratchBytes = 20}.lends());
}

}  // namespace
}  // namespace restlab::unit
