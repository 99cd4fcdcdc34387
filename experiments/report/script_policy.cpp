#include "experiments/report/script_policy.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <stdexcept>

namespace restlab {

std::string scriptHash(std::string_view script) {
  std::array<unsigned char, 32> hash{};
  unsigned size = 0;
  if (EVP_Digest(script.data(), script.size(), hash.data(), &size, EVP_sha256(), nullptr) != 1 ||
      size != hash.size())
    throw std::runtime_error("OpenSSL has no SHA-256");
  std::array<unsigned char, 45> digits{};  // four for each three bytes, and a terminator
  EVP_EncodeBlock(digits.data(), hash.data(), int(hash.size()));
  return fmt::format("'sha256-{}'", reinterpret_cast<const char*>(digits.data()));
}

std::string scriptHashes(std::string_view page) {
  constexpr std::string_view kOpen = "<script", kClose = "</script";
  std::string hashes;
  for (size_t at = page.find(kOpen); at != std::string_view::npos; at = page.find(kOpen, at)) {
    const size_t tagEnd = page.find('>', at);
    const size_t end = page.find(kClose, tagEnd);
    if (tagEnd == std::string_view::npos || end == std::string_view::npos) break;
    const std::string_view attributes = page.substr(at + kOpen.size(), tagEnd - at - kOpen.size());
    if (attributes.find("type=") == std::string_view::npos) {
      hashes += hashes.empty() ? "" : " ";
      hashes += scriptHash(page.substr(tagEnd + 1, end - tagEnd - 1));
    }
    at = end;
  }
  return hashes.empty() ? "'none'" : hashes;
}

}  // namespace restlab
