// What an address of the server is made of: a name, a target, and the secret of who may ask.
#pragma once

#include <string>

namespace restlab {

// 128 random bits in hexadecimal digits.
std::string newToken();

// Takes the same time wherever the difference lies.
bool equalSecrets(const std::string& a, const std::string& b);

// "path?token=..." in its parts; a token that is not there is empty.
struct ServerTarget {
  std::string path, token;
};
ServerTarget parseTarget(const std::string& text);

// Of "name:port" or "[address]:port" the part before the port.
std::string hostName(const std::string& host);

// An address of a machine as it stands in a URL.
std::string inUrl(const std::string& address);

// The address by which a browser opens a server that listens on `listen`: of "every network" that
// by which this machine is reached from elsewhere, or the loopback where there is no network.
std::string openedAs(const std::string& listen);

}  // namespace restlab
