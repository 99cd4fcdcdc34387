// Tests of the images that a running tev gets, and that the viewer does not wait for tev.
#include <algorithm>
#include <chrono>
#include <set>

#include "tests/view/loop_fixture.h"
#include "tests/view/tev_server.h"

namespace restlab::view_test {
namespace {

using Clock = std::chrono::steady_clock;

class TevTest : public ViewLoopTest {
 protected:
  void SetUp() override {
    ViewLoopTest::SetUp();
    tev_ = TevAddress{"127.0.0.1", server_.port()};
  }
  void TearDown() override {
    server_.hangUp();
    ViewLoopTest::TearDown();
  }

  TevServer server_;
};

void expectWhole(const TevMessage& update, int32_t width, int32_t height) {
  EXPECT_EQ(update.operation, 6);
  EXPECT_EQ(update.x, 0);
  EXPECT_EQ(update.y, 0);
  EXPECT_EQ(update.width, width);
  EXPECT_EQ(update.height, height);
  EXPECT_EQ(update.channels, (std::vector<std::string>{"R", "G", "B"}));
  EXPECT_EQ(update.offsets, (std::vector<int64_t>{0, 1, 2}));
  EXPECT_EQ(update.strides, (std::vector<int64_t>{3, 3, 3}));
  EXPECT_EQ(update.data.size(), size_t(3 * width * height));
}

void expectSame(const TevMessage& update, const Image& image) {
  expectWhole(update, int32_t(image.width), int32_t(image.height));
  ASSERT_EQ(update.data.size(), 3 * image.pixels.size());
  for (size_t i = 0; i < image.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c)
      ASSERT_EQ(update.data[3 * i + size_t(c)], image.pixels[i][c]) << "pixel " << i;
}

TEST_F(TevTest, GetsPanesAndReferenceWithoutAPage) {
  start();
  server_.accept();
  std::set<std::string> created, shown;
  while (shown.size() < 3) {
    const std::optional<TevMessage> message = server_.next();
    ASSERT_TRUE(message);
    EXPECT_FALSE(message->grabsFocus);
    if (message->operation == 4) {
      EXPECT_EQ(message->width, 24);
      EXPECT_EQ(message->height, 16);
      EXPECT_EQ(message->channels, (std::vector<std::string>{"R", "G", "B"}));
      EXPECT_TRUE(created.insert(message->name).second) << message->name << " is made twice";
      continue;
    }
    EXPECT_EQ(created.count(message->name), 1u) << message->name << " is not there yet";
    expectWhole(*message, 24, 16);
    shown.insert(message->name);
  }
  EXPECT_EQ(shown, (std::set<std::string>{"restlab A", "restlab B", "restlab reference"}));
}

TEST_F(TevTest, GetsTheLastFrameTwiceASecondAtMost) {
  start();
  server_.accept();
  Page page(url());
  const auto begun = Clock::now();
  page.waitFor("numbers", [](const Json& n) { return n["age"] > 200; });
  page.say({{"do", "resolution"}, {"width", 10}, {"height", 7}});
  page.waitFor("numbers", [](const Json& n) { return n["transport"]["width"] == 10; });
  page.say({{"do", "pause"}, {"on", true}});
  page.waitFor("state", [](const Json& state) { return state["paused"]; });
  std::this_thread::sleep_for(3 * TevSender::kInterval);
  stop();
  const double seconds = std::chrono::duration<double>(Clock::now() - begun).count();
  std::map<std::string, TevMessage> last;
  std::map<std::string, int> updates, creations;
  while (const std::optional<TevMessage> message = server_.next(500)) {
    ++(message->operation == 4 ? creations : updates)[message->name];
    if (message->operation == 6) last[message->name] = *message;
  }
  expectSame(last["restlab A"], view_->session(0).radiance());
  expectSame(last["restlab B"], view_->session(1).radiance());
  EXPECT_EQ(creations["restlab A"], 2) << "one of each size";
  for (const auto& [name, count] : updates) EXPECT_LE(count, 2.0 * seconds + 1.5) << name;
  EXPECT_GE(updates["restlab A"], 2);
}

TEST_F(TevTest, DelaysNothingWhereItDoesNotRead) {
  start();
  server_.accept();
  Page page(url());
  // Three images of 3 MB every half second: more than the connection can buffer.
  page.say({{"do", "resolution"}, {"width", 512}, {"height", 512}});
  const auto begun = Clock::now();
  Clock::duration longest{};
  for (auto last = begun; Clock::now() - begun < std::chrono::seconds(4);) {
    page.waitFor("numbers");
    longest = std::max(longest, Clock::now() - last);
    last = Clock::now();
  }
  // tev never reads: waiting for it would never end.
  EXPECT_LT(longest, std::chrono::seconds(20));
  const auto stopping = Clock::now();
  stop();
  loop_.reset();
  EXPECT_LT(Clock::now() - stopping, std::chrono::seconds(20))
      << "it ends in the middle of a message";
}

TEST(TevAddresses, AreHostsWithOrWithoutPorts) {
  const auto expect = [](const std::string& text, const std::string& host, uint16_t port) {
    const TevAddress address = parseTevAddress(text);
    EXPECT_EQ(address.host, host) << text;
    EXPECT_EQ(address.port, port) << text;
  };
  expect("localhost", "localhost", 14158);
  expect("127.0.0.1:80", "127.0.0.1", 80);
  expect("[::1]:65535", "::1", 65535);
  expect("[::1]", "::1", 14158);
  for (const char* wrong :
       {":80", "a:", "a:0", "a:65536", "a:8x", "[::1", "[::1]80", "[]:3", "::1"})
    EXPECT_THROW(parseTevAddress(wrong), Error) << wrong;
}

}  // namespace
}  // namespace restlab::view_test
