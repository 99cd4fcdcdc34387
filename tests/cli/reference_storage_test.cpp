// References that cannot be stored: full disks, limits, unwritable folders, damaged files. Existing
// files stay, and no incomplete file looks complete.
#include <unistd.h>

#include <fstream>

#include "tests/cli/reference_files.h"
#include "tests/cli/small_disk.h"

namespace restlab::cli_test {

namespace {

namespace fs = std::filesystem;

constexpr const char* kStoredScene = " cornell-box --resolution 48x32 --max-bounces 2 ";

class ReferenceStorage : public ReferenceFilesTest {
 protected:
  void SetUp() override {
    ReferenceFilesTest::SetUp();
    ASSERT_EQ(run(std::string("reference -q -o ref.exr --spp 4") + kStoredScene).code, 0);
    ASSERT_EQ(keptSpp(), 4u);
  }
  // Expects the reference of four samples to be complete and continuable.
  void expectUnharmed() const {
    EXPECT_EQ(keptSpp(), 4u);
    expectInOneGo("ref.exr", std::string("--spp 4") + kStoredScene);
    const ProgramResult more = run(std::string("reference -o ref.exr --spp 9") + kStoredScene);
    EXPECT_EQ(more.code, 0) << more.err;
    EXPECT_TRUE(has(more.err, "continues after the 4 spp")) << more.err;
    expectInOneGo("ref.exr", std::string("--spp 9") + kStoredScene);
  }
  size_t filesIn(const fs::path& folder) const {
    size_t count = 0;
    for (const auto& entry : fs::directory_iterator(folder)) {
      // Skip .stdout1, .stderr1 etc., which hold the programs' output.
      count += entry.path().filename().string().rfind(".std", 0) != 0;
    }
    return count;
  }
};

TEST_F(ReferenceStorage, LimitOnFilesIsOneLine) {
  Circumstances limited;
  limited.maxFileBytes = 16 << 10;  // neither the state nor the image fits
  const size_t before = filesIn(folder_);
  const ProgramResult result =
      run(std::string("reference -o ref.exr --spp 8 --checkpoint 0") + kStoredScene, limited);
  EXPECT_EQ(result.code, 3) << result.err;
  ASSERT_EQ(result.errors().size(), 1u) << result.err;
  EXPECT_TRUE(has(result.errors()[0], "ref.exr: cannot be written")) << result.err;
  const size_t warning = result.err.find("warning: the progress of the reference is not kept");
  EXPECT_NE(warning, std::string::npos) << result.err;
  EXPECT_EQ(result.err.find("warning", warning + 1), std::string::npos) << "said once";
  EXPECT_EQ(filesIn(folder_), before) << "unfinished files";
  EXPECT_EQ(filesIn(path("cache/restlab/references")), 1u);
  expectUnharmed();
}

TEST_F(ReferenceStorage, ProgressThatDoesNotFitCostsNoReference) {
  Circumstances limited;
  limited.maxFileBytes = 100 << 10;  // the image fits, not the state of 108 KiB
  const ProgramResult result =
      run(std::string("reference -o other.exr --spp 8") + kStoredScene, limited);
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(has(result.err, "warning: the progress of the reference is not kept: "))
      << result.err;
  expectInOneGo("other.exr", std::string("--spp 8") + kStoredScene);
  expectUnharmed();
}

TEST_F(ReferenceStorage, FullDiskIsOneLine) {
  fs::create_directory(path("small"));
  SmallDisk disk(path("small"), "size=160k");
  if (!disk.whyNot().empty()) GTEST_SKIP() << disk.whyNot();
  // A state of 108 KiB fits, but not a second one, nor an image.
  fs::rename(path("cache"), path("cache-before"));
  fs::create_directories(path("small/cache"));
  fs::create_directory_symlink(path("small/cache"), path("cache"));
  fs::copy(path("cache-before"), path("small/cache"), fs::copy_options::recursive);
  const ProgramResult result =
      run(std::string("reference -o small/ref.exr --spp 8 --checkpoint 0") + kStoredScene);
  EXPECT_EQ(result.code, 3) << result.err;
  ASSERT_EQ(result.errors().size(), 1u) << result.err;
  EXPECT_TRUE(has(result.errors()[0], "small/ref.exr: cannot be written")) << result.err;
  EXPECT_TRUE(has(result.err, "warning: the progress of the reference is not kept"));
  EXPECT_FALSE(fs::exists(path("small/ref.exr")));
  EXPECT_EQ(filesIn(path("small")), 1u) << "unfinished files";
  // The same command succeeds once there is room.
  ASSERT_TRUE(disk.remount("size=4m"));
  expectUnharmed();
}

TEST_F(ReferenceStorage, CacheThatCannotBeWrittenIsAWarning) {
  fs::rename(path("cache"), path("cache-before"));
  write("cache", "no folder");
  const ProgramResult result = run(std::string("reference -o other.exr --spp 8") + kStoredScene);
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(has(result.err, "warning: the progress of the reference is not kept: "))
      << result.err;
  expectInOneGo("other.exr", std::string("--spp 8") + kStoredScene);
  const ProgramResult lost = runUntil(
      [] { return true; }, std::string("reference -o more.exr --spp 100000000") + kStoredScene);
  EXPECT_EQ(lost.code, 130);
  EXPECT_TRUE(has(lost.err, "its samples are not kept")) << lost.err;
  EXPECT_FALSE(fs::exists(path("more.exr")));
}

TEST_F(ReferenceStorage, ReadOnlyFoldersAreSaid) {
  if (geteuid() == 0) GTEST_SKIP() << "SKIPPED: nothing is read-only for root";
  const fs::path folder = path("cache/restlab/references");
  fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
  const ProgramResult result = run(std::string("reference -o ref.exr --spp 8") + kStoredScene);
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(has(result.err, "warning: the progress of the reference is not kept: "));
  EXPECT_TRUE(has(result.err, "continues after the 4 spp")) << result.err;
  expectInOneGo("ref.exr", std::string("--spp 8") + kStoredScene);
  fs::permissions(folder, fs::perms::owner_all);
  fs::create_directory(path("sealed"));
  fs::permissions(path("sealed"), fs::perms::owner_read | fs::perms::owner_exec);
  expectError(run(std::string("reference -o sealed/ref.exr --spp 8") + kStoredScene), 3,
              {"sealed/ref.exr", "cannot be created"});
}

TEST_F(ReferenceStorage, DamagedProgressIsOneLineAndRenderedAnew) {
  const fs::path state = states().at(0);
  std::fstream file(state, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(std::streamoff(fs::file_size(state) / 2));
  file.put('?').put('!');
  file.close();
  const ProgramResult result = run(std::string("reference -o ref.exr --spp 8") + kStoredScene);
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(has(result.err,
                  ".state: is damaged: its sums are not what was written; rendered "
                  "anew\n"))
      << result.err;
  EXPECT_FALSE(has(result.err, "continues")) << result.err;
  expectInOneGo("ref.exr", std::string("--spp 8") + kStoredScene);
  EXPECT_EQ(keptSpp(), 8u);
}

}  // namespace

}  // namespace restlab::cli_test
