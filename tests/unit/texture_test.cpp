// Texture filtering: wrap modes, nearest and bilinear, sRGB, UV transforms.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "tests/unit/dialect_context.h"
#include "tests/unit/random_inputs.h"

namespace restlab::unit {
namespace {

// Exact decoding by IEC 61966-2-1.
double decodeSrgb(uint32_t value) {
  const double c = value / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

// Index of the texel that a repeated, mirrored or clamped row shows at i.
int wrapped(int i, int n, uint32_t mode) {
  if (mode == rl::RL_WRAP_CLAMP) return i < 0 ? 0 : (i >= n ? n - 1 : i);
  int k = 0;
  for (int step = 1, at = 0; at != i;
       at += i > 0 ? 1 : -1) {  // walk step by step, turning at mirrors
    if (mode == rl::RL_WRAP_REPEAT) {
      k = (k + (i > 0 ? 1 : n - 1)) % n;
      continue;
    }
    if (at == 0 && i < 0) {  // the first step to the left shows texel 0 again
      step = 0;
    }
    k += step;
    if (k >= n) {
      k = n - 1;
      step = -1;
    } else if (k < 0) {
      k = 0;
      step = 1;
    }
    if (step == 0) step = 1;
  }
  return k;
}

struct TextureTest : testing::Test {
  static constexpr int kWidth = 5, kHeight = 3;
  std::vector<uint32_t> texels;
  std::vector<float> srgb;
  Dialect<> d;
  rl::Texture tex{};

  TextureTest() {
    Inputs inputs(1);
    for (int i = 0; i < 7; ++i) texels.push_back(0xdeadbeefu);  // texels of another image in front
    for (int i = 0; i < kWidth * kHeight; ++i) texels.push_back(inputs.bits());
    for (uint32_t i = 0; i < 256; ++i) srgb.push_back(static_cast<float>(decodeSrgb(i)));
    d.scene.texels.data = texels.data();
    d.scene.srgbToLinear.data = srgb.data();
    tex.uvRow0 = {1, 0, 0};
    tex.uvRow1 = {0, 1, 0};
    tex.firstTexel = 7;
    tex.width = kWidth;
    tex.height = kHeight;
  }

  glm::dvec4 texel(int x, int y) const {
    const uint32_t t =
        texels[size_t(7 + wrapped(y, kHeight, tex.wrapV) * kWidth + wrapped(x, kWidth, tex.wrapU))];
    glm::dvec4 c;
    for (int i = 0; i < 4; ++i) {
      const uint32_t byte = t >> (8 * i) & 255u;
      c[i] = i < 3 && (tex.flags & rl::RL_TEXTURE_SRGB) != 0 ? decodeSrgb(byte) : byte / 255.0;
    }
    return c;
  }

  glm::dvec4 bilinear(double u, double v) const {
    const double x = u * kWidth - 0.5, y = v * kHeight - 0.5, fx = x - std::floor(x),
                 fy = y - std::floor(y);
    const int ix = int(std::floor(x)), iy = int(std::floor(y));
    return (texel(ix, iy) * (1 - fx) + texel(ix + 1, iy) * fx) * (1 - fy) +
           (texel(ix, iy + 1) * (1 - fx) + texel(ix + 1, iy + 1) * fx) * fy;
  }
};

TEST_F(TextureTest, WrapsEveryIndex) {
  for (uint32_t mode : {rl::RL_WRAP_REPEAT, rl::RL_WRAP_CLAMP, rl::RL_WRAP_MIRROR}) {
    for (int n : {1, 2, 3, 5, 8}) {
      for (int i = -1; i <= 2 * n; ++i) {  // range that filtering uses
        EXPECT_EQ(d->textureWrap(i, uint32_t(n), mode), wrapped(i, n, mode))
            << mode << ": " << i << " of " << n;
      }
    }
  }
  // The mirrored row, spelled out: 0 | 0 1 2 | 2 1 0 | 0.
  const std::array<int, 8> mirror = {0, 0, 1, 2, 2, 1, 0, 0};
  for (int i = 0; i < 8; ++i)
    EXPECT_EQ(d->textureWrap(i - 1, 3u, rl::RL_WRAP_MIRROR), mirror[size_t(i)]);
}

TEST_F(TextureTest, TexelsAreLittleEndianRgba) {
  texels[7] = 0x80402010u;
  const glm::vec4 t = d->textureTexel(tex, 0, 0);
  EXPECT_FLOAT_EQ(t.x, 16.0f / 255.0f);
  EXPECT_FLOAT_EQ(t.y, 32.0f / 255.0f);
  EXPECT_FLOAT_EQ(t.z, 64.0f / 255.0f);
  EXPECT_FLOAT_EQ(t.w, 128.0f / 255.0f);
}

TEST_F(TextureTest, NearestAndBilinearInEveryMode) {
  Inputs inputs(2);
  for (uint32_t wrapU : {rl::RL_WRAP_REPEAT, rl::RL_WRAP_CLAMP, rl::RL_WRAP_MIRROR}) {
    for (uint32_t wrapV : {rl::RL_WRAP_REPEAT, rl::RL_WRAP_CLAMP, rl::RL_WRAP_MIRROR}) {
      for (uint32_t flags = 0; flags < 4; ++flags) {
        tex.wrapU = wrapU;
        tex.wrapV = wrapV;
        tex.flags = flags;
        for (int i = 0; i < 2000; ++i) {
          const glm::vec2 uv(inputs.uniform(-4.0f, 4.0f), inputs.uniform(-4.0f, 4.0f));
          const glm::vec4 value = d->textureSample(tex, uv);
          const double x = double(uv.x) * kWidth, y = double(uv.y) * kHeight;
          if ((flags & rl::RL_TEXTURE_NEAREST) != 0) {
            // Close to a border, rounding decides.
            if (std::abs(x - std::round(x)) < 1e-5 || std::abs(y - std::round(y)) < 1e-5) continue;
            ASSERT_LT(
                glm::distance(glm::dvec4(value), texel(int(std::floor(x)), int(std::floor(y)))),
                1e-6);
          } else {
            ASSERT_LT(glm::distance(glm::dvec4(value), bilinear(uv.x, uv.y)), 2e-5)
                << uv.x << " " << uv.y;
          }
        }
      }
    }
  }
}

// Decoding precedes filtering: half way between black and white is half the light, not half the
// code.
TEST_F(TextureTest, SrgbIsDecodedBeforeFiltering) {
  texels[7] = 0xff000000u;
  texels[8] = 0xffffffffu;
  tex.width = 2;
  tex.height = 1;
  tex.wrapU = rl::RL_WRAP_CLAMP;
  tex.flags = rl::RL_TEXTURE_SRGB;
  EXPECT_NEAR(d->textureSample(tex, {0.5f, 0.5f}).x, 0.5f, 1e-6f);
  // Alpha is always linear.
  texels[7] = 0x80808080u;
  tex.width = 1;
  const glm::vec4 grey = d->textureSample(tex, {0.5f, 0.5f});
  EXPECT_NEAR(grey.x, 0.2158605, 1e-6);
  EXPECT_NEAR(grey.w, 128.0 / 255.0, 1e-6);
}

TEST_F(TextureTest, TransformIsAppliedFirst) {
  // KHR_texture_transform: translation x rotation x scale.
  const double angle = 0.6, sx = 1.7, sy = -0.4, tx = 0.3, ty = -2.2;
  tex.uvRow0 = glm::vec3(sx * std::cos(angle), sy * std::sin(angle), tx);
  tex.uvRow1 = glm::vec3(-sx * std::sin(angle), sy * std::cos(angle), ty);
  Inputs inputs(3);
  for (int i = 0; i < 5000; ++i) {
    const glm::vec2 uv(inputs.uniform(-2.0f, 2.0f), inputs.uniform(-2.0f, 2.0f));
    const double u = std::cos(angle) * sx * uv.x + std::sin(angle) * sy * uv.y + tx;
    const double v = -std::sin(angle) * sx * uv.x + std::cos(angle) * sy * uv.y + ty;
    ASSERT_LT(glm::distance(glm::dvec4(d->textureSample(tex, uv)), bilinear(u, v)), 3e-5);
  }
}

// Coordinates without fraction bits, or non-finite: must give some texel and never read outside.
TEST_F(TextureTest, HugeCoordinatesAreSafe) {
  for (uint32_t mode : {rl::RL_WRAP_REPEAT, rl::RL_WRAP_CLAMP, rl::RL_WRAP_MIRROR}) {
    tex.wrapU = tex.wrapV = mode;
    for (uint32_t flags : {0u, rl::RL_TEXTURE_NEAREST}) {
      tex.flags = flags;
      for (float x : {1e7f, -1e7f, 3e9f, -3e9f, 1e30f, -1e30f, 3e38f}) {
        const glm::vec4 value = d->textureSample(tex, {x, -x});
        for (int c = 0; c < 4; ++c)
          EXPECT_TRUE(value[c] >= 0.0f && value[c] <= 1.0f) << mode << " " << x;
      }
    }
  }
}

}  // namespace
}  // namespace restlab::unit
