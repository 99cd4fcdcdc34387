// A page without a browser: a WebSocket client that collects the viewer's messages.
#pragma once

#include <gtest/gtest.h>

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/view/image_message.h"

namespace restlab::view_test {

using Json = nlohmann::json;

struct ShownImage {
  ImageHeader header;
  std::vector<std::byte> pixels;
};

class Page {
 public:
  // `url`: as printed by the program.
  explicit Page(const std::string& url) : socket_(io_) {
    const size_t colon = url.rfind(':'), slash = url.find('/', colon);
    const auto port = uint16_t(std::stoi(url.substr(colon + 1, slash - colon - 1)));
    boost::beast::get_lowest_layer(socket_).connect(
        boost::asio::ip::tcp::endpoint(boost::asio::ip::make_address("127.0.0.1"), port));
    // Like browsers: send a command without waiting for the acknowledgement of the one before.
    boost::beast::get_lowest_layer(socket_).socket().set_option(
        boost::asio::ip::tcp::no_delay(true));
    socket_.handshake("localhost", "/socket" + url.substr(slash + 1));
    socket_.read_message_max(0);
  }

  void say(const Json& command) { sayText(command.dump()); }
  void sayText(const std::string& text) { socket_.write(boost::asio::buffer(text)); }

  // Returns the next message of that name for which `holds`; stores images received meanwhile.
  template <class Holds>
  Json waitFor(const std::string& name, const Holds& holds) {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (std::chrono::steady_clock::now() < end) {
      const Json text = next();
      if (text.is_null()) break;
      if (text["say"] == name && holds(text)) return text;
    }
    ADD_FAILURE() << "the viewer does not say the " << name << " that was waited for";
    return Json::object();
  }
  Json waitFor(const std::string& name) {
    return waitFor(name, [](const Json&) { return true; });
  }

  // Returns the next text; null if none arrives.
  Json next() {
    for (;;) {
      if (!read()) return nullptr;
      if (socket_.got_text()) return Json::parse(boost::beast::buffers_to_string(buffer_.data()));
      keepImage();
    }
  }

  // Newest image of each slot.
  const std::map<uint32_t, ShownImage>& images() const { return images_; }
  template <class Holds>
  bool waitForImage(const Holds& holds) {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (std::chrono::steady_clock::now() < end && read()) {
      if (!socket_.got_text() && holds(keepImage())) return true;
    }
    ADD_FAILURE() << "the image that was waited for does not come";
    return false;
  }

  // Bytes received so far.
  uint64_t bytes() const { return bytes_; }
  void close() { boost::beast::get_lowest_layer(socket_).close(); }

 private:
  static constexpr std::chrono::seconds kPatience{30};

  bool read() {
    boost::system::error_code result = boost::asio::error::would_block;
    buffer_.clear();
    socket_.async_read(buffer_, [&](boost::system::error_code error, size_t) { result = error; });
    io_.restart();
    io_.run_for(kPatience);
    bytes_ += buffer_.size();
    if (!io_.stopped()) {
      close();
      io_.run();
    }
    return !result;
  }

  const ShownImage& keepImage() {
    const auto* bytes = static_cast<const std::byte*>(buffer_.data().data());
    EXPECT_GE(buffer_.size(), kImageHeaderBytes);
    uint32_t words[5] = {};
    std::memcpy(words, bytes + 4, sizeof words);
    ShownImage image;
    image.header = {words[0], PixelFormat(words[1]), words[2], words[3], words[4], 0};
    std::memcpy(&image.header.epoch, bytes + 24, sizeof image.header.epoch);
    image.pixels.assign(bytes + kImageHeaderBytes, bytes + buffer_.size());
    return images_[image.header.slot] = image;
  }

  boost::asio::io_context io_;
  boost::beast::websocket::stream<boost::beast::tcp_stream> socket_;
  boost::beast::flat_buffer buffer_;
  std::map<uint32_t, ShownImage> images_;
  uint64_t bytes_ = 0;
};

}  // namespace restlab::view_test
