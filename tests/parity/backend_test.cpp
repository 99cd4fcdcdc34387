// core/backend under failures: damaged files, broken kernels, too little memory, unknown devices;
// and its allocator in normal use.
#include <gtest/gtest.h>

#include <stdlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/backend/glsl_compiler.h"
#include "core/base/error.h"
#include "core/frame/session.h"
#include "tests/parity/frames.h"
#include "tests/parity/kernel_runner.h"
#include "tests/parity/ris_kernel.h"

namespace restlab::parity {
namespace {

namespace fs = std::filesystem;

// Line and exit code of the error that `run` throws.
struct Failure {
  std::string line;
  ExitCode code = ExitCode::ok;
  bool holds(const std::string& fragment) const { return line.find(fragment) != std::string::npos; }
};

template <typename F>
Failure failureOf(const F& run) {
  try {
    run();
  } catch (const Error& error) {
    return {error.what(), error.code()};
  }
  return {"nothing was thrown"};
}

class BackendTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!hasVulkan()) GTEST_SKIP() << kNoDevice;
  }
};

// Opens a device with its own folder for compiled kernels.
class KernelCacheTest : public BackendTest {
 protected:
  void SetUp() override {
    BackendTest::SetUp();
    if (IsSkipped()) return;
    std::string name = (fs::temp_directory_path() / "restlab-kernels-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr) << std::strerror(errno);
    folder_ = name;
  }
  void TearDown() override {
    std::error_code ignored;
    if (!folder_.empty()) fs::remove_all(folder_, ignored);
  }

  // Returns the results of a kernel; `report` tells where the kernel came from.
  std::vector<rl::RisResult> results(StartupReport& report) const {
    TestDevice device = openDevice({}, folder_);
    const rl::FrameData frame = plainFrame(32, 32, 5);
    const rl::RisParams params{8};
    std::vector<rl::RisResult> found(1024);
    const size_t bytes = found.size() * sizeof(rl::RisResult);
    const GpuBuffer buffer = device.memory->allocate(bytes, MemoryKind::device);
    runOnDevice(device, "tests/parity/ris_kernel.h", "tests/parity/ris_kernel.glsl", 0, frame,
                {buffer.address}, &params, sizeof params);
    device.memory->read(buffer, found.data(), bytes);
    device.memory->free(buffer);
    report = device.report;
    return found;
  }

  std::vector<fs::path> files() const {
    std::vector<fs::path> all;
    for (const auto& entry : fs::directory_iterator(folder_)) all.push_back(entry.path());
    std::sort(all.begin(), all.end());
    return all;
  }

  fs::path folder_;
};

bool isSame(const std::vector<rl::RisResult>& a, const std::vector<rl::RisResult>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

enum class Damage { truncated, flipped, emptied };

void damage(const fs::path& file, Damage how) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  in.close();
  ASSERT_GT(bytes.size(), 40u) << file;
  if (how == Damage::truncated) bytes.resize(bytes.size() / 2);
  if (how == Damage::flipped) bytes[bytes.size() - 7] = char(bytes[bytes.size() - 7] ^ 1);
  if (how == Damage::emptied) bytes.clear();
  std::ofstream(file, std::ios::binary) << bytes;
}

TEST_F(KernelCacheTest, DamagedFilesAreCompiledAnew) {
  StartupReport report;
  const std::vector<rl::RisResult> good = results(report);
  EXPECT_TRUE(report.notices.empty()) << report.notices.front();
  ASSERT_EQ(report.kernels.size(), 1u);
  EXPECT_FALSE(report.kernels[0].fromDisk);
  // Two files: the kernel's and the driver's own.
  ASSERT_EQ(files().size(), 2u);
  EXPECT_TRUE(isSame(results(report), good));
  EXPECT_TRUE(report.kernels.at(0).fromDisk);
  for (const Damage how : {Damage::truncated, Damage::flipped, Damage::emptied}) {
    for (const fs::path& file : files()) {
      SCOPED_TRACE(file.filename().string() + ", damage " + std::to_string(int(how)));
      damage(file, how);
      EXPECT_TRUE(isSame(results(report), good));
      ASSERT_EQ(report.notices.size(), 1u);
      EXPECT_NE(report.notices[0].find(file.string()), std::string::npos) << report.notices[0];
      EXPECT_EQ(report.kernels.at(0).fromDisk, file.extension() != ".spv");
      // The file compiled anew is kept.
      EXPECT_TRUE(isSame(results(report), good));
      EXPECT_TRUE(report.notices.empty()) << report.notices.front();
      EXPECT_TRUE(report.kernels.at(0).fromDisk);
    }
  }
}

TEST_F(KernelCacheTest, FolderThatCannotBeWrittenCostsANotice) {
  fs::remove_all(folder_);
  std::ofstream(folder_) << "a file, where the folder should be";
  StartupReport report;
  results(report);
  ASSERT_FALSE(report.notices.empty());
  EXPECT_NE(report.notices[0].find("not kept"), std::string::npos) << report.notices[0];
}

// Default folder of sessions.
TEST(KernelCacheFolder, IsBelowTheUsersCache) {
  ASSERT_NE(std::getenv("XDG_CACHE_HOME"), nullptr) << "kernel_runner.cpp sets it";
  EXPECT_EQ(KernelCache::defaultFolder(),
            fs::path(std::getenv("XDG_CACHE_HOME")) / "restlab" / "kernels");
}

TEST_F(BackendTest, BrokenKernelIsNamedWithFileAndLine) {
  TestDevice device = openDevice();
  const std::string file = "integrators/path/path.glsl";
  const SourceReader good = readBelow({RESTLAB_SOURCE_DIR, RESTLAB_GENERATED_DIR});
  const SourceReader read = [&](const std::string& path) -> std::optional<std::string> {
    if (path == file)
      return "// One line that is right.\nRL_FN void kernelMain(RL_IN(uvec2) p) {\n"
             "  float x = missing(p);\n}\n";
    return good(path);
  };
  const GlslKernel kernel{"integrators/path/path.h", file, "core/geometry/trace_bvh.glsl"};
  StartupReport report;
  const Failure failure = failureOf(
      [&] { device.kernels->pipeline(kernel, "path", rl::RL_FEATURE_AREA_LIGHTS, read, report); });
  EXPECT_EQ(failure.code, ExitCode::deviceUnavailable) << failure.line;
  EXPECT_TRUE(failure.holds(file + ":3:")) << failure.line;
  EXPECT_TRUE(failure.holds("missing")) << failure.line;
  EXPECT_EQ(failure.line.find('\n'), std::string::npos) << failure.line;
  // The device still works, and so does the kernel once its file is complete.
  EXPECT_NE(device.kernels->pipeline(kernel, "path", rl::RL_FEATURE_AREA_LIGHTS, good, report),
            VkPipeline{});
}

TEST_F(BackendTest, TooManyPixelsAreRefusedWithTheSizes) {
  const auto scene = sceneNamed("cornell-box");
  SessionConfig config = configOf({"restir_gi", "unbiased", "pixel"}, kVulkan, 16384, 16384, 1);
  const Failure failure = failureOf([&] { const Session session(scene, config); });
  EXPECT_EQ(failure.code, ExitCode::deviceUnavailable) << failure.line;
  EXPECT_TRUE(failure.holds("16384x16384")) << failure.line;
  EXPECT_TRUE(failure.holds("MiB")) << failure.line;
  EXPECT_EQ(failure.line.find('\n'), std::string::npos) << failure.line;
  config = configOf({"template", "", ""}, kVulkanSpecialised, 16, 16, 1);
  Session session(scene, config);
  session.frame();
  EXPECT_GT(glm::length(session.radiance().pixels[8 * 16 + 8]), 0.0f);
}

TEST_F(BackendTest, MoreMemoryThanThereIsIsRefused) {
  TestDevice device = openDevice();
  const uint64_t before = device.memory->bytesAllocated();
  const uint64_t available = device.memory->bytesAvailable(MemoryKind::device);
  const Failure failure =
      failureOf([&] { device.memory->allocate(size_t(available) * 2, MemoryKind::device); });
  EXPECT_EQ(failure.code, ExitCode::deviceUnavailable) << failure.line;
  EXPECT_TRUE(failure.holds("MiB")) << failure.line;
  EXPECT_TRUE(failure.holds(device.name())) << failure.line;
  EXPECT_EQ(device.memory->bytesAllocated(), before);
}

TEST_F(BackendTest, UnknownDeviceIsRefusedWithTheNamesThereAre) {
  SessionConfig config = configOf({"path", "", ""}, kVulkan, 16, 16, 1);
  config.device = "abacus";
  const Failure failure =
      failureOf([&] { const Session session(sceneNamed("cornell-box"), config); });
  EXPECT_EQ(failure.code, ExitCode::deviceUnavailable) << failure.line;
  EXPECT_TRUE(failure.holds("'abacus'")) << failure.line;
  EXPECT_TRUE(failure.holds(vulkanDeviceInfos().front().name)) << failure.line;
}

TEST_F(BackendTest, DeviceIsFoundByAPartOfItsName) {
  std::string name = vulkanDeviceInfos().front().name;
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return char(std::toupper(c)); });
  EXPECT_EQ(openDevice(name.substr(1, 6)).name(), vulkanDeviceInfos().front().name);
}

