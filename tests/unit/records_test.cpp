// Records of the scene as kernels read them, as uvec4s, against the structs that the host
// wrote.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <vector>

#include "tests/unit/dialect_context.h"

namespace restlab::unit {
namespace {

constexpr uint32_t kCount = 3;

// Makes records whose words all differ, none of them NaN or zero.
template <class Record>
std::vector<Record> distinct() {
  std::vector<Record> records(kCount);
  std::vector<uint32_t> words(kCount * sizeof(Record) / 4);
  for (size_t i = 0; i < words.size(); ++i)
    words[i] = std::bit_cast<uint32_t>(1.0f + float(i) / 1024.0f);
  std::memcpy(records.data(), words.data(), words.size() * 4);
  return records;
}

// `padding`: number of words at the end that no kernel reads.
template <class Record>
void expectSame(const Record& read, const Record& written, size_t padding) {
  std::array<uint32_t, sizeof(Record) / 4> a, b;
  std::memcpy(a.data(), &read, sizeof read);
  std::memcpy(b.data(), &written, sizeof written);
  for (size_t i = 0; i + padding < a.size(); ++i) EXPECT_EQ(a[i], b[i]) << "word " << i;
}

TEST(Records, AreReadAsTheHostWroteThem) {
  auto geometries = distinct<rl::Geometry>();
  auto instances = distinct<rl::Instance>();
  auto materials = distinct<rl::Material>();
  auto textures = distinct<rl::Texture>();
  auto lights = distinct<rl::Light>();
  Dialect<> dialect;
  dialect.scene.geometries.data = geometries.data();
  dialect.scene.instances.data = instances.data();
  dialect.scene.materials.data = materials.data();
  dialect.scene.textures.data = textures.data();
  dialect.scene.lights.data = lights.data();
  for (uint32_t i = 0; i < kCount; ++i) {
    SCOPED_TRACE(i);
    expectSame(dialect->recordGeometry(i), geometries[i], 2);
    expectSame(dialect->recordInstance(i), instances[i], 0);
    expectSame(dialect->recordMaterial(i), materials[i], 2);
    expectSame(dialect->recordTexture(i), textures[i], 3);
    expectSame(dialect->recordLight(i), lights[i], 1);
  }
}

TEST(Records, AliasEntries) {
  auto entries = distinct<rl::AliasEntry>();
  Dialect<> dialect;
  dialect.scene.lightAlias.data = entries.data();
  for (uint32_t i = 0; i < kCount; ++i) {
    const rl::AliasEntry read = dialect->recordAlias(RL_SCENE_UVEC3(dialect.scene.lightAlias, i));
    expectSame(read, entries[i], 0);
  }
}

}  // namespace
}  // namespace restlab::unit
