// Kernels that are compiled when a scene asks for them: once, kept where only the user can write,
// and never loaded where they are not what they should be. Whatever fails is one line, and built-in
// kernels run.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include "core/backend/units/kernel_units.h"
#include "core/dialect/features.h"

namespace restlab::unit {
namespace {

namespace fs = std::filesystem;

const KernelUnit kSmall{"gbuffer", rl::RL_FEATURE_ALPHA | rl::RL_FEATURE_TEXTURES};
const KernelUnit kOther{"gbuffer", rl::RL_FEATURE_ALPHA | rl::RL_FEATURE_VERTEX_COLORS};

// A folder of its own, and compilers that are scripts.
class KernelUnitsTest : public ::testing::Test {
 protected:
  KernelUnitsTest() {
    std::string path = (fs::temp_directory_path() / "restlab-units-XXXXXX").string();
    folder_ = mkdtemp(path.data());
    units_ = folder_ / "units";
  }
  ~KernelUnitsTest() override { fs::remove_all(folder_); }

  UnitCompiler script(const std::string& body) const {
    UnitCompiler compiler = unitCompiler();
    const fs::path file = folder_ / "compiler";
    std::ofstream(file) << "#!/bin/sh\n" << body << "\n";
    fs::permissions(file, fs::perms::owner_all);
    compiler.program = file.string();
    return compiler;
  }
  // The compiler, which also notes each call.
  UnitCompiler counting() const {
    return script("echo call >> " + (folder_ / "calls").string() + "\nexec " +
                  unitCompiler().program + " \"$@\"");
  }
  size_t calls() const {
    std::ifstream stream(folder_ / "calls");
    return size_t(std::count(std::istreambuf_iterator<char>(stream), {}, '\n'));
  }
  std::vector<fs::path> files(const std::string& extension) const {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(units_))
      if (entry.path().extension() == extension) found.push_back(entry.path());
    return found;
  }
  size_t workFolders() const {
    return size_t(std::count_if(fs::directory_iterator(units_), {}, [](const auto& entry) {
      return entry.path().filename().string().rfind("work-", 0) == 0;
    }));
  }
  // Expects that nothing was made, and one notice that has all `words`.
  void expectFailure(const UnitCompiler& compiler, const fs::path& folder,
                     const std::vector<std::string>& words) const {
    KernelUnits units(compiler, folder);
    StartupReport report;
    EXPECT_FALSE(units.prepare({kSmall, kOther}, report));
    EXPECT_EQ(units.find(kSmall), nullptr);
    EXPECT_FALSE(units.areThere());
    ASSERT_EQ(report.notices.size(), 1u) << words.front();
    for (const std::string& word : words)
      EXPECT_NE(report.notices[0].find(word), std::string::npos) << report.notices[0];
    EXPECT_EQ(report.notices[0].find('\n'), std::string::npos);
    // Nothing is tried again, and nothing said twice.
    EXPECT_FALSE(units.prepare({kSmall}, report));
    EXPECT_EQ(report.notices.size(), 1u);
  }
  // Expects that a damaged or foreign file is not loaded but made anew, with one notice.
  void expectMadeAnew(const std::string& word) const {
    KernelUnits units(counting(), units_);
    const size_t before = calls();
    StartupReport report;
    EXPECT_TRUE(units.prepare({kSmall}, report));
    EXPECT_NE(units.find(kSmall), nullptr);
    EXPECT_EQ(calls(), before + 1) << word;
    ASSERT_GE(report.notices.size(), 1u) << word;
    EXPECT_NE(report.notices[0].find(word), std::string::npos) << report.notices[0];
  }
  void make(const KernelUnit& unit) const {
    KernelUnits units(counting(), units_);
    StartupReport report;
    ASSERT_TRUE(units.prepare({unit}, report)) << report.notices.at(0);
  }

  // Puts bytes in the place of a unit that this process may have loaded.
  void replace(const fs::path& file, const std::string& bytes) const {
    std::ofstream(folder_ / "bytes", std::ios::binary) << bytes;
    fs::rename(folder_ / "bytes", file);
  }

