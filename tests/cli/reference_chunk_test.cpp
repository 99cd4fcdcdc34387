// restlab reference --samples and --merge: a reference in chunks, as a user makes one.
#include "tests/cli/reference_files.h"

namespace restlab::cli_test {

namespace {

namespace fs = std::filesystem;

constexpr const char* kRoom = " cornell-box --resolution 12x8 --max-bounces 2 ";

class ReferenceChunkVerb : public ReferenceFilesTest {
 protected:
  ProgramResult reference(const std::string& options) const {
    return run("reference" + std::string(kRoom) + options);
  }
};

TEST_F(ReferenceChunkVerb, ChunksMakeTheReferenceOfOneGo) {
  // The last chunk first, each by a program of its own.
  for (const char* options : {"--samples 2048:30 -o c.chunk", "--samples 0:2048 -o a.chunk"})
    ASSERT_EQ(reference(options).code, 0) << options;
  EXPECT_TRUE(states().empty()) << "a chunk is no progress";
  const ProgramResult again = reference("--samples 2048:30 -o c.chunk");
  EXPECT_EQ(again.code, 0);
  EXPECT_TRUE(has(again.err, "c.chunk: has these samples already")) << again.err;
  const ProgramResult merged = reference("--merge c.chunk a.chunk -o ref.exr");
  ASSERT_EQ(merged.code, 0) << merged.err;
  EXPECT_TRUE(has(merged.err, "ref.exr: 2078 spp")) << merged.err;
  expectInOneGo("ref.exr", std::string("--spp 2078") + kRoom);
  // The same command without --merge goes on.
  const ProgramResult more = reference("--spp 2100 -o ref.exr");
  EXPECT_TRUE(has(more.err, "continues after the 2078 spp")) << more.err;
  expectInOneGo("ref.exr", std::string("--spp 2100") + kRoom);
  const ProgramResult target = reference("--merge a.chunk --target-relmse 1e-9 -o few.exr");
  EXPECT_EQ(target.code, 0);
  EXPECT_TRUE(has(target.err, "the target of 1e-09: stopped by the last chunk")) << target.err;
}

TEST_F(ReferenceChunkVerb, WhatDoesNotFitIsOneLine) {
  ASSERT_EQ(reference("--samples 1024:2 -o b.chunk").code, 0);
  expectError(reference("--merge b.chunk -o ref.exr"), 3, {"b.chunk", "0 to 1023", "missing"});
  expectError(reference("--merge b.chunk -o ref.exr --filter center"), 3,
              {"b.chunk", "filter is box, not center"});
  expectError(reference("--merge ref.exr -o ref.exr"), 3, {"ref.exr: no such file"});
  expectError(reference("--samples 5:10 -o a.chunk"), 2, {"--samples 5:10", "multiple of 1024"});
  expectError(reference("--samples 0:1 -o a.chunk"), 2, {"--samples 0:1", "each half"});
  for (const char* bad : {"1024", "1024:", ":5", "0:1e6", "0:10:2", "-1024:5"}) {
    expectError(reference(std::string("--samples=") + bad + " -o a.chunk"), 2,
                {"--samples", "FIRST:COUNT"});
  }
  expectError(reference("--samples 0:1024 -o a.exr"), 2, {"a.exr", ".chunk"});
  expectError(reference("--samples 0:1024 -o a.chunk --spp 1024"), 2, {"--samples", "--spp"});
  expectError(reference("--samples 0:1024 -o a.chunk --merge b.chunk"), 2, {"--merge"});
  EXPECT_FALSE(fs::exists(path("ref.exr")));
  EXPECT_FALSE(fs::exists(path("a.chunk")));
}

// Nothing that is interrupted looks complete.
TEST_F(ReferenceChunkVerb, InterruptedChunkIsNotThere) {
  const auto isUnderWay = [&] { return !entries("chunks").empty(); };
  fs::create_directory(path("chunks"));
  const ProgramResult result = runUntil(
      isUnderWay, std::string("reference --samples 0:100000000 -o chunks/a.chunk") + kRoom);
  EXPECT_EQ(result.code, 130) << result.err;
  EXPECT_TRUE(has(result.err, "chunks/a.chunk is not written, and its samples are not kept"))
      << result.err;
  EXPECT_TRUE(entries("chunks").empty());
}

}  // namespace

}  // namespace restlab::cli_test
