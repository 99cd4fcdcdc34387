// Systems that lack a package or library, or have an old one: ./lab and CMake report each in one
// line.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/lint/command.h"

namespace restlab::lint {
namespace {

namespace fs = std::filesystem;

class Setup : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(RESTLAB_LINT_FOLDER) / (std::string("setup-") + test->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "bin");
  }

  void write(const fs::path& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }

  // Puts a program of this name before the system's own.
  void fake(const std::string& name, const std::string& script) const {
    write(fs::path("bin") / name, "#!/bin/sh\n" + script);
    fs::permissions(folder_ / "bin" / name, fs::perms::owner_all);
  }

  // Sets up the launcher in a tree of its own, on a system with the given packages ("name status
  // version").
  void system(const std::string& installed, const std::string& offered = "") const {
    for (const char* file : {"lab", "CMakePresets.json"})
      fs::copy_file(fs::path(RESTLAB_SOURCE_DIR) / file, folder_ / file);
    write("packages.txt",
          "[build]\n"
          "libray-dev (>= 3.13)  # comment\n"
          "liboldnew1-dev (>= 9) | libnew-dev (>= 2.1)\n"
          "libany-dev\n"
          "[test]\n"
          "libtest-dev\n"
          "[test-optional]\n"
          "browser\n");
    fake("dpkg-query", "cat <<'END'\n" + installed + "END\n");
    fake("apt-cache", "shift 2\ncase $1 in\n" + offered + "*) ;;\nesac\n");
    fake("apt-get", "exit 0\n");
    fake("sudo", "[ \"$1\" = -n ] && shift\nexec \"$@\"\n");
    // Stub: neither configures nor builds.
    fake("cmake", "echo 'missing library: Ray 3.13 or later (package libray-dev)'\nexit 1\n");
  }

  CommandResult lab(const std::string& words) const {
    return runCommand("PATH='" + (folder_ / "bin").string() + "':$PATH '" +
                      (folder_ / "lab").string() + "' " + words);
  }

  fs::path folder_;
};

TEST_F(Setup, OldPackageIsNamedWithTheVersionNeeded) {
  if (runCommand("dpkg --version").status != 0) GTEST_SKIP() << "no dpkg here";
  system(
      "libray-dev installed 3.12.2+dfsg-1\nlibnew-dev installed 7:2.1.5-2\n"
      "libany-dev installed 1.0-1\n",
      "libray-dev) echo '  Candidate: 3.12.2+dfsg-1' ;;\n");
  const CommandResult result = lab("-y list scenes");
  EXPECT_EQ(result.status, 2) << result.output;
  EXPECT_EQ(result.output,
            "lab: installing 1 package with apt-get\n"
            "lab: older package: libray-dev 3.12.2+dfsg-1 is installed, needed is libray-dev (>= "
            "3.13) (this system offers 3.12.2+dfsg-1)\n"
            "lab: apt-get could not install them\n");
}

TEST_F(Setup, MissingPackageIsNamedWithItsAlternatives) {
  if (runCommand("dpkg --version").status != 0) GTEST_SKIP() << "no dpkg here";
  // The epoch of a package is not part of the program's version.
  system(
      "libray-dev installed 4.3.3-1\nliboldnew1-dev installed 9:8.9-1\n"
      "libany-dev deinstalled 1.0-1\n");
  const CommandResult result = lab("-y list scenes");
  EXPECT_EQ(result.status, 2) << result.output;
  EXPECT_NE(result.output.find("\nlab: older package: liboldnew1-dev 9:8.9-1 is installed, needed "
                               "is liboldnew1-dev (>= 9) or libnew-dev (>= 2.1)\n"
                               "lab: missing package: libany-dev\n"),
            std::string::npos)
      << result.output;
}

TEST_F(Setup, OptionalPackageStopsNothing) {
  if (runCommand("dpkg --version").status != 0) GTEST_SKIP() << "no dpkg here";
  system(
      "libray-dev installed 4.3.3-1\nlibnew-dev installed 2.1-1\nlibany-dev installed 1-1\n"
      "libtest-dev installed 1-1\n");
  const CommandResult result = lab("test");
  // The launcher goes on to CMake and passes on its line without the rest of the log.
  EXPECT_EQ(result.status, 1) << result.output;
  EXPECT_EQ(result.output.find("lab: missing package: browser; tests that need it are skipped\n"),
            0u)
      << result.output;
  EXPECT_NE(result.output.find("\nlab: missing library: Ray 3.13 or later (package libray-dev)\n"
                               "lab: configuring failed"),
            std::string::npos)
      << result.output;
  EXPECT_EQ(result.output.find("\nmissing library"), std::string::npos) << result.output;
}

TEST_F(Setup, LibrariesOfCMake) {
  write("packages.txt",
        "libray-dev (>= 3.13)\nlibabsent-dev (>= 2)\nlibfit-dev (>= 1.2) # fits\nlibnext-dev (>= "
        "1)\nlibfile-dev\n");
  const auto package = [&](const std::string& name, const std::string& version) {
    write(name + "Config.cmake", "");
    write(name + "ConfigVersion.cmake",
          "set(PACKAGE_VERSION " + version + ")\nset(PACKAGE_VERSION_COMPATIBLE FALSE)\n");
  };
  package("Ray", "3.12.2");
  package("Fit", "1.2");
  package("Next", "5.0.1");
  write("CMakeLists.txt",
        "cmake_minimum_required(VERSION 3.25)\nproject(setup NONE)\n"
        "include(" RESTLAB_SOURCE_DIR
        "/cmake/libraries.cmake)\n"
        "rl_need_library(Ray libray-dev CONFIG)\n"
        "rl_need_library(Absent libabsent-dev CONFIG)\n"
        "rl_need_library(Fit libfit-dev CONFIG)\n"
        "rl_need_library(Next libnext-dev BELOW 5 CONFIG)\n"
        "rl_need_file(FILE_DIR absent_file.h libfile-dev)\n"
        "rl_stop_for_libraries()\n"
        "message(FATAL_ERROR \"went on\")\n");
  const std::string at = folder_.string();
  const CommandResult result =
      runCommand("cmake -S '" + at + "' -B '" + at + "/build' -D CMAKE_PREFIX_PATH='" + at + "'");
  EXPECT_NE(result.status, 0);
  EXPECT_NE(result.output.find("unfit library: Ray 3.12.2 in " + at +
                               ": 3.13 or later is needed (package libray-dev)\n"
                               "missing library: Absent 2 or later (package libabsent-dev)\n"
                               "unfit library: Next 5.0.1 in " +
                               at +
                               ": 1 or later and below 5 is needed (package libnext-dev)\n"
                               "missing library: absent_file.h (package libfile-dev)\n"),
            std::string::npos)
      << result.output;
  EXPECT_EQ(result.output.find("Fit"), std::string::npos) << result.output;
  EXPECT_EQ(result.output.find("went on"), std::string::npos) << result.output;
}

}  // namespace
}  // namespace restlab::lint