  fs::path folder_, units_;
};

std::string bytesOfFile(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST_F(KernelUnitsTest, AreMadeOnceAndKeptForTheUserAlone) {
  {
    KernelUnits units(counting(), units_);
    std::vector<std::pair<size_t, size_t>> progress;
    units.onProgress([&](size_t done, size_t total) { progress.emplace_back(done, total); });
    StartupReport report;
    ASSERT_TRUE(units.prepare({kSmall, kOther, kSmall}, report));
    EXPECT_NE(units.find(kSmall), nullptr);
    EXPECT_NE(units.find(kSmall), units.find(kOther));
    ASSERT_EQ(report.kernels.size(), 2u);
    EXPECT_FALSE(report.kernels[0].fromDisk);
    EXPECT_GT(report.timeMs, 0.0);
    EXPECT_TRUE(units.prepare({kSmall}, report));
    EXPECT_EQ(report.kernels.size(), 2u) << "it was ready";
    EXPECT_EQ(progress, (std::vector<std::pair<size_t, size_t>>{{0, 2}, {1, 2}, {2, 2}}));
  }
  EXPECT_EQ(calls(), 2u);
  EXPECT_EQ(files(".so").size(), 2u);
  EXPECT_EQ(workFolders(), 0u) << "what the compiler left";
  struct stat info = {};
  ASSERT_EQ(stat(units_.c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0700u);

  KernelUnits again(counting(), units_);
  StartupReport report;
  EXPECT_TRUE(again.prepare({kSmall, kOther}, report));
  EXPECT_EQ(calls(), 2u);
  ASSERT_EQ(report.kernels.size(), 2u);
  EXPECT_TRUE(report.kernels[0].fromDisk && report.kernels[1].fromDisk);
  EXPECT_TRUE(report.notices.empty());
}

// Other flags stand for another compiler, source or mask: all are in the key.
TEST_F(KernelUnitsTest, AnotherBuildHasUnitsOfItsOwn) {
  make(kSmall);
  UnitCompiler other = counting();
  other.flags.emplace_back("-DSOMETHING");
  KernelUnits units(other, units_);
  StartupReport report;
  EXPECT_TRUE(units.prepare({kSmall}, report));
  EXPECT_EQ(calls(), 2u);
  EXPECT_EQ(files(".so").size(), 2u);
  EXPECT_TRUE(report.notices.empty());
}

TEST_F(KernelUnitsTest, DamagedAndForeignFilesAreMadeAnew) {
  make(kSmall);
  const fs::path file = files(".so").at(0);
  const std::string right = bytesOfFile(file);
  replace(file, right.substr(0, right.size() / 2));
  expectMadeAnew("is damaged");
  std::string wrong = right;
  wrong[wrong.size() / 2] ^= 1;
  replace(file, wrong);
  expectMadeAnew("is damaged");
  replace(file, "");
  expectMadeAnew("is damaged");

  make(kOther);
  for (const fs::path& other : files(".so"))
    if (other != file) replace(file, bytesOfFile(other));
  expectMadeAnew("of another key");

  fs::permissions(file, fs::perms::others_write, fs::perm_options::add);
  expectMadeAnew("others can write");

  fs::rename(file, folder_ / "elsewhere.so");
  fs::create_symlink(folder_ / "elsewhere.so", file);
  expectMadeAnew(file.string());
  EXPECT_FALSE(fs::is_symlink(file));

  if (geteuid() != 0) return;
  ASSERT_EQ(chown(file.c_str(), 65534, 65534), 0);
  expectMadeAnew("belongs to another user");
}

// A file with the right check that is no unit at all.
TEST_F(KernelUnitsTest, AnObjectThatDoesNotLoadIsNotUsed) {
  expectFailure(script("while [ \"$1\" != -o ]; do shift; done; echo nonsense > \"$2\""), units_,
                {"does not load"});
}

TEST_F(KernelUnitsTest, FoldersThatCannotBeUsedAreNamed) {
  std::ofstream(folder_ / "file") << "";
  expectFailure(unitCompiler(), folder_ / "file" / "units", {"file/units", "Not a directory"});
  expectFailure(unitCompiler(), folder_ / "file", {"is not a folder"});
  expectFailure(unitCompiler(), {}, {"HOME"});
  fs::create_directory(units_);
  fs::permissions(units_, fs::perms::others_write, fs::perm_options::add);
  expectFailure(unitCompiler(), units_, {"others can write to it"});
  fs::permissions(units_, fs::perms::others_write, fs::perm_options::remove);
  if (geteuid() != 0) return;
  ASSERT_EQ(chown(units_.c_str(), 65534, 65534), 0);
  expectFailure(unitCompiler(), units_, {"belongs to another user"});
}

TEST_F(KernelUnitsTest, CompilersThatFailAreNamed) {
  UnitCompiler missing = unitCompiler();
  missing.program = (folder_ / "none").string();
  EXPECT_FALSE(KernelUnits(missing, units_).areThere());
  expectFailure(missing, units_, {"none", "No such file"});
  expectFailure(script("echo \"$TMPDIR/unit.cpp:7: error: boom\" >&2; exit 1"), units_,
                {"compiler: unit.cpp:7: error: boom"});
  expectFailure(script("exit 3"), units_, {"exit code 3"});
  expectFailure(script("kill -SEGV $$"), units_, {"Segmentation"});
  expectFailure(script("exit 0"), units_, {"wrote no file"});
  UnitCompiler other = unitCompiler();
  other.version = "another";
  expectFailure(other, units_, {"another one than that of the program"});
  EXPECT_EQ(workFolders(), 0u);
}

// The compiler's own children end with it.
TEST_F(KernelUnitsTest, ACompilerThatHangsIsEnded) {
  UnitCompiler compiler =
      script("sleep 300 &\necho $! >> " + (folder_ / "calls").string() + "\nwait");
  compiler.limit = std::chrono::milliseconds(300);
  expectFailure(compiler, units_, {"ended after 0.3 s"});
  std::ifstream stream(folder_ / "calls");
  pid_t child = 0;
  ASSERT_TRUE(stream >> child);
  const auto lives = [&] {
    std::ifstream stat(fmt::format("/proc/{}/stat", child));
    std::string number, name, state;  // Z: ended, and nobody has asked how
    return stat >> number >> name >> state && state != "Z";
  };
  for (int i = 0; i < 100 && lives(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_FALSE(lives()) << child;
}

// A limit on the size of files stands for a full disk: for the sources, and for the object.
TEST_F(KernelUnitsTest, AFullDiskIsNamed) {
  signal(SIGXFSZ, SIG_IGN);
  struct rlimit before = {};
  getrlimit(RLIMIT_FSIZE, &before);
  for (const rlim_t bytes : {rlim_t(1000), rlim_t(30000)}) {
    struct rlimit limit = before;
    limit.rlim_cur = bytes;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
    KernelUnits units(unitCompiler(), units_);
    StartupReport report;
    const bool isMade = units.prepare({{"path", rl::RL_FEATURE_GLTF}}, report);
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_FALSE(isMade) << bytes;
    ASSERT_EQ(report.notices.size(), 1u) << bytes;
    EXPECT_NE(report.notices[0].find("kernels are not compiled"), std::string::npos);
    EXPECT_TRUE(files(".so").empty());
  }
}

TEST_F(KernelUnitsTest, TwoTakeTurns) {
  bool isMade[2] = {};
  {
    std::vector<std::jthread> both;
    for (bool& made : isMade) {
      both.emplace_back([&] {
        KernelUnits units(counting(), units_);
        StartupReport report;
        made = units.prepare({kSmall}, report);
      });
    }
  }
  EXPECT_TRUE(isMade[0] && isMade[1]);
  EXPECT_EQ(calls(), 1u);
}

// A process that is killed while its compiler runs keeps no other one from its turn.
TEST_F(KernelUnitsTest, AKilledProcessLeavesNothingThatMatters) {
  const UnitCompiler slow = script("echo call >> " + (folder_ / "calls").string() + "\nsleep 2");
  const pid_t child = fork();
  if (child == 0) {
    KernelUnits units(slow, units_);
    StartupReport report;
    units.prepare({kSmall}, report);
    _exit(0);
  }
  while (calls() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_EQ(workFolders(), 1u);
  make(kSmall);
  EXPECT_EQ(calls(), 2u);
  // Its folder goes when it is a day old.
  for (const auto& entry : fs::directory_iterator(units_))
    fs::last_write_time(entry.path(), fs::file_time_type::clock::now() - std::chrono::hours(25));
  make(kOther);
  EXPECT_EQ(workFolders(), 0u);
}

TEST_F(KernelUnitsTest, UnitsOutOfUseAreDeletedWhereThereAreTooMany) {
  make(kSmall);
  const fs::path old = files(".so").at(0);
  fs::last_write_time(old, fs::file_time_type::clock::now() - std::chrono::hours(1));
  make(kOther);
  const UnitFolder folder(units_);
  const uint64_t bytes = fs::file_size(old);
  folder.prune(10 * bytes);
  EXPECT_EQ(files(".so").size(), 2u);
  folder.prune(2 * bytes - bytes / 2);  // half of it has room for neither
  EXPECT_TRUE(files(".so").empty());
  make(kSmall);
  make(kOther);
  fs::last_write_time(old, fs::file_time_type::clock::now() - std::chrono::hours(1));
  make(kSmall);  // uses it
  const auto age = fs::file_time_type::clock::now() - fs::last_write_time(old);
  EXPECT_LT(age, std::chrono::minutes(10)) << "a unit that is used is young again";
}

}  // namespace
}  // namespace restlab::unit
