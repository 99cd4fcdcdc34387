// Tests of the viewer's server from outside: access, messages to clients, and reasons to
// disconnect.
#include "experiments/view/server.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <ctime>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/base/error.h"

namespace restlab {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using Tcp = asio::ip::tcp;
using ErrorCode = boost::system::error_code;

constexpr std::chrono::seconds kPatience{20};
constexpr const char* kUpgrade =
    "Connection: upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";

// Fixture: a server that records its events.
class ViewServerTest : public ::testing::Test {
 protected:
  void start(const ViewServerOptions& given = {}) {
    ViewServerOptions options = given;
    options.page = "<!doctype html><title>the page</title>";
    ViewServerEvents events;
    events.opened = [this](ClientId id) { note([&] { opened_.push_back(id); }); };
    events.closed = [this](ClientId id) { note([&] { closed_.push_back(id); }); };
    events.said = [this](ClientId, const std::string& text) {
      note([&] { said_.push_back(text); });
    };
    server_ = std::make_unique<ViewServer>(options, events);
    token_ = server_->url().substr(server_->url().find("token=") + 6);
  }

  template <class Change>
  void note(const Change& change) {
    {
      const std::lock_guard lock(mutex_);
      change();
    }
    heard_.notify_all();
  }

  template <class Holds>
  bool waitFor(const Holds& holds) {
    std::unique_lock lock(mutex_);
    return heard_.wait_for(lock, kPatience, holds);
  }

  Tcp::socket connect() {
    Tcp::socket socket(io_);
    socket.connect({asio::ip::make_address("127.0.0.1"), server_->port()});
    return socket;
  }

  // Sends bytes and returns the answer, until the server closes the connection.
  std::string answerTo(const std::string& bytes) {
    Tcp::socket socket = connect();
    ErrorCode error;
    asio::write(socket, asio::buffer(bytes), error);
    std::string answer;
    char part[4096];
    while (!error) answer.append(part, socket.read_some(asio::buffer(part), error));
    return answer;
  }

  // Returns status and body.
  std::pair<int, std::string> get(const std::string& target, const std::string& headers = "") {
    const std::string host =
        headers.find("Host:") == std::string::npos ? "Host: localhost\r\n" : "";
    const std::string answer =
        answerTo("GET " + target + " HTTP/1.1\r\n" + host + headers + "\r\n");
    if (answer.size() < 12) return {0, answer};
    return {std::stoi(answer.substr(9)), answer.substr(answer.find("\r\n\r\n") + 4)};
  }

  using Socket = websocket::stream<Tcp::socket>;
  std::unique_ptr<Socket> open(const std::string& target, const std::string& origin = "") {
    auto socket = std::make_unique<Socket>(connect());
    if (!origin.empty()) {
      socket->set_option(
          websocket::stream_base::decorator([origin](websocket::request_type& request) {
            request.set(http::field::origin, origin);
          }));
    }
    websocket::response_type response;
    ErrorCode error;
    socket->handshake(response, "localhost", target, error);
    if (error) return nullptr;
    return socket;
  }
  std::unique_ptr<Socket> open() { return open("/socket?token=" + token_); }

  std::string read(Socket& socket) {
    beast::flat_buffer buffer;
    socket.read(buffer);
    return beast::buffers_to_string(buffer.data());
  }

