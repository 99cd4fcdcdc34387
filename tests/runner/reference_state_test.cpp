// File of a reference's progress: read bit for bit, or rejected with one line.
#include "experiments/runner/reference/reference_state.h"

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <sstream>

#include "core/base/error.h"
#include "experiments/runner/reference/reference_progress.h"
#include "tests/runner/temporary_folder.h"

namespace restlab {

namespace {

namespace fs = std::filesystem;

Image frame(uint32_t index) {
  Image image(3, 2);
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = glm::vec3(0.1f * float(i + 1), 1e-7f * float(index), 1e6f / float(i + index));
  }
  return image;
}

// Makes progress of `spp` samples with sums that no float can represent.
ReferenceState makeState(uint32_t spp) {
  ReferenceState state;
  state.id = {"0123456789abcdef0123456789abcdef", 7, "cpu"};
  for (uint32_t i = 1; i <= spp; ++i) {
    (i % 2 == 1 ? state.half0 : state.half1).add(frame(i));
    state.squares.addSquares(frame(i));
  }
  state.health.health.counts[2] = uint64_t(1) << 60;
  state.health.raysPath = 12345678901234;
  state.checks = RelmseChecks({{16, 0.1 + 0.2, 7}, {20, 1.0 / 3.0, 11}});
  state.timeS = 0.1 + 0.2;
  state.devices = {"a device", "another \"one\""};
  state.rayTracing = {"embree"};
  return state;
}

void expectSame(const ReferenceState& a, const ReferenceState& b) {
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.half0.count(), b.half0.count());
  EXPECT_EQ(a.half1.count(), b.half1.count());
  EXPECT_EQ(a.squares.count(), b.squares.count());
  for (const auto& [first, second] : {std::pair(&a.half0, &b.half0), std::pair(&a.half1, &b.half1),
                                      std::pair(&a.squares, &b.squares)}) {
    EXPECT_EQ(first->blocks().sums(), second->blocks().sums());
    EXPECT_EQ(first->open().sums(), second->open().sums());
  }
  EXPECT_EQ(a.half0.width(), b.half0.width());
  EXPECT_EQ(a.half1.height(), b.half1.height());
  EXPECT_EQ(a.health.health.counts, b.health.health.counts);
  EXPECT_EQ(a.health.raysPath, b.health.raysPath);
  EXPECT_EQ(a.checks.kept(), b.checks.kept());
  EXPECT_EQ(a.timeS, b.timeS);
  EXPECT_EQ(a.devices, b.devices);
  EXPECT_EQ(a.rayTracing, b.rayTracing);
}

class ReferenceStateTest : public TemporaryFolder {
 protected:
  std::string content() const {
    std::ifstream in(file(), std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }
  void write(const std::string& text) const {
    std::ofstream(file(), std::ios::binary | std::ios::trunc) << text;
  }
  fs::path file() const { return folder() / "a.state"; }
  std::string messageOfReading() const {
    try {
      readReferenceState(file());
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::badInput);
      return error.what();
    }
    ADD_FAILURE() << "nothing was thrown";
    return "";
  }
};

TEST_F(ReferenceStateTest, IsReadBackBitForBit) {
  // Within the first block, at its end, where one half ends it before the other, and beyond.
  for (const uint32_t spp : {2u, 3u, 10u, 1023u, 1024u, 1025u, 2900u}) {
    const ReferenceState state = makeState(spp);
    writeReferenceState(file(), state);
    const uint64_t sums = state.half0.width() * state.half0.height() * state.bytesPerPixel();
    EXPECT_GT(fs::file_size(file()), sums);
    EXPECT_LT(fs::file_size(file()), sums + 1024) << "with a head";
    EXPECT_LE(state.bytesPerPixel(), kStateBytesPerPixel);
    EXPECT_EQ(state.bytesPerPixel() <= kBlockBytesPerPixel, spp <= kBlockSpp) << spp;
    expectSame(state, readReferenceState(file()));
    EXPECT_EQ(storedSamples(file(), state.id), spp);
  }
}

