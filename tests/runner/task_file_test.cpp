// Results of tasks as one file: what is packed is unpacked, and whatever else is refused.
#include "experiments/runner/cluster/task_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/base/error.h"
#include "core/image/io/atomic_file.h"
#include "tests/runner/temporary_folder.h"

namespace restlab {

namespace {

namespace fs = std::filesystem;

class TaskFileTest : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    fs::create_directories(folder() / "jobs/a");
    write(folder() / "jobs/a/job.json", "{}");
    write(folder() / "jobs/a/image", std::string(300000, 'i'));
  }
  static void write(const fs::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
  }
  static std::string read(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
  fs::path file() const { return folder() / "000001.tar"; }
};

TEST_F(TaskFileTest, WhatIsPackedIsUnpacked) {
  packTask(file(), {{"task", 1}}, folder() / "jobs");
  EXPECT_EQ(whyDamaged(file()), "");
  EXPECT_EQ(readTaskHead(file())["task"], 1);
  unpackTask(file(), folder() / "out");
  EXPECT_EQ(read(folder() / "out/a/job.json"), "{}");
  EXPECT_EQ(read(folder() / "out/a/image"), read(folder() / "jobs/a/image"));
  // Another worker's result stays as it is.
  const std::string before = read(file());
  packTask(file(), {{"task", 2}}, folder() / "jobs");
  EXPECT_EQ(read(file()), before);
}

TEST_F(TaskFileTest, TheFirstOfTwoWritersWins) {
  {
    AtomicFile one(file()), other(file());
    one.stream() << "one";
    other.stream() << "other";
    EXPECT_TRUE(other.commitNew());
    EXPECT_FALSE(one.commitNew());
  }
  EXPECT_EQ(read(file()), "other");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder()), {}), 2) << "the file, and jobs";
}

TEST_F(TaskFileTest, EveryDamageIsFound) {
  packTask(file(), {{"task", 1}}, folder() / "jobs");
  const std::string whole = read(file());
  for (const size_t size :
       {size_t(0), size_t(100), size_t(700), whole.size() / 2, whole.size() - 1500}) {
    write(file(), whole.substr(0, size));
    EXPECT_NE(whyDamaged(file()), "") << size;
    EXPECT_NE(whyDamaged(file()).find(file().string()), std::string::npos);
  }
  // A byte of the image, of the head and of the name of a member.
  for (const size_t at : {whole.size() / 2, size_t(520), whole.find("a/image", 1024)}) {
    std::string changed = whole;
    changed[at] = char(changed[at] ^ 1);
    write(file(), changed);
    EXPECT_NE(whyDamaged(file()), "") << at;
    EXPECT_THROW(unpackTask(file(), folder() / "out"), Error);
  }
  // A damaged file is no result: the next worker's replaces it.
  packTask(file(), {{"task", 2}}, folder() / "jobs");
  EXPECT_EQ(whyDamaged(file()), "");
  write(file(), "no tar at all");
  EXPECT_THROW(readTaskHead(file()), Error);
}

}  // namespace

}  // namespace restlab
