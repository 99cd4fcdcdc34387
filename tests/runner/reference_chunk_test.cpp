// Chunks of references: merged in any order they are one rendering, bit for bit; and what does not
// belong together is refused with a line.
#include "experiments/runner/reference/reference_chunk.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <random>
#include <sstream>

#include "core/base/error.h"
#include "tests/runner/small_reference.h"
#include "tests/runner/temporary_folder.h"

namespace restlab {

namespace {

namespace fs = std::filesystem;

ReferenceConfig tinyConfig() {
  ReferenceConfig config = smallConfig();
  config.width = 8;
  config.height = 6;
  config.seed = 5;
  return config;
}

std::string contentOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void writeContent(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
}

// Expects the same bits in double precision, most of which images in float do not show.
void expectSameSums(const ReferenceState& a, const ReferenceState& b) {
  for (const auto& [first, second] : {std::pair(&a.half0, &b.half0), std::pair(&a.half1, &b.half1),
                                      std::pair(&a.squares, &b.squares)}) {
    EXPECT_EQ(first->count(), second->count());
    EXPECT_EQ(first->blocks().sums(), second->blocks().sums());
    EXPECT_EQ(first->open().sums(), second->open().sums());
  }
  EXPECT_EQ(a.checks.kept(), b.checks.kept());
  EXPECT_EQ(a.health.health.counts, b.health.health.counts);
  EXPECT_EQ(a.health.raysPath, b.health.raysPath);
  EXPECT_EQ(a.health.raysShadow, b.health.raysShadow);
}

class ReferenceChunks : public TemporaryFolder {
 protected:
  fs::path file(const ChunkRange& range) const {
    return folder() / (std::to_string(range.firstSpp) + kChunkExtension);
  }
  // Renders chunks in the order given. Returns their files in that order.
  std::vector<fs::path> render(const ReferenceConfig& config,
                               const std::vector<ChunkRange>& ranges) const {
    std::vector<fs::path> files;
    for (const ChunkRange& range : ranges) {
      files.push_back(file(range));
      EXPECT_TRUE(renderChunk(scene_, config, range, files.back()));
    }
    return files;
  }
  // Returns the state after a rendering here, which goes on from what is kept in `store`.
  ReferenceState rendered(const ReferenceConfig& config, uint64_t spp,
                          const std::string& store = "progress") const {
    ReferenceStore kept;
    kept.folder = folder() / store;
    renderReference(scene_, config, {.spp = spp}, kept);
    return readReferenceState(
        stateFile(kept.folder, {referenceKey(scene_, config), config.seed, config.backend}));
  }
  Reference merged(const ReferenceConfig& config, const std::vector<fs::path>& files,
                   const ReferenceTarget& target = {}) const {
    return referenceOf(scene_, config, mergeChunks(scene_, config, {}, files, target));
  }
  std::string refusal(const ReferenceConfig& config, const std::vector<fs::path>& files,
                      const ReferenceState& state = {}) const {
    try {
      mergeChunks(scene_, config, state, files);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::badInput);
      return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return "";
  }
  const PreparedScene scene_ = prepared();
};

TEST_F(ReferenceChunks, OfAnyOrderAreOneRenderingBitForBit) {
  // The last of the 16 chunks is shorter, with one sample more of the first half.
  const uint64_t spp = 15 * kBlockSpp + 301;
  std::vector<ChunkRange> ranges = chunkRanges(0, spp, kBlockSpp);
  ASSERT_EQ(ranges.size(), 16u);
  std::mt19937 random(1);
  std::shuffle(ranges.begin(), ranges.end(), random);
  std::vector<fs::path> files = render(tinyConfig(), ranges);
  std::shuffle(files.begin(), files.end(), random);
  const ReferenceState whole = rendered(tinyConfig(), spp);
  const ReferenceState state = mergeChunks(scene_, tinyConfig(), {}, files);
  expectSameSums(state, whole);
  const Reference reference = referenceOf(scene_, tinyConfig(), whole);
  EXPECT_LT(reference.relmseSinceHalf, 0.01) << "checks are among what is the same";
  expectSame(referenceOf(scene_, tinyConfig(), state), reference);
}

// Also where one rendering is interrupted in the middle of a block, a chunk has several blocks, and
// a merged result is stored and goes on.
TEST_F(ReferenceChunks, AndRenderingsInPartsAreTheSame) {
  const uint64_t spp = 3 * kBlockSpp + 100;
  const ReferenceState whole = rendered(tinyConfig(), spp, "in one go");
  for (const uint64_t part : {kBlockSpp - 1, kBlockSpp + 500, 2 * kBlockSpp})
    EXPECT_EQ(rendered(tinyConfig(), part).spp(), part);
  expectSameSums(rendered(tinyConfig(), spp), whole);

  const std::vector<fs::path> files = render(tinyConfig(), chunkRanges(0, spp, 2 * kBlockSpp));
  ASSERT_EQ(files.size(), 2u);
  const ReferenceState first = mergeChunks(scene_, tinyConfig(), {}, {files[0]});
  writeReferenceState(folder() / "first.state", first);
  const ReferenceState both =
      mergeChunks(scene_, tinyConfig(), readReferenceState(folder() / "first.state"), {files[1]});
  expectSameSums(both, whole);
}

TEST_F(ReferenceChunks, ByEveryKindOfIntegrator) {
  const ParameterMap coarse = {{"elements", 64}, {"factor_rays", 16}, {"light_samples", 16}};
  for (const auto& [integrator, parameters] :
       {std::pair("bdpt", ParameterMap()), std::pair("local", ParameterMap()),
        std::pair("radiosity", coarse)}) {
    SCOPED_TRACE(integrator);
    ReferenceConfig config = tinyConfig();
    config.integrator = integrator;
    config.parameters = parameters;
    const uint64_t spp = kBlockSpp + 9;
    const std::vector<fs::path> files = render(config, chunkRanges(0, spp, kBlockSpp));
    expectSameSums(mergeChunks(scene_, config, {}, files), rendered(config, spp));
    for (const fs::path& one : files) fs::remove(one);
  }
}

// Blocks that one rendering would not have rendered are left out.
TEST_F(ReferenceChunks, TargetIsMetAtTheSameSample) {
  const double reached =
      renderReference(scene_, tinyConfig(), {.spp = 4 * kBlockSpp}).relmseSinceHalf;
  const ReferenceTarget target = {.relmse = 1.01 * reached};
  const Reference whole = renderReference(scene_, tinyConfig(), target);
  ASSERT_GT(whole.spp, kBlockSpp);
  ASSERT_LE(whole.spp, 4 * kBlockSpp);
  const std::vector<fs::path> files =
      render(tinyConfig(), chunkRanges(0, 6 * kBlockSpp, 3 * kBlockSpp));
  expectSame(merged(tinyConfig(), files, target), whole);
  EXPECT_EQ(merged(tinyConfig(), files).spp, 6 * kBlockSpp);
  // Further chunks are asked for until then.
  const Reference one = merged(tinyConfig(), files, {.spp = 2});
  EXPECT_EQ(one.spp, kBlockSpp);
  EXPECT_GT(sppExpected(one, target), kBlockSpp);
  EXPECT_EQ(sppExpected(one, target) % kBlockSpp, 0u);
  EXPECT_EQ(sppExpected(one, {.spp = kBlockSpp + 7}), kBlockSpp + 7);
  EXPECT_LE(sppExpected(one, {.relmse = 1e-12}), 4 * kBlockSpp);
  EXPECT_EQ(sppExpected(whole, target), whole.spp);
}

// The first chunk ends where one rendering would, within its block.
TEST_F(ReferenceChunks, TargetIsMetWithinTheFirstBlock) {
  const double reached = renderReference(scene_, tinyConfig(), {.spp = 640}).relmseSinceHalf;
  const ReferenceTarget target = {.relmse = 1.01 * reached};
  const Reference whole = renderReference(scene_, tinyConfig(), target);
  ASSERT_LE(whole.spp, 640u);
  const ChunkRange planned = {0, kBlockSpp};
  EXPECT_TRUE(renderChunk(scene_, tinyConfig(), planned, file(planned), target));
  EXPECT_EQ(readChunkInfo(file(planned)).range, (ChunkRange{0, whole.spp}));
  expectSame(merged(tinyConfig(), {file(planned)}, target), whole);
  EXPECT_FALSE(renderChunk(scene_, tinyConfig(), planned, file(planned), target)) << "is there";
  EXPECT_TRUE(renderChunk(scene_, tinyConfig(), planned, file(planned), {.relmse = 1e-9}))
      << "is too short for another target";
}

TEST_F(ReferenceChunks, ThatAreThereStay) {
  const ChunkRange range = {kBlockSpp, 3};
  const fs::path chunk = render(tinyConfig(), {range}).at(0);
  const std::string before = contentOf(chunk);
  const size_t sums = 8 * 6 * chunkFileBytesPerPixel(range.spp);
  EXPECT_GT(before.size(), sums);
  EXPECT_LT(before.size(), sums + 8192) << "with a head";
  EXPECT_FALSE(renderChunk(scene_, tinyConfig(), range, chunk));
  EXPECT_EQ(contentOf(chunk), before);
  // Anything else is replaced.
  std::string damaged = before;
  damaged[200] = char(damaged[200] ^ 1);
  writeContent(chunk, damaged);
  EXPECT_TRUE(renderChunk(scene_, tinyConfig(), range, chunk));
  ReferenceConfig other = tinyConfig();
  other.seed = 6;
  EXPECT_TRUE(renderChunk(scene_, other, range, chunk));
  EXPECT_EQ(readChunkInfo(chunk).id.seed, 6u);
  EXPECT_TRUE(renderChunk(scene_, other, {kBlockSpp, 4}, chunk));
  EXPECT_EQ(readChunkInfo(chunk).range, (ChunkRange{kBlockSpp, 4}));
}

TEST_F(ReferenceChunks, OfOtherThingsAreRefused) {
  const ChunkRange second = {kBlockSpp, 2};
  const std::vector<fs::path> files = render(tinyConfig(), {{0, kBlockSpp}, second});
  const fs::path other = folder() / "other.chunk";
  const auto refusedBy = [&](const std::function<void(ReferenceConfig&)>& change) {
    ReferenceConfig config = tinyConfig();
    change(config);
    renderChunk(scene_, config, second, other);
    return refusal(tinyConfig(), {files[0], other});
  };
  const std::string name = other.string();
  EXPECT_EQ(refusedBy([](ReferenceConfig& config) { config.width = 9; }),
            name + ": the reference is of another configuration: width is 9, not 8");
  EXPECT_EQ(refusedBy([](ReferenceConfig& config) { config.seed = 6; }),
            name + ": is of seed 6, not 5");
  EXPECT_EQ(refusedBy([](ReferenceConfig& config) { config.integrator = "bdpt"; }),
            name + ": is a chunk of a reference by bdpt, not path");
  EXPECT_EQ(refusedBy([](ReferenceConfig& config) { config.maxBounces = 2; }),
            name + ": the reference is of another configuration: max_bounces is 2, not 3");
  const ReferenceState first = mergeChunks(scene_, tinyConfig(), {}, {files[0]});
  ReferenceConfig seeded = tinyConfig();
  seeded.seed = 6;
  EXPECT_NE(refusal(seeded, {}, first).find("go on from are of another reference"),
            std::string::npos);
}

TEST_F(ReferenceChunks, WithGapsAreRefused) {
  const std::vector<fs::path> files = render(
      tinyConfig(), {{0, kBlockSpp}, {kBlockSpp, 1}, {2 * kBlockSpp, 2}, {3 * kBlockSpp, 2}});
  const auto said = [&](std::initializer_list<size_t> chosen, const ReferenceState& state = {}) {
    std::vector<fs::path> some;
    for (const size_t one : chosen) some.push_back(files[one]);
    return refusal(tinyConfig(), some, state);
  };
  EXPECT_EQ(said({1}), files[1].string() +
                           ": begins at sample 1024, but samples 0 to 1023 of a pixel are missing");
  EXPECT_EQ(said({3, 0}), files[3].string() +
                              ": begins at sample 3072, but samples 1024 to 3071 "
                              "of a pixel are missing");
  EXPECT_EQ(said({2, 1, 0}), files[2].string() +
                                 ": begins at sample 2048, but samples 1025 to "
                                 "2047 of a pixel are missing");
  const fs::path copy = folder() / "copy.chunk";
  fs::copy_file(files[1], copy);
  EXPECT_EQ(refusal(tinyConfig(), {copy, files[0], files[1]}),
            copy.string() + ": begins at sample 1024, but those of " + files[1].string() +
                " go on to sample 1024");
  const ReferenceState state = mergeChunks(scene_, tinyConfig(), {}, {files[1], files[0]});
  EXPECT_EQ(state.spp(), kBlockSpp + 1);
  EXPECT_EQ(said({1}, state),
            files[1].string() +
                ": begins at sample 1024, but the samples before it go on to sample 1024");
}

TEST_F(ReferenceChunks, ThatAreDamagedAreRefused) {
  const fs::path chunk = render(tinyConfig(), {{0, kBlockSpp + 2}}).at(0);
  const std::string whole = contentOf(chunk);
  const auto said = [&](const std::string& content) {
    writeContent(chunk, content);
    return refusal(tinyConfig(), {chunk});
  };
  // A byte in each 97th place: prefix, sums of both blocks, head.
  for (size_t at = 0; at < whole.size(); at += 97) {
    std::string damaged = whole;
    damaged[at] = char(damaged[at] ^ 0x10);
    EXPECT_EQ(said(damaged).rfind(chunk.string() + ": ", 0), 0u) << at;
  }
  std::string damaged = whole;
  damaged[24 + 48 * kBlockBytesPerPixel + 5] ^= 1;
  EXPECT_EQ(said(damaged), chunk.string() +
                               ": is damaged: its sums of the samples from 1024 on are not what "
                               "was written");
  for (const size_t bytes : {size_t(0), size_t(20), size_t(24), size_t(2000), whole.size() - 1})
    EXPECT_EQ(said(whole.substr(0, bytes)).rfind(chunk.string() + ": is ", 0), 0u) << bytes;
  EXPECT_EQ(said("no chunk of ours, but long enough"),
            chunk.string() + ": is no chunk of a reference");
  damaged = whole;
  damaged[8] = 2;
  EXPECT_EQ(said(damaged), chunk.string() + ": is of version 2, not 1");
  EXPECT_EQ(refusal(tinyConfig(), {folder() / "none.chunk"}),
            (folder() / "none.chunk").string() + ": no such file");
  // Nothing half-written stays.
  EXPECT_THROW(renderChunk(scene_, tinyConfig(), {5, 2}, folder() / "bad.chunk"), Error);
  EXPECT_THROW(renderChunk(scene_, tinyConfig(), {0, 1}, folder() / "bad.chunk"), Error);
  EXPECT_THROW(renderChunk(scene_, tinyConfig(), {kMostSpp, 2}, folder() / "bad.chunk"), Error);
  EXPECT_FALSE(fs::exists(folder() / "bad.chunk"));
}

TEST_F(ReferenceChunks, MergedReferenceIsTakenAsIfRenderedHere) {
  const std::string before = getenv("XDG_CACHE_HOME") ? getenv("XDG_CACHE_HOME") : "";
  setenv("XDG_CACHE_HOME", (folder() / "cache").c_str(), 1);
  const std::vector<fs::path> files = render(tinyConfig(), chunkRanges(0, kBlockSpp + 4, 1));
  const ReferenceState state = mergeChunks(scene_, tinyConfig(), {}, files);
  const Reference stored =
      storeMerged(scene_, tinyConfig(), state, folder() / "references", "room / all");
  const fs::path cache = referenceCacheFolder();
  EXPECT_EQ(storedSamples(stateFile(cache, state.id), state.id), kBlockSpp + 4) << "goes on";
  const auto obtained = [&](uint64_t spp, const char* where) {
    fs::create_directories(folder() / where);
    return obtainReference(scene_, tinyConfig(), {.spp = spp}, folder() / where, "room / all");
  };
  EXPECT_EQ(obtained(kBlockSpp, "references").metadata, stored.metadata) << "in the folder";
  EXPECT_EQ(obtained(kBlockSpp, "other").metadata, stored.metadata) << "in the cache";
  expectSame(obtained(kBlockSpp + 9, "references"),
             renderReference(scene_, tinyConfig(), {.spp = kBlockSpp + 9}));
  // The cache has more meanwhile, which stays.
  storeMerged(scene_, tinyConfig(), state, folder() / "third", "room / all");
  EXPECT_EQ(readReference(cache / (state.id.key + ".exr")).spp, kBlockSpp + 9);
  if (before.empty()) {
    unsetenv("XDG_CACHE_HOME");
  } else {
    setenv("XDG_CACHE_HOME", before.c_str(), 1);
  }
}

}  // namespace

}  // namespace restlab
