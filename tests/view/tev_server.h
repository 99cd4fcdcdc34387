// Stands in for tev: accepts a connection and reads its messages.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>
#include <optional>
#include <string>
#include <vector>

namespace restlab::view_test {

struct TevMessage {
  int operation = 0;
  bool grabsFocus = false;
  std::string name;
  std::vector<std::string> channels;
  int32_t x = 0, y = 0, width = 0, height = 0;
  std::vector<int64_t> offsets, strides;
  std::vector<float> data;
};

class TevServer {
 public:
  // `isListening` false: the port is reserved, but connections are refused.
  explicit TevServer(bool isListening = true) : listener_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    socklen_t size = sizeof address;
    getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    if (isListening) listen();
  }
  ~TevServer() {
    hangUp();
    close(listener_);
  }
  TevServer(const TevServer&) = delete;
  TevServer& operator=(const TevServer&) = delete;

  uint16_t port() const { return port_; }
  void listen() { EXPECT_EQ(::listen(listener_, 4), 0); }
  void accept() {
    pollfd ready = {listener_, POLLIN, 0};
    EXPECT_EQ(poll(&ready, 1, kPatienceMs), 1) << "nobody connects";
    client_ = ::accept(listener_, nullptr, nullptr);
  }
  void hangUp() {
    if (client_ >= 0) close(client_);
    client_ = -1;
  }

  // Returns nothing if no message arrives. Fails if a message is not as long as it says.
  std::optional<TevMessage> next(int patienceMs = kPatienceMs) {
    bytes_.clear();
    at_ = 0;
    uint32_t length = 0;
    if (!receive(sizeof length, patienceMs)) return std::nullopt;
    length = take<uint32_t>();
    if (length < sizeof length || !receive(length - sizeof length, kPatienceMs)) {
      ADD_FAILURE() << "a message of " << length << " bytes does not come";
      return std::nullopt;
    }
    const TevMessage message = parsed();
    EXPECT_EQ(at_, bytes_.size()) << "what the message says is not as long as it is";
    return message;
  }

 private:
  static constexpr int kPatienceMs = 20000;

  bool receive(size_t count, int patienceMs) {
    const size_t begin = bytes_.size();
    bytes_.resize(begin + count);
    for (size_t got = 0; got < count;) {
      pollfd ready = {client_, POLLIN, 0};
      if (poll(&ready, 1, patienceMs) != 1) return false;
      const ssize_t more = recv(client_, bytes_.data() + begin + got, count - got, 0);
      if (more <= 0) return false;
      got += size_t(more);
    }
    return true;
  }

  template <class Number>
  Number take() {
    Number number{};
    EXPECT_LE(at_ + sizeof number, bytes_.size());
    if (at_ + sizeof number <= bytes_.size())
      std::memcpy(&number, bytes_.data() + at_, sizeof number);
    at_ += sizeof number;
    return number;
  }
  std::string takeText() {
    const std::string text = bytes_.data() + at_;  // a string ends with 0, whatever is in it
    at_ += text.size() + 1;
    return text;
  }

  TevMessage parsed() {
    TevMessage message;
    message.operation = take<uint8_t>();
    message.grabsFocus = take<uint8_t>() != 0;
    message.name = takeText();
    const bool isCreation = message.operation == 4;
    EXPECT_TRUE(isCreation || message.operation == 6) << message.operation;
    const auto takeSize = [&] {
      message.width = take<int32_t>();
      message.height = take<int32_t>();
    };
    if (isCreation) takeSize();
    const auto channels = take<int32_t>();
    for (int32_t i = 0; i < channels && i < 16; ++i) message.channels.push_back(takeText());
    if (isCreation) return message;
    message.x = take<int32_t>();
    message.y = take<int32_t>();
    takeSize();
    for (int32_t i = 0; i < channels; ++i) message.offsets.push_back(take<int64_t>());
    for (int32_t i = 0; i < channels; ++i) message.strides.push_back(take<int64_t>());
    while (at_ + sizeof(float) <= bytes_.size()) message.data.push_back(take<float>());
    return message;
  }

  int listener_ = -1, client_ = -1;
  uint16_t port_ = 0;
  std::string bytes_;
  size_t at_ = 0;
};

}  // namespace restlab::view_test
