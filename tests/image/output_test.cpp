// Outputs: files that cannot be written give an error, and a partly written file never has the
// final name.
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>

#include "core/image/io/atomic_file.h"
#include "tests/image/exr_fixture.h"

namespace restlab {
namespace {

TEST_F(ExrTest, SymbolicLinkIsFollowed) {
  fs::create_directory(path("elsewhere"));
  writeTextFile(path("elsewhere/real.exr"), "old");
  fs::create_symlink(path("elsewhere/real.exr"), path("link.exr"));
  LayeredImage image;
  image.layers[""] = Image(2, 2, glm::vec3(1.0f));
  writeExr(path("link.exr"), image);
  EXPECT_TRUE(fs::is_symlink(path("link.exr")));
  EXPECT_EQ(readExr(path("elsewhere/real.exr")).layers.at("").width, 2u);
}

TEST_F(ExrTest, ImagesThatCannotBeWritten) {
  LayeredImage none;
  errorLine([&] { writeExr(path("a.exr"), none); });
  LayeredImage empty;
  empty.layers[""] = Image();
  errorLine([&] { writeExr(path("a.exr"), empty); });
  LayeredImage unequal;
  unequal.layers[""] = Image(2, 2);
  unequal.layers["x"] = Image(2, 3);
  EXPECT_NE(errorLine([&] { writeExr(path("a.exr"), unequal); }).find("'x' is 2x3"),
            std::string::npos);
  LayeredImage inconsistent;
  inconsistent.layers[""] = Image(2, 2);
  inconsistent.layers[""].pixels.resize(3);
  errorLine([&] { writeExr(path("a.exr"), inconsistent); });
  errorLine([&] { writePng(path("a.png"), Image()); });
  EXPECT_EQ(filesInDirectory(), 0u);
}

TEST_F(ExrTest, OutputsThatCannotBeCreated) {
  LayeredImage image;
  image.layers[""] = Image(2, 2);
  writeTextFile(path("file"), "");
  for (const fs::path& output :
       {directory_, path("absent/a.exr"), path("file/a.exr"), fs::path("/dev/null"), fs::path(),
        path(""), path(std::string(300, 'n') + ".exr"), fs::path("/proc/a.exr")}) {
    errorLine([&] { checkWritable(output); });
    errorLine([&] { writeExr(output, image); });
    errorLine([&] { writePng(output, image.layers.at("")); });
  }
  if (::geteuid() != 0) {  // root may write anywhere
    fs::create_directory(path("locked"));
    fs::permissions(path("locked"), fs::perms::owner_read | fs::perms::owner_exec);
    errorLine([&] { checkWritable(path("locked/a.exr")); });
    fs::permissions(path("locked"), fs::perms::owner_all);
    fs::remove(path("locked"));
  }
  checkWritable(path("fine.exr"));
  EXPECT_EQ(filesInDirectory(), 1u) << "checkWritable left something behind";
}

TEST_F(ExrTest, FullDiskLeavesTheOldFile) {
  LayeredImage small;
  small.layers[""] = Image(2, 2, glm::vec3(1.0f));
  writeExr(path("a.exr"), small);
  LayeredImage large;
  large.layers[""] = testImage(256, 256);
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  for (const rlim_t limit : {rlim_t(100), rlim_t(5000), rlim_t(100000)}) {
    rlimit tight = before;
    tight.rlim_cur = limit;
    auto* oldHandler = std::signal(SIGXFSZ, SIG_IGN);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &tight), 0);
    const std::string line = errorLine([&] { writeExr(path("a.exr"), large); });
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
    std::signal(SIGXFSZ, oldHandler);
    EXPECT_NE(line.find("a.exr: cannot be written"), std::string::npos) << line;
    EXPECT_EQ(readExr(path("a.exr")).layers.at("").width, 2u);
    EXPECT_EQ(filesInDirectory(), 1u);
  }
}

TEST_F(ExrTest, PngIsWrittenWhole) {
  Image image(3, 2, glm::vec3(0.5f));
  image.at(1, 0).y = std::numeric_limits<float>::quiet_NaN();
  image.at(2, 1).x = -std::numeric_limits<float>::infinity();
  writePng(path("a.png"), image, 2.0f);
  const std::string bytes = readBytes(path("a.png"));
  ASSERT_GT(bytes.size(), 40u);
  EXPECT_EQ(bytes.substr(1, 3), "PNG");
  EXPECT_EQ(uint8_t(bytes[19]), 3);  // width and height of IHDR
  EXPECT_EQ(uint8_t(bytes[23]), 2);
  EXPECT_EQ(bytes.substr(bytes.size() - 8, 4), "IEND");
  EXPECT_EQ(filesInDirectory(), 1u);
}

}  // namespace
}  // namespace restlab
