#include "experiments/view/server_address.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <random>

namespace restlab {

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

}  // namespace restlab
