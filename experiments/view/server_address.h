// Parts of the server's address: name, target and secret token.
#pragma once

#include <string>

namespace restlab {

// 128 random bits in hexadecimal digits.
std::string newToken();

// Compares in constant time.
bool equalSecrets(const std::string& a, const std::string& b);

// Parts of "path?token=..."; the token is empty if missing.
struct ServerTarget {
  std::string path, token;
};
ServerTarget parseTarget(const std::string& text);

// Returns the host part of "name:port" or "[address]:port".
std::string hostName(const std::string& host);

// Formats an address of a machine for a URL.
std::string inUrl(const std::string& address);

// Returns the address by which a browser opens a server that listens on `listen`. For "every
// network": the address that other machines use, or the loopback without a network.
std::string openedAs(const std::string& listen);

}  // namespace restlab
