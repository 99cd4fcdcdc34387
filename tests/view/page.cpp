// Boost.Beast takes half a minute to compile: here alone, and in server_test.cpp.
#include "tests/view/page.h"

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <cstring>

namespace restlab::view_test {

namespace asio = boost::asio;
namespace beast = boost::beast;

struct Page::Socket {
  asio::io_context io;
  beast::websocket::stream<beast::tcp_stream> stream{io};
  beast::flat_buffer buffer;
};

Page::Page(const std::string& url) : socket_(std::make_unique<Socket>()) {
  const size_t colon = url.rfind(':'), slash = url.find('/', colon);
  const auto port = uint16_t(std::stoi(url.substr(colon + 1, slash - colon - 1)));
  beast::tcp_stream& connection = beast::get_lowest_layer(socket_->stream);
  connection.connect(asio::ip::tcp::endpoint(asio::ip::make_address("127.0.0.1"), port));
  // Like browsers: send a command without waiting for the acknowledgement of the one before.
  connection.socket().set_option(asio::ip::tcp::no_delay(true));
  socket_->stream.handshake("localhost", "/socket" + url.substr(slash + 1));
  socket_->stream.read_message_max(0);
}

Page::~Page() = default;

void Page::sayText(const std::string& text) { socket_->stream.write(asio::buffer(text)); }

void Page::close() { beast::get_lowest_layer(socket_->stream).close(); }

bool Page::gotText() const { return socket_->stream.got_text(); }

Json Page::next() {
  for (;;) {
    if (!read()) return nullptr;
    if (gotText()) return Json::parse(beast::buffers_to_string(socket_->buffer.data()));
    keepImage();
  }
}

bool Page::read() {
  boost::system::error_code result = asio::error::would_block;
  socket_->buffer.clear();
  socket_->stream.async_read(socket_->buffer,
                             [&](boost::system::error_code error, size_t) { result = error; });
  socket_->io.restart();
  socket_->io.run_for(kPatience);
  bytes_ += socket_->buffer.size();
  if (!socket_->io.stopped()) {
    close();
    socket_->io.run();
  }
  return !result;
}

const ShownImage& Page::keepImage() {
  const auto* bytes = static_cast<const std::byte*>(socket_->buffer.data().data());
  EXPECT_GE(socket_->buffer.size(), kImageHeaderBytes);
  uint32_t words[5] = {};
  std::memcpy(words, bytes + 4, sizeof words);
  ShownImage image;
  image.header = {words[0], PixelFormat(words[1]), words[2], words[3], words[4], 0};
  std::memcpy(&image.header.epoch, bytes + 24, sizeof image.header.epoch);
  image.pixels.assign(bytes + kImageHeaderBytes, bytes + socket_->buffer.size());
  return images_[image.header.slot] = image;
}

}  // namespace restlab::view_test