  asio::io_context io_;
  std::string token_;
  std::mutex mutex_;
  std::condition_variable heard_;
  std::vector<ClientId> opened_, closed_;
  std::vector<std::string> said_;
  std::unique_ptr<ViewServer> server_;  // last, destroyed first: it calls back
};

TEST_F(ViewServerTest, GivesThePageToWhoKnowsTheToken) {
  start();
  EXPECT_EQ(server_->url().rfind("http://127.0.0.1:", 0), 0u) << server_->url();
  EXPECT_EQ(token_.size(), 32u);
  const std::string answer =
      answerTo("GET /?token=" + token_ + " HTTP/1.1\r\nHost: 127.0.0.1:1234\r\n\r\n");
  EXPECT_EQ(answer.rfind("HTTP/1.1 200 ", 0), 0u) << answer;
  EXPECT_NE(answer.find("default-src 'none'"), std::string::npos) << answer;
  EXPECT_NE(answer.find("script-src 'none'"), std::string::npos) << "it has none: " << answer;
  EXPECT_NE(answer.find("<title>the page</title>"), std::string::npos) << answer;
}

// Hash of "alert(1)": `openssl dgst -sha256 -binary | base64`. A script with a type is data.
TEST_F(ViewServerTest, LetsRunTheScriptsOfThePageAlone) {
  start();
  server_->setReport(
      "<!doctype html><script type=\"application/json\">{}</script><script>alert(1)</script>");
  for (const auto& [target, allowed] :
       {std::pair(std::string("/report"),
                  std::string("'sha256-bhHHL3z2vDgxUt0W3dWQOrprscmda2Y5pLsLg4GF+pI='")),
        {"/", "'none'"}}) {
    const std::string answer =
        answerTo("GET " + target + "?token=" + token_ + " HTTP/1.1\r\nHost: localhost\r\n\r\n");
    EXPECT_NE(answer.find("script-src " + allowed + "; style-src"), std::string::npos) << answer;
  }
}

TEST_F(ViewServerTest, GivesTheReportToWhoKnowsTheToken) {
  start();
  const std::string target = "/report?token=" + token_;
  EXPECT_EQ(get(target), (std::pair<int, std::string>{404, "nothing was measured yet\n"}));
  server_->setReport("<!doctype html>a report");
  EXPECT_EQ(get(target), (std::pair<int, std::string>{200, "<!doctype html>a report"}));
  EXPECT_NE(
      answerTo("GET " + target + " HTTP/1.1\r\nHost: localhost\r\n\r\n").find("default-src 'none'"),
      std::string::npos);
  EXPECT_EQ(get("/report").first, 403);
  EXPECT_EQ(get("/report?token=" + std::string(32, '0')).first, 403);
  EXPECT_EQ(get(target, "Origin: http://elsewhere\r\n").first, 403);
  EXPECT_EQ(get(target, kUpgrade).first, 400);
  EXPECT_EQ(get("/report/../report.html?token=" + token_).first, 404);
}

TEST_F(ViewServerTest, RefusesInOneLineWithItsStatus) {
  start();
  struct Case {
    const char* what;
    std::string target, headers;
    int status;
    const char* says;
  };
  const std::string page = "/?token=" + token_, socket = "/socket?token=" + token_;
  const std::string upgrade = kUpgrade;
  std::string wrong = token_;
  wrong.back() = wrong.back() == '0' ? '1' : '0';
  const Case cases[] = {
      {"no token", "/", "", 403, "token"},
      {"a wrong token", "/?token=" + wrong, "", 403, "token"},
      {"a part of the token", "/?token=" + token_.substr(1), "", 403, "token"},
      {"a wrong token of a socket", "/socket?token=" + wrong, upgrade, 403, "token"},
      {"another host's name", page, "Host: evil.example\r\n", 403, "Host"},
      {"two names of hosts", page, "Host: localhost\r\nHost: evil.example\r\n", 400, "Host"},
      {"the same one twice", page, "Host: localhost\r\nhost: localhost\r\n", 400, "Host"},
      {"two hosts of a socket", socket, upgrade + "Host: localhost\r\nHost: localhost\r\n", 400,
       "Host"},
      {"two origins", page, "Origin: http://localhost\r\nOrigin: http://evil.example\r\n", 400,
       "Origin"},
      {"another page", page, "Origin: http://evil.example\r\n", 403, "Origin"},
      {"a socket of another page", socket, upgrade + "Origin: http://evil.example\r\n", 403,
       "Origin"},
      {"a file", "/etc/passwd?token=" + token_, "", 404, "/socket"},
      {"a path upwards", "/../../etc/passwd?token=" + token_, "", 404, "/socket"},
      {"an escaped path upwards", "/%2e%2e/%2e%2e/etc/passwd?token=" + token_, "", 404, "/socket"},
      {"a socket as a page", socket, "", 400, "WebSocket"},
      {"a page as a socket", page, upgrade, 400, "WebSocket"},
      {"long headers", page, "X: " + std::string(20000, 'x') + "\r\n", 431, "too long"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.what);
    const auto [status, body] = get(c.target, c.headers);
    EXPECT_EQ(status, c.status);
    EXPECT_NE(body.find(c.says), std::string::npos) << body;
    EXPECT_EQ(std::count(body.begin(), body.end(), '\n'), 1) << body;
  }
  const std::string posted =
      answerTo("POST " + page + " HTTP/1.1\r\nHost: localhost\r\nContent-Length: 0\r\n\r\n");
  EXPECT_EQ(posted.rfind("HTTP/1.1 405 ", 0), 0u) << posted;
  const std::string nameless = answerTo("GET " + page + " HTTP/1.1\r\n\r\n");
  EXPECT_EQ(nameless.rfind("HTTP/1.1 400 ", 0), 0u) << nameless;
  const std::string garbage = answerTo(std::string("\0\1\2garbage\r\n\r\n", 15));
  EXPECT_EQ(garbage.rfind("HTTP/1.1 400 ", 0), 0u) << garbage;
  EXPECT_EQ(get(page).first, 200) << "it goes on serving";
}

TEST_F(ViewServerTest, TalksWithSeveralPages) {
  start();
  const auto first = open("/socket?token=" + token_, "http://localhost"), second = open();
  ASSERT_TRUE(first && second);
  first->write(asio::buffer(std::string("hello")));
  ASSERT_TRUE(waitFor([&] { return opened_.size() == 2 && said_.size() == 1; }));
  EXPECT_EQ(said_[0], "hello");
  for (const ClientId id : opened_) server_->send(id, "to " + std::to_string(id));
  EXPECT_EQ(read(*first), "to " + std::to_string(opened_[0]));
  EXPECT_EQ(read(*second), "to " + std::to_string(opened_[1]));
  first->close(websocket::close_code::normal);
  ASSERT_TRUE(waitFor([&] { return closed_.size() == 1; }));
  EXPECT_EQ(closed_[0], opened_[0]);
  server_->send(opened_[0], "nobody hears it");
  server_->send(opened_[1], "still there");
  EXPECT_EQ(read(*second), "still there");
}

TEST_F(ViewServerTest, LimitsThePages) {
  ViewServerOptions options;
  options.mostClients = 2;
  start(options);
  const auto first = open(), second = open();
  ASSERT_TRUE(first && second);
  EXPECT_EQ(open(), nullptr);
  EXPECT_EQ(get("/socket?token=" + token_, kUpgrade).first, 503);
}

TEST_F(ViewServerTest, EndsWhoSendsWhatIsNoText) {
  start();
  const std::string large(70000, 'x');
  for (const bool isLarge : {false, true}) {
    const auto socket = open();
    ASSERT_TRUE(socket);
    ErrorCode error;
    socket->binary(!isLarge);
    socket->write(isLarge ? asio::buffer(large) : asio::buffer(large.data(), 4), error);
    beast::flat_buffer buffer;
    socket->read(buffer, error);
    // The server stops reading a message that is too long, which may end the connection first.
    EXPECT_TRUE(error) << isLarge;
    if (!isLarge) {
      EXPECT_EQ(error, websocket::error::closed) << error.message();
      EXPECT_EQ(socket->reason().code, websocket::close_code::bad_payload);
    }
  }
  // Half a frame, then the connection closes.
  {
    const auto socket = open();
    ASSERT_TRUE(socket);
    asio::write(socket->next_layer(), asio::buffer("\x81\xfe\x10", 3));
    socket->next_layer().close();
  }
  ASSERT_TRUE(waitFor([&] { return closed_.size() == 3; }));
  EXPECT_TRUE(said_.empty());
  EXPECT_EQ(get("/?token=" + token_).first, 200);
}

// Overtaken messages of a slot are left out; the last one arrives.
TEST_F(ViewServerTest, GivesASlowPageFewerFramesAndNotOlderOnes) {
  start();
  const auto socket = open();
  ASSERT_TRUE(socket);
  ASSERT_TRUE(waitFor([&] { return opened_.size() == 1; }));
  constexpr uint32_t kFrames = 300;
  for (uint32_t frame = 1; frame <= kFrames; ++frame) {
    auto bytes = std::make_shared<Bytes>(1 << 20);
    std::memcpy(bytes->data(), &frame, sizeof frame);
    server_->sendNewest(opened_[0], frame % 2, bytes);
  }
  server_->send(opened_[0], "the end");
  uint32_t last[2] = {0, 0}, count = 0;
  for (;;) {
    beast::flat_buffer buffer;
    socket->read(buffer);
    if (socket->got_text()) break;
    uint32_t frame = 0;
    std::memcpy(&frame, buffer.data().data(), sizeof frame);
    EXPECT_GT(frame, last[frame % 2]);
    last[frame % 2] = frame;
    ++count;
  }
  EXPECT_EQ(last[0], kFrames);
  EXPECT_EQ(last[1], kFrames - 1);
  EXPECT_LT(count, kFrames / 2) << "what is sent to nobody who reads is not kept";
}

TEST_F(ViewServerTest, LetsGoWhoDoesNotRead) {
  ViewServerOptions options;
  options.mostWaiting = 16;
  start(options);
  const auto socket = open();
  ASSERT_TRUE(socket);
  ASSERT_TRUE(waitFor([&] { return opened_.size() == 1; }));
  for (int i = 0; i < 100; ++i) server_->send(opened_[0], std::string(1 << 20, 'x'));
  EXPECT_TRUE(waitFor([&] { return closed_.size() == 1; }));
}

// Limits many large texts; a single text may have any size.
TEST_F(ViewServerTest, BoundsWhatWaitsByBytes) {
  ViewServerOptions options;
  options.mostWaitingBytes = 8 << 20;
  start(options);
  const auto first = open();
  ASSERT_TRUE(first);
  ASSERT_TRUE(waitFor([&] { return opened_.size() == 1; }));
  server_->send(opened_[0], std::string(32 << 20, 'x'));
  server_->send(opened_[0], "small");
  first->read_message_max(0);
  EXPECT_EQ(read(*first).size(), size_t(32) << 20);
  EXPECT_EQ(read(*first), "small");
  const auto unreadInTheEnd = [&] {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (server_->bytesUnread(opened_[0]) > 0 && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return server_->bytesUnread(opened_[0]);
  };
  EXPECT_EQ(unreadInTheEnd(), 0u) << "all was taken";
  // One of these is being written, and more than two are queued.
  for (int i = 0; i < 20; ++i) server_->send(opened_[0], std::string(4 << 20, 'x'));
  EXPECT_TRUE(waitFor([&] { return closed_.size() == 1; }));
  EXPECT_EQ(unreadInTheEnd(), 0u) << "it is gone";
}

// Without a free descriptor the server waits, without busy looping.
TEST_F(ViewServerTest, WaitsForADescriptor) {
  start();
  Tcp::socket page(io_, Tcp::v4());
  std::vector<int> taken;
  for (int file = dup(0); file >= 0; file = dup(0)) taken.push_back(file);
  ASSERT_EQ(errno, EMFILE);
  page.connect({asio::ip::make_address("127.0.0.1"), server_->port()});
  const std::clock_t before = std::clock();
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  const double seconds = double(std::clock() - before) / CLOCKS_PER_SEC;
  for (const int file : taken) close(file);
  EXPECT_LT(seconds, 0.1) << "of the processor's time in half a second";
  asio::write(page, asio::buffer("GET /?token=" + token_ + " HTTP/1.1\r\nHost: localhost\r\n\r\n"));
  std::string answer(12, ' ');
  asio::read(page, asio::buffer(answer));
  EXPECT_EQ(answer, "HTTP/1.1 200") << "it is let in as soon as there is a descriptor";
}

TEST(ViewServerPorts, ThatAreTakenAreSaid) {
  const ViewServerEvents nobody = {[](ClientId) {}, [](ClientId) {},
                                   [](ClientId, const std::string&) {}};
  const ViewServer server({}, nobody);
  const auto errorOf = [&](const ViewServerOptions& options) {
    try {
      const ViewServer other(options, nobody);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::badUsage);
      return std::string(error.what());
    }
    return std::string("none");
  };
  ViewServerOptions same, nowhere, words;
  same.port = server.port();
  nowhere.listen = "192.0.2.1";  // address for documentation; no machine has it
  words.listen = "everywhere";
  EXPECT_NE(errorOf(same).find("is taken"), std::string::npos);
  EXPECT_NE(errorOf(nowhere).find("--listen 192.0.2.1: is no address of this machine"),
            std::string::npos);
  EXPECT_NE(errorOf(words).find("--listen everywhere: is no address"), std::string::npos);
}

TEST(ViewServerAddresses, ArePrintedSoThatTheyOpen) {
  const ViewServerEvents nobody = {[](ClientId) {}, [](ClientId) {},
                                   [](ClientId, const std::string&) {}};
  for (const char* listen : {"localhost", "127.0.0.1", "0.0.0.0"}) {
    SCOPED_TRACE(listen);
    ViewServerOptions options;
    options.listen = listen;
    const ViewServer server(options, nobody);
    const std::string url = server.url();
    const std::string host = url.substr(7, url.rfind(':') - 7);
    EXPECT_EQ(url.find("0.0.0.0"), std::string::npos) << url;
    EXPECT_EQ(host == "localhost", std::string(listen) == "localhost") << url;
    asio::io_context io;
    Tcp::socket socket(io);
    socket.connect(
        {host == "localhost" ? asio::ip::make_address("127.0.0.1") : asio::ip::make_address(host),
         server.port()});
    const std::string target = url.substr(url.find('/', 7));
    asio::write(socket, asio::buffer("GET " + target + " HTTP/1.1\r\nHost: " + host + ":" +
                                     std::to_string(server.port()) + "\r\n\r\n"));
    std::string answer(12, ' ');
    asio::read(socket, asio::buffer(answer));
    EXPECT_EQ(answer, "HTTP/1.1 200");
  }
}

}  // namespace
}  // namespace restlab
