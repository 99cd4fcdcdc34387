#include "experiments/view/server_address.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/udp.hpp>
#include <cstdint>
#include <random>

namespace restlab {

namespace asio = boost::asio;
using ErrorCode = boost::system::error_code;

std::string newToken() {
  std::random_device device;
  std::string token;
  for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", uint32_t(device()));
  return token;
}

bool equalSecrets(const std::string& a, const std::string& b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (size_t i = 0; i < a.size(); ++i) difference |= unsigned(uint8_t(a[i]) ^ uint8_t(b[i]));
  return difference == 0;
}

ServerTarget parseTarget(const std::string& text) {
  const size_t question = std::min(text.find('?'), text.size());
  ServerTarget target{text.substr(0, question), ""};
  const std::string query = question < text.size() ? text.substr(question + 1) : "";
  const std::string name = "token=";
  if (query.rfind(name, 0) == 0) target.token = query.substr(name.size());
  return target;
}

std::string hostName(const std::string& host) {
  const size_t bracket = host.find(']');
  const size_t colon = host.find(':', bracket == std::string::npos ? 0 : bracket);
  return host.substr(0, colon);
}

std::string inUrl(const std::string& address) {
  return address.find(':') == std::string::npos ? address : "[" + address + "]";
}

std::string openedAs(const std::string& listen) {
  ErrorCode error;
  const asio::ip::address address = asio::ip::make_address(listen, error);
  if (error || !address.is_unspecified()) return listen;
  // Ask the system for the sender address of a packet to a documentation address; nothing is sent.
  const bool isV6 = address.is_v6();
  const auto elsewhere = asio::ip::make_address(isV6 ? "2001:db8::1" : "192.0.2.1");
  asio::io_context io;
  asio::ip::udp::socket socket(io);
  socket.open(isV6 ? asio::ip::udp::v6() : asio::ip::udp::v4(), error);
  if (!error) socket.connect({elsewhere, 9}, error);
  if (!error) {
    const asio::ip::address own = socket.local_endpoint(error).address();
    if (!error && !own.is_unspecified()) return own.to_string();
  }
  return isV6 ? "::1" : "127.0.0.1";
}

}  // namespace restlab