TEST_F(BackendTest, SmallBuffersShareBlocks) {
  TestDevice device = openDevice();
  VulkanMemory& memory = *device.memory;
  const uint64_t before = memory.bytesAllocated();
  std::vector<GpuBuffer> buffers;
  for (size_t i = 0; i < 1000; ++i)
    buffers.push_back(memory.allocate(1 + 37 * i, MemoryKind::device));
  // 19 MB of buffers fit into one new block of 64 MiB, or into an existing block.
  EXPECT_LE(memory.bytesAllocated() - before, uint64_t{64} << 20);
  std::vector<std::pair<uint64_t, uint64_t>> ranges;
  for (size_t i = 0; i < buffers.size(); ++i) {
    EXPECT_EQ(buffers[i].address % 256, 0u);
    EXPECT_GE(buffers[i].bytes, 1 + 37 * i);
    ranges.emplace_back(buffers[i].address, buffers[i].address + buffers[i].bytes);
  }
  std::sort(ranges.begin(), ranges.end());
  for (size_t i = 1; i < ranges.size(); ++i) EXPECT_LE(ranges[i - 1].second, ranges[i].first);

  // Every buffer keeps its content.
  const auto content = [](size_t i) { return std::vector<uint8_t>(1 + 37 * i, uint8_t(i % 251)); };
  for (size_t i = 0; i < buffers.size(); i += 50)
    memory.write(buffers[i], content(i).data(), content(i).size());
  memory.clear(buffers[1]);
  for (size_t i = 0; i < buffers.size(); i += 50) {
    std::vector<uint8_t> found(content(i).size());
    memory.read(buffers[i], found.data(), found.size());
    EXPECT_EQ(found, content(i)) << i;
  }

  // Neighbours freed in any order merge into one hole, which the next buffer fills.
  const GpuBuffer first = buffers[500], last = buffers[503];
  for (size_t i : {501u, 503u, 500u, 502u}) memory.free(buffers[i]);
  const size_t hole = size_t(last.offset - first.offset) + last.bytes;
  const GpuBuffer filler = memory.allocate(hole, MemoryKind::device);
  EXPECT_EQ(filler.address, first.address);
  const uint64_t full = memory.bytesAllocated();
  memory.free(filler);
  for (size_t i = 0; i < buffers.size(); ++i) {
    if (i < 500 || i > 503) memory.free(buffers[i]);
  }
  EXPECT_LE(memory.bytesAllocated(), full);
  const GpuBuffer whole = memory.allocate(size_t{19} << 20, MemoryKind::device);
  EXPECT_LE(memory.bytesAllocated(), full) << "holes were not joined";
  memory.free(whole);
}

TEST_F(BackendTest, LargeBuffersAreReturned) {
  TestDevice device = openDevice();
  VulkanMemory& memory = *device.memory;
  const uint64_t before = memory.bytesAllocated();
  const size_t bytes = (size_t{40} << 20) + 12345;  // more than the staging buffer, and odd
  const GpuBuffer buffer = memory.allocate(bytes, MemoryKind::device);
  EXPECT_LT(memory.bytesAllocated() - before, bytes + 4096) << "a block of its own size";
  std::vector<uint32_t> words(bytes / 4);
  for (size_t i = 0; i < words.size(); ++i) words[i] = uint32_t(i) * 2654435761u;
  memory.write(buffer, words.data(), words.size() * 4);
  std::vector<uint32_t> found(words.size());
  memory.read(buffer, found.data(), found.size() * 4);
  EXPECT_TRUE(found == words);
  memory.clear(buffer);
  memory.read(buffer, found.data(), found.size() * 4);
  EXPECT_EQ(std::count(found.begin(), found.end(), 0u), std::ptrdiff_t(found.size()));
  memory.free(buffer);
  EXPECT_EQ(memory.bytesAllocated(), before);
}

}  // namespace
}  // namespace restlab::parity