TEST_F(ReferenceStateTest, GoesOnAsIfItHadNeverStopped) {
  for (const auto& [before, after] : {std::pair(5u, 9u), std::pair(1023u, 2100u)}) {
    writeReferenceState(file(), makeState(before));
    ReferenceState state = readReferenceState(file());
    for (uint32_t i = before + 1; i <= after; ++i) {
      (i % 2 == 1 ? state.half0 : state.half1).add(frame(i));
      state.squares.addSquares(frame(i));
    }
    expectSame(state, makeState(after));
  }
}

TEST_F(ReferenceStateTest, SamplesOfOthersAreNotCounted) {
  const ReferenceState state = makeState(6);
  EXPECT_EQ(storedSamples(file(), state.id), 0u) << "no file";
  writeReferenceState(file(), state);
  for (const ReferenceId& other :
       {ReferenceId{"another key", 7, "cpu"}, ReferenceId{state.id.key, 8, "cpu"},
        ReferenceId{state.id.key, 7, "vulkan"}}) {
    EXPECT_EQ(storedSamples(file(), other), 0u);
  }
}

TEST_F(ReferenceStateTest, EveryDamagedByteIsSeen) {
  writeReferenceState(file(), makeState(4));
  const std::string whole = content();
  for (size_t at = 0; at < whole.size(); ++at) {
    std::string damaged = whole;
    damaged[at] = char(damaged[at] ^ 0x10);
    write(damaged);
    EXPECT_THROW(readReferenceState(file()), Error) << "byte " << at;
  }
  for (const size_t bytes : {size_t(0), size_t(7), size_t(24), size_t(100), whole.size() - 1}) {
    write(whole.substr(0, bytes));
    EXPECT_THROW(readReferenceState(file()), Error) << bytes << " bytes";
  }
  write(whole + "x");
  EXPECT_NE(messageOfReading().find("bytes, not"), std::string::npos);
  write(whole);
  EXPECT_NO_THROW(readReferenceState(file()));
}

TEST_F(ReferenceStateTest, SaysWhatIsWrong) {
  writeReferenceState(file(), makeState(4));
  const std::string whole = content();
  std::string other = whole;
  other[8] = 1;
  write(other);
  EXPECT_NE(messageOfReading().find("a.state: is of version 1, not 2"), std::string::npos);
  write("an image, say");
  EXPECT_NE(messageOfReading().find("is no stored progress"), std::string::npos);
  other = whole;
  other[other.size() - 9] ^= 1;
  write(other);
  EXPECT_NE(messageOfReading().find("its sums are not what was written"), std::string::npos);
}

// load() and save() with good and bad files, and with full folders.
class ReferenceProgressTest : public TemporaryFolder {
 protected:
  ReferenceStore store() const {
    ReferenceStore store;
    store.folder = folder() / "references";
    return store;
  }
  static void age(const fs::path& file, int hours) {
    fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(hours));
  }
};

TEST_F(ReferenceProgressTest, KeepsTheStateThatHasMore) {
  const ReferenceState few = makeState(4), many = makeState(8);
  ReferenceProgress progress(store(), few.id);
  EXPECT_FALSE(progress.load());
  EXPECT_TRUE(progress.save(many));
  EXPECT_TRUE(progress.save(few)) << "its samples are among those";
  const std::optional<ReferenceState> kept = progress.load();
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->spp(), 8u);
  ReferenceId other = few.id;
  other.seed = 8;
  EXPECT_FALSE(ReferenceProgress(store(), other).load());
}

TEST_F(ReferenceProgressTest, OneSampleIsNoProgress) {
  ReferenceProgress progress(store(), makeState(1).id);
  EXPECT_FALSE(progress.save(makeState(1)));
  EXPECT_FALSE(progress.load());
}

