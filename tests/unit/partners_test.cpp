// Spatial donors come in pairs: if b is the k-th partner of pixel a, then a is the k-th partner of
// b. Each shift of a pair serves both merges: a pair without its counterpart would read a stale
// shift.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "core/dialect/order.h"
#include "core/resampling/pairs.h"
#include "core/resampling/reservoir.h"

namespace rl {
namespace {

// Context with partners over hand-made surfaces.
struct PairContext {
  FrameData gFrame{};
  struct {
    Uvec4Ref gbuffer;
  } gBuffers{};
  struct {
    PairParams pairs;
  } gParams{};
  std::vector<GBufferTexel> surfaces;

#define RL_HAS(features) false
#define RL_HEALTH(kind) (void)(kind)
  vec3 recordVec3(const uvec4& q) const {
    return vec3(uintBitsToFloat(q.x), uintBitsToFloat(q.y), uintBitsToFloat(q.z));
  }
  uvec4 recordUvec4(const vec3& v, uint w) const {
    return uvec4(floatBitsToUint(v.x), floatBitsToUint(v.y), floatBitsToUint(v.z), w);
  }
#include "core/shading/camera.glsl"
#include "core/dialect/frame.glsl"
#include "core/dialect/math.glsl"
#include "core/dialect/pack.glsl"
#include "core/dialect/rng.glsl"
#include "core/dialect/warp.glsl"
#include "core/gbuffer/gbuffer.glsl"
#define gbufferRead(words, camera, slot) surfaces[slot]
#include "core/resampling/pairs.glsl"
#undef gbufferRead
};

// Every `unusableEvery`-th pixel shows nothing; surfaces are two parallel planes, in stripes, that
// do not match.
PairContext makeContext(uint width, uint height, uint tile, bool stripes, uint unusableEvery) {
  PairContext c;
  c.gFrame.width = width;
  c.gFrame.height = height;
  c.gFrame.seed = 11;
  c.gParams.pairs = {tile, {0.9f, 0.05f}};
  for (uint i = 0; i < width * height; ++i) {
    GBufferTexel a{};
    const bool isFar = stripes && (i % width / 5) % 2 == 1;
    const uint row = i / width;
    a.posW = vec3(float(i % width), float(row), isFar ? -40.0f : -10.0f);
    a.nGeoW = a.nShadeW = c.packNormal(vec3(0.0f, 0.0f, 1.0f));
    a.isHit = unusableEvery != 0 && i % unusableEvery == 0 ? 0u : 1u;
    c.surfaces.push_back(a);
  }
  return c;
}

uint partnerOf(PairContext& c, uint slot, uint k) {
  const uvec2 pixel(slot % c.gFrame.width, slot / c.gFrame.width);
  uint partner = 0;
  const bool found = c.pairFind(pixel, k, partner);
  EXPECT_EQ(found, partner != RL_INVALID);
  return partner;
}

TEST(Partners, ThePartnerOfThePartnerIsThePixel) {
  const uint sizes[][2] = {{64, 36}, {37, 23}, {1, 50}, {50, 1}, {3, 3}, {1, 1}};
  for (const auto& size : sizes) {
    for (const uint tile : {2u, 3u, 10u, 20u, 300u}) {
      for (const bool stripes : {false, true}) {
        PairContext c = makeContext(size[0], size[1], tile, stripes, stripes ? 7 : 0);
        for (c.gFrame.frame = 0; c.gFrame.frame < 6; ++c.gFrame.frame) {
          for (uint slot = 0; slot < c.surfaces.size(); ++slot) {
            for (uint k = 0; k < RL_MAX_DONORS; ++k) {
              const uint partner = partnerOf(c, slot, k);
              if (partner == RL_INVALID) continue;
              ASSERT_LT(partner, c.surfaces.size());
              ASSERT_NE(partner, slot);
              ASSERT_EQ(c.surfaces[slot].isHit & c.surfaces[partner].isHit, 1u);
              ASSERT_EQ(c.surfaces[slot].posW.z, c.surfaces[partner].posW.z);
              ASSERT_EQ(partnerOf(c, partner, k), slot)
                  << size[0] << "x" << size[1] << ", tile " << tile << ", k " << k;
            }
          }
        }
      }
    }
  }
}

// On one large surface nearly every pixel has a partner; on alternating surfaces, two pairings find
// more than one would (half each: 1/2 + 1/2 * 1/4).
TEST(Partners, MostPixelsHaveOne) {
  const auto share = [](bool stripes) {
    PairContext c = makeContext(200, 200, 10, stripes, 0);
    size_t found = 0;
    for (uint slot = 0; slot < c.surfaces.size(); ++slot)
      found += partnerOf(c, slot, 0) != RL_INVALID;
    return double(found) / double(c.surfaces.size());
  };
  EXPECT_GT(share(false), 0.94);  // border tiles extend beyond the image
  EXPECT_GT(share(true), 0.55);
}

// Over frames, a pixel meets every offset of the tile at its expected frequency, and different
// pixels in different pairings and frames.
TEST(Partners, EveryOffsetIsReached) {
  constexpr uint kTile = 6, kFrames = 24200;
  PairContext c = makeContext(41, 41, kTile, false, 0);
  const uint slot = 20 * 41 + 20;
  std::map<std::pair<int, int>, uint> offsets;
  uint same = 0, none = 0;
  for (c.gFrame.frame = 0; c.gFrame.frame < kFrames; ++c.gFrame.frame) {
    uvec2 first, second;
    const bool hasFirst = c.partnerMirror(uvec2(20, 20), 0, first);
    const bool hasSecond = c.partnerMirror(uvec2(20, 20), 1, second);
    same += hasFirst && hasSecond && first == second;
    none += !hasFirst;
    if (hasFirst) ++offsets[{int(first.x) - 20, int(first.y) - 20}];
  }
  ASSERT_EQ(slot, 840u);
  // Offsets are -5..5 by -5..5 without the pixel itself; the probability falls off linearly from
  // the middle.
  EXPECT_EQ(offsets.size(), 120u);
  double chi2 = 0.0;
  for (const auto& [offset, count] : offsets) {
    const double p = double(kTile - uint(std::abs(offset.first))) *
                     double(kTile - uint(std::abs(offset.second))) / std::pow(kTile, 4);
    chi2 += std::pow(count - p * kFrames, 2) / (p * kFrames);
  }
  EXPECT_LT(chi2, 184.0);  // 119 degrees of freedom: p = 1e-4
  EXPECT_NEAR(double(none) / kFrames, 1.0 / 36.0, 0.006);
  EXPECT_LT(double(same) / kFrames, 0.05);
}

}  // namespace
}  // namespace rl
