// Limits of a viewer: unread pictures, files, memory.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "core/base/memory.h"
#include "experiments/runner/suite/image_settings.h"
#include "experiments/view/view_memory.h"
#include "experiments/view/view_session_file.h"
#include "tests/view/loop_fixture.h"

namespace restlab::view_test {
namespace {

namespace fs = std::filesystem;

class ViewLimitsTest : public ViewLoopTest {};

TEST_F(ViewLimitsTest, SavedSessionsAreCounted) {
  start();
  Page page(url());
  page.say({{"do", "pause"}, {"on", true}});
  const auto count = [&] {
    return std::distance(fs::directory_iterator(folder()), fs::directory_iterator());
  };
  for (uint32_t i = 0; i < ViewLoop::kMostSessions; ++i)
    page.say({{"do", "save"}, {"name", fmt::format("n{}", i)}});
  for (uint32_t i = 0; i < ViewLoop::kMostSessions; ++i) page.waitFor("saved");
  EXPECT_EQ(count(), ViewLoop::kMostSessions);
  page.say({{"do", "save"}, {"name", "one more"}});
  const Json said = page.waitFor("said", [](const Json& s) {
    return s["text"].get<std::string>().find("most") != std::string::npos;
  });
  EXPECT_NE(said["text"].get<std::string>().find("256 sessions"), std::string::npos) << said;
  EXPECT_EQ(page.waitFor("saved")["name"], "one-more.toml") << "the page has it all the same";
  page.say({{"do", "measure"}});
  EXPECT_NE(page.waitFor("error")["text"].get<std::string>().find("256 sessions"),
            std::string::npos);
  EXPECT_EQ(count(), ViewLoop::kMostSessions);
}

TEST_F(ViewLimitsTest, FilesAreNamedInAnyScript) {
  start();
  Page page(url());
  page.say({{"do", "save"}, {"name", "K\u00fcche 2"}});
  EXPECT_EQ(page.waitFor("saved")["name"], "K\u00fcche-2.toml");
  EXPECT_TRUE(fs::exists(folder() / "K\u00fcche-2.toml"));
}

// Unread pictures are kept for a page: a page that does not read them is refused more.
TEST_F(ViewLimitsTest, PicturesThatAPageDoesNotTakeAreBoundedByBytes) {
  start();
  Page page(url());
  page.say({{"do", "pause"}, {"on", true}});
  page.say({{"do", "resolution"}, {"width", 512}, {"height", 512}});
  page.waitFor("state", [](const Json& state) { return state["width"] == 512; });
  constexpr int kAsked = 16;
  for (int i = 0; i < kAsked; ++i) page.say({{"do", "picture"}, {"image", 0}});
  // Read nothing until all was answered: the session that is asked for last has its file.
  page.say({{"do", "save"}, {"name", "last"}});
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!fs::exists(folder() / "last.toml") && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  std::vector<size_t> sent;
  int refused = 0;
  while (int(sent.size()) + refused < kAsked) {
    const Json text = page.next();
    ASSERT_FALSE(text.is_null());
    if (text["say"] == "file") sent.push_back(text["base64"].get<std::string>().size());
    if (text["say"] != "error") continue;
    EXPECT_NE(text["text"].get<std::string>().find("picture: the page has not taken"),
              std::string::npos)
        << text;
    ++refused;
  }
  ASSERT_FALSE(sent.empty());
  EXPECT_GT(refused, 0) << sent.size() << " pictures of " << sent[0] << " bytes waited";
  page.say({{"do", "picture"}, {"image", 0}});
  page.waitFor("file");
}

// Each part alone would fit.
TEST_F(ViewLimitsTest, MemoryIsThatOfAllTogether) {
  const std::vector<size_t> panes = {200, 100};
  const uint64_t all = viewBytesPerPixel(panes, 12);
  EXPECT_GT(all, 2u * 300 + 4 * 12);
  EXPECT_NO_THROW(requireViewMemory(1000, 1000, all, 0, all * 1000 * 1000));
  EXPECT_NO_THROW(requireViewMemory(1000, 1000, all, all, all * (1000 * 1000 - 1)));
  EXPECT_THROW(requireViewMemory(1000, 1000, all, 0, all * 1000 * 1000 - 1), Error);
  EXPECT_NO_THROW(requireViewMemory(1u << 31, 1u << 31, all, 0, std::nullopt));

  const uint64_t available = availableMemory().value_or(0);
  if (available == 0) GTEST_SKIP() << "the system does not say how much memory there is";
  LiveView view(cornellBox(), {smallPane("restir_gi"), smallPane("path")}, {});
  const uint64_t largest =
      std::max(view.session(0).bytesPerPixel(), view.session(1).bytesPerPixel());
  const auto side = uint32_t(std::sqrt(0.7 * double(available) / double(largest)));
  if (side > kMaxSide) GTEST_SKIP() << "this machine has memory for any image";
  const uint64_t epoch = view.epoch();
  try {
    view.apply(Resize{side, side});
    FAIL() << "each pane fits, and all together do not";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::deviceUnavailable);
    EXPECT_NE(std::string(error.what()).find("both panes, their copies and the reference"),
              std::string::npos)
        << error.what();
  }
  EXPECT_EQ(view.epoch(), epoch);
  EXPECT_TRUE(view.renderFrames()) << "it shows what it did";
}

}  // namespace
}  // namespace restlab::view_test