TEST_F(ReferenceProgressTest, DamagedStateIsRemoved) {
  const ReferenceState state = makeState(8);
  ReferenceProgress progress(store(), state.id);
  ASSERT_TRUE(progress.save(state));
  fs::resize_file(progress.file(), fs::file_size(progress.file()) - 1);
  EXPECT_FALSE(progress.load());
  // The damaged file's header still says eight samples; saving must not wait for the ninth.
  EXPECT_TRUE(progress.save(makeState(4)));
  const std::optional<ReferenceState> again = progress.load();
  ASSERT_TRUE(again);
  EXPECT_EQ(again->spp(), 4u);
}

TEST_F(ReferenceProgressTest, StateUnderAnotherNameIsNotTaken) {
  const ReferenceState state = makeState(8);
  ReferenceProgress progress(store(), state.id);
  ASSERT_TRUE(progress.save(state));
  ReferenceId other = state.id;
  other.key = "fedcba9876543210fedcba9876543210";
  fs::copy_file(progress.file(), stateFile(store().folder, other));
  EXPECT_FALSE(ReferenceProgress(store(), other).load());
}

TEST_F(ReferenceProgressTest, RoomIsMadeByWhatWasNotUsedForLongest) {
  ReferenceState state = makeState(4);
  ReferenceStore small = store();
  std::vector<fs::path> files;
  for (uint32_t seed = 0; seed < 4; ++seed) {
    state.id.seed = seed;
    ReferenceProgress progress(small, state.id);
    ASSERT_TRUE(progress.save(state));
    files.push_back(progress.file());
    age(files.back(), 10 - int(seed));
  }
  age(files[0], 2);  // the youngest file that may be removed
  age(files[3], 0);  // in use
  small.maxBytes = fs::file_size(files[0]) * 2;
  const fs::path reference = small.folder / "finished.exr";
  std::ofstream(reference) << "a reference";
  age(reference, 1000);
  state.id.seed = 9;
  const ReferenceProgress makesRoom(small, state.id);
  EXPECT_TRUE(fs::exists(files[0]));
  EXPECT_FALSE(fs::exists(files[1]));
  EXPECT_FALSE(fs::exists(files[2]));
  EXPECT_TRUE(fs::exists(files[3]));
  EXPECT_TRUE(fs::exists(reference)) << "finished references are no states";
  small.maxBytes = 1;
  const ReferenceProgress makesMore(small, state.id);
  EXPECT_FALSE(fs::exists(files[0]));
  EXPECT_TRUE(fs::exists(files[3])) << "of the last hour: somebody may be at it";
}

TEST_F(ReferenceProgressTest, UnfinishedFilesOfKilledProgramsGo) {
  const ReferenceState state = makeState(4);
  ReferenceProgress progress(store(), state.id);
  ASSERT_TRUE(progress.save(state));
  const fs::path old = progress.file().string() + ".tmp-1-0";
  const fs::path young = progress.file().string() + ".tmp-2-0";
  for (const fs::path& file : {old, young}) std::ofstream(file) << "half";
  age(old, 2);
  const ReferenceProgress again(store(), state.id);
  EXPECT_FALSE(fs::exists(old));
  EXPECT_TRUE(fs::exists(young)) << "somebody may be writing it";
  EXPECT_TRUE(again.load());
}

TEST_F(ReferenceProgressTest, NoFolderNoProgress) {
  ReferenceProgress progress(ReferenceStore(), makeState(4).id);
  EXPECT_FALSE(progress.save(makeState(4)));
  EXPECT_FALSE(progress.load());
  std::ofstream(folder() / "file") << "no folder";
  ReferenceStore blocked;
  blocked.folder = folder() / "file";
  ReferenceProgress none(blocked, makeState(4).id);
  EXPECT_FALSE(none.save(makeState(4)));
}

}  // namespace

}  // namespace restlab
