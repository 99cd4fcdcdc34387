// Rules for every cache with entries: pixels find their surfaces again, in any order of the pixels;
// pixels without a place are counted; entries in view stay, the entry unseen for longest is
// replaced; samples come from pixels that see the entry.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/caches/entries/settings.h"
#include "tests/bias/few_entries.h"
#include "tests/conformance/cache_run.h"

namespace restlab::conformance {
namespace {

class CacheEntries : public testing::TestWithParam<std::string> {
 protected:
  CacheRun make(glm::uvec2 size, int64_t entries) const {
    return CacheRun(GetParam(), size, {{kEntryCount, entries}});
  }
};

Shown wall(glm::uvec2) { return {}; }
Shown nothing(glm::uvec2) { return {0.0f}; }

size_t proposed(const CacheRun& run) {
  size_t count = 0;
  for (uint32_t slot = 0; slot < run.pixels(); ++slot) {
    const auto words = run.entry("proposals", slot, run.entries().proposals);
    count += std::any_of(words.begin(), words.end(),
                         [](uint32_t entry) { return entry != rl::RL_INVALID; });
  }
  return count;
}

// Runs equal frames on two caches, one by a single thread in order, the other by seven threads in
// other orders: every buffer must have the same words.
void expectSameByOneAndByMany(CacheRun& one, CacheRun& many, uint32_t frames) {
  for (uint32_t frame = 0; frame < frames; ++frame) {
    one.frame(true, 1, 0);
    many.frame(true, 7, 100 + frame);
    for (const auto& [name, words] : one.buffers())
      EXPECT_TRUE(words == many.words(name)) << name << ", frame " << frame;
  }
}

size_t anchored(const CacheRun& run) {
  size_t count = 0;
  for (uint32_t entry = 0; entry < run.entries().count; ++entry)
    count += run.hasShadingPoint(entry);
  return count;
}

TEST_P(CacheEntries, WhatIsSeenIsFoundAgain) {
  CacheRun run = make({96, 64}, 8192);
  run.look(wall);
  run.frame();
  EXPECT_EQ(proposed(run), 0u) << "nothing is remembered yet";
  for (int i = 0; i < 6; ++i) run.frame();
  // A pixel that loses two claims in a row waits for the next frame.
  EXPECT_LT(run.full(), run.pixels() / 100);
  EXPECT_GT(double(proposed(run)), 0.98 * run.pixels());
  for (uint32_t slot = 0; slot < run.pixels(); ++slot) {
    for (const uint32_t entry : run.entry("proposals", slot, run.entries().proposals)) {
      if (entry == rl::RL_INVALID) continue;
      ASSERT_LT(entry, run.entries().count);
      EXPECT_TRUE(run.hasShadingPoint(entry));
      // Discs have a radius of six pixels of 0.25 metres and are searched within 1.5 radii.
      EXPECT_LT(glm::distance(run.posW(slot), run.anchorPosW(entry)), 2.5f * 1.5f) << slot;
    }
  }
}

TEST_P(CacheEntries, ProposalsOfAPixelDiffer) {
  CacheRun run = make({96, 64}, 8192);
  run.look(wall);
  for (int i = 0; i < 6; ++i) run.frame();
  for (uint32_t slot = 0; slot < run.pixels(); ++slot) {
    std::vector<uint32_t> all = run.entry("proposals", slot, run.entries().proposals);
    std::erase(all, rl::RL_INVALID);
    EXPECT_EQ(std::set<uint32_t>(all.begin(), all.end()).size(), all.size());
  }
}

// 10^6 pixels claim entries.
TEST_P(CacheEntries, TheOrderOfPixelsDoesNotMatter) {
  CacheRun one = make({1000, 1000}, 1 << 17), many = make({1000, 1000}, 1 << 17);
  const auto waves = [](glm::uvec2 p) {
    return Shown{10.0f + 4.0f * std::sin(float(p.x) * 0.1f) * std::cos(float(p.y) * 0.07f),
                 {std::sin(float(p.x)), 0.3f, 1.0f}};
  };
  one.look(waves);
  many.look(waves);
  expectSameByOneAndByMany(one, many, 2);
  EXPECT_GT(anchored(one), 1000u);
}

TEST_P(CacheEntries, WhatHasNoPlaceIsCounted) {
  CacheRun run = make({256, 256}, 1024);
  run.look(wall);
  run.frame();
  run.frame();
  EXPECT_GT(run.full(), 1000u);
  EXPECT_GT(proposed(run), 1000u);
  // Entries in view stay.
  const std::vector<uint32_t> before = run.words("shading_points");
  for (int i = 0; i < 4; ++i) run.frame();
  for (uint32_t entry = 0; entry < run.entries().count; ++entry) {
    const size_t at = size_t{4} * rl::RL_SHADING_POINT_UVEC4S * entry;
    if (before[at + 6] >> 30u == 0) continue;
    EXPECT_EQ(run.words("shading_points")[at], before[at]);
  }
}

TEST_P(CacheEntries, ItRemembersWhatIsOutOfView) {
  CacheRun run = make({64, 64}, 8192);
  run.look(wall);
  for (int i = 0; i < 6; ++i) run.frame();
  run.look(wall, 1000.0f);
  for (int i = 0; i < 6; ++i) run.frame();
  run.look(nothing, 5000.0f);
  for (int i = 0; i < 6; ++i) run.frame();
  EXPECT_EQ(proposed(run), 0u);
  run.look(wall);
  run.frame();
  EXPECT_GT(double(proposed(run)), 0.98 * run.pixels());
}

TEST_P(CacheEntries, WhatWasNotSeenForLongestGivesWay) {
  CacheRun run = make({64, 64}, 1024);
  for (int view = 0; view < 40; ++view) {
    run.look(wall, 500.0f * float(view));
    for (int i = 0; i < 4; ++i) run.frame();
    EXPECT_GT(double(proposed(run)), 0.7 * run.pixels()) << view;
  }
  EXPECT_LE(anchored(run), 1024u);
  run.look(wall);
  run.frame();
  EXPECT_LT(double(proposed(run)), 0.2 * run.pixels()) << "the first view was forgotten";
}

TEST_P(CacheEntries, ThosePixelsFeedThatSeeIt) {
  CacheRun run = make({64, 64}, 8192);
  run.look(wall);
  for (int i = 0; i < 4; ++i) run.frame();
  std::set<uint32_t> slots;
  size_t fed = 0;
  for (int i = 0; i < 8; ++i) {
    run.frame(false);
    for (uint32_t entry = 0; entry < run.entries().count; ++entry) {
      const std::vector<uint32_t> insertions = run.insertionsOf(entry);
      fed += insertions.size();
      for (const uint32_t slot : insertions) {
        ASSERT_LT(slot, run.pixels());
        EXPECT_TRUE(run.hasShadingPoint(entry));
        EXPECT_LT(glm::distance(run.posW(slot), run.anchorPosW(entry)), 3.0f);
        slots.insert(slot);
      }
    }
  }
  // One half of the pixels offers samples in a frame, the other half in the next; an entry takes
  // four.
  EXPECT_GT(double(fed), 8 * 0.2 * run.pixels());
  EXPECT_GT(double(slots.size()), 0.8 * run.pixels());
}

TEST_P(CacheEntries, TwoSidesOfAWallAreTwoEntries) {
  CacheRun run = make({64, 64}, 8192);
  const auto sides = [](glm::uvec2 p) {
    return Shown{10.0f, {0.0f, 0.0f, p.x % 2 == 0 ? 1.0f : -1.0f}};
  };
  run.look(sides);
  for (int i = 0; i < 8; ++i) run.frame();
  size_t seen = 0;
  for (uint32_t slot = 0; slot < run.pixels(); ++slot) {
    for (const uint32_t entry : run.entry("proposals", slot, run.entries().proposals)) {
      if (entry == rl::RL_INVALID) continue;
      const auto shadingPoint = run.entry("shading_points", entry, 4 * rl::RL_SHADING_POINT_UVEC4S);
      EXPECT_EQ(shadingPoint[3], run.entry("gbuffer", slot, 4)[1]);
      ++seen;
    }
  }
  EXPECT_GT(double(seen), 0.9 * run.pixels());
}

// A cell or a disc is as wide as the view: all pixels claim the same entries.
TEST_P(CacheEntries, AllPixelsInAFewEntries) {
  const ParameterMap wide = {{kEntryCount, int64_t{1024}}, {GetParam() + "_pixels", 128.0}};
  CacheRun one(GetParam(), {48, 48}, wide), many(GetParam(), {48, 48}, wide);
  one.look(wall);
  many.look(wall);
  expectSameByOneAndByMany(one, many, 6);
  EXPECT_GE(anchored(one), 1u);
  EXPECT_LE(anchored(one), 16u);
  EXPECT_GT(double(proposed(one)), 0.98 * one.pixels());
  size_t fed = 0;
  for (uint32_t entry = 0; entry < one.entries().count; ++entry) {
    const std::vector<uint32_t> insertions = one.insertionsOf(entry);
    EXPECT_EQ(std::set<uint32_t>(insertions.begin(), insertions.end()).size(), insertions.size());
    fed += insertions.size();
  }
  EXPECT_GT(fed, 0u);
  EXPECT_LE(fed, anchored(one) * rl::RL_ENTRY_INSERTIONS);
}

TEST_P(CacheEntries, HostileSurfaces) {
  const float infinity = std::numeric_limits<float>::infinity();
  const std::vector<float> bad = {1.0e6f, -1.0e6f, 1.0e30f, infinity, -infinity, std::nanf("")};
  CacheRun run = make({64, 64}, 8192);
  run.look([&](glm::uvec2 p) { return Shown{bad[(p.x + p.y) % bad.size()]}; });
  for (int i = 0; i < 4; ++i) run.frame();
  for (uint32_t slot = 0; slot < run.pixels(); ++slot) {
    for (const uint32_t entry : run.entry("proposals", slot, run.entries().proposals)) {
      if (entry != rl::RL_INVALID) {
        EXPECT_TRUE(std::isfinite(run.posW(slot).z));
      }
    }
  }
  EXPECT_GT(run.full(), run.pixels() / 2) << "what has no key has no place";
  run.look(wall);
  for (int i = 0; i < 6; ++i) run.frame();
  EXPECT_GT(double(proposed(run)), 0.95 * run.pixels());
}

INSTANTIATE_TEST_SUITE_P(, CacheEntries, testing::ValuesIn(bias::cachesWithEntries()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace restlab::conformance
