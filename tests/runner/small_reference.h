// A small reference of a room, and the comparison of two.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "experiments/runner/base/build_info.h"
#include "experiments/runner/reference/reference.h"

namespace restlab {

inline PreparedScene prepared() {
  SceneRequest request;
  request.scene = "cornell-box";
  return prepareScene(request);
}

inline ReferenceConfig smallConfig() {
  ReferenceConfig config;
  config.width = 21;
  config.height = 13;
  config.maxBounces = 3;
  config.threads = 1;
  return config;
}

// Expects the same images and metadata, except for times and machine.
inline void expectSame(const Reference& a, const Reference& b) {
  EXPECT_EQ(a.spp, b.spp);
  EXPECT_EQ(a.mean.pixels, b.mean.pixels);
  EXPECT_EQ(a.half0->pixels, b.half0->pixels);
  EXPECT_EQ(a.half1->pixels, b.half1->pixels);
  EXPECT_EQ(a.variance->pixels, b.variance->pixels);
  EXPECT_EQ(a.relmse, b.relmse);
  EXPECT_EQ(std::isnan(a.relmseSinceHalf), std::isnan(b.relmseSinceHalf));
  if (!std::isnan(a.relmseSinceHalf)) {
    EXPECT_EQ(a.relmseSinceHalf, b.relmseSinceHalf);
  }
  auto wordsA = a.metadata, wordsB = b.metadata;
  // Metadata about how and when the image was rendered.
  auto circumstances = provenanceWords();
  circumstances["render_time_s"];
  for (const auto& [word, ignored] : circumstances) {
    EXPECT_EQ(wordsA.erase(word), 1u) << word;
    EXPECT_EQ(wordsB.erase(word), 1u) << word;
  }
  EXPECT_EQ(wordsA, wordsB);
}

}  // namespace restlab
