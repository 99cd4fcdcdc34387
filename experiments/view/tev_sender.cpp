#include "experiments/view/tev_sender.h"

#include <fmt/format.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>

#include "core/base/error.h"
#include "experiments/runner/base/log.h"
#include "experiments/view/tev_message.h"

namespace restlab {

namespace {

using std::chrono::milliseconds;

constexpr milliseconds kRetry{2000};
// Longest wait in one call, so that the sender can end soon.
constexpr milliseconds kGlance{100};

// True if the other side has closed the socket. tev sends nothing that is needed here.
bool isClosed(int socket) {
  char ignored[256];
  const ssize_t count = recv(socket, ignored, sizeof ignored, MSG_DONTWAIT);
  return count == 0 || (count < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR);
}

}  // namespace

TevAddress parseTevAddress(const std::string& text) {
  TevAddress address;
  const auto fail = [&](const char* what) {
    failUsage(fmt::format("--tev {}: {}; must be HOST or HOST:PORT, for example localhost:14158",
                          text, what));
  };
  const bool isBracketed = text.rfind('[', 0) == 0;
  const size_t close = isBracketed ? text.find(']') : 0;
  if (close == std::string::npos) fail("has no ']'");
  const size_t colon = text.find(':', close);
  address.host = isBracketed ? text.substr(1, close - 1) : text.substr(0, colon);
  if (address.host.empty()) fail("has no host");
  if (isBracketed && close + 1 != text.size() && colon != close + 1) fail("goes on after ']'");
  if (colon == std::string::npos) return address;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data() + colon + 1, end, address.port);
  if (read.ec != std::errc() || read.ptr != end || address.port == 0)
    fail("its port is no number from 1 to 65535");
  return address;
}

TevSender::TevSender(TevAddress address)
    : address_(std::move(address)), thread_([this] { work(); }) {}

TevSender::~TevSender() {
  {
    const std::lock_guard lock(mutex_);
    isStopped_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

bool TevSender::takes(const std::string& name) const {
  if (connection_ == 0) return false;
  const std::lock_guard lock(mutex_);
  const auto last = taken_.find(name);
  return waiting_.count(name) == 0 &&
         (last == taken_.end() || Clock::now() - last->second >= kInterval);
}

void TevSender::show(const std::string& name, const Image& image) {
  {
    const std::lock_guard lock(mutex_);
    waiting_[name] = image;
    taken_[name] = Clock::now();
  }
  changed_.notify_all();
}

void TevSender::work() {
  uint64_t connections = 0;
  do {
    const int socket = connected();
    if (socket < 0) continue;
    isSaid_ = false;
    connection_ = ++connections;
    serve(socket);
    connection_ = 0;
    close(socket);
    {
      const std::lock_guard lock(mutex_);
      waiting_.clear();
      taken_.clear();
    }
    if (!isStopped_) complain("the connection was lost");
  } while (rest(kRetry));
}

// Returns when the connection is lost or the sender is to end.
void TevSender::serve(int socket) {
  Sizes sizes;
  while (std::optional<Waiting> images = nextImages(socket)) {
    for (const auto& [name, image] : *images) {
      const std::pair size{image.width, image.height};
      const auto known = sizes.find(name);
      const bool isNew = known == sizes.end() || known->second != size;
      if (isNew && !sendAll(socket, tevCreateMessage(name, image.width, image.height))) return;
      if (!sendAll(socket, tevUpdateMessage(name, image))) return;
      sizes[name] = size;
    }
  }
}

std::optional<TevSender::Waiting> TevSender::nextImages(int socket) {
  while (!isStopped_ && !isClosed(socket)) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, kGlance, [&] { return isStopped_ || !waiting_.empty(); });
    if (!waiting_.empty()) return std::exchange(waiting_, {});
  }
  return std::nullopt;
}

void TevSender::complain(const std::string& why) {
  if (std::exchange(isSaid_, true)) return;
  logWarning(fmt::format("--tev {}:{}: {}; the viewer goes on, and looks for tev from time to time",
                         address_.host, address_.port, why));
}

bool TevSender::rest(milliseconds time) {
  std::unique_lock lock(mutex_);
  return !changed_.wait_for(lock, time, [&] { return isStopped_.load(); });
}

// Returns a non-blocking socket, or -1.
int TevSender::connected() {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const std::string port = std::to_string(address_.port);
  // No name asks for this machine: `localhost` also where no file of hosts has it.
  const char* const name = address_.host == "localhost" ? nullptr : address_.host.c_str();
  if (const int error = getaddrinfo(name, port.c_str(), &hints, &found)) {
    complain(gai_strerror(error));
    return -1;
  }
  int error = 0;
  int made = -1;
  for (const addrinfo* at = found; at != nullptr && made < 0 && !isStopped_; at = at->ai_next) {
    const int socket =
        ::socket(at->ai_family, at->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, at->ai_protocol);
    if (socket < 0) {
      error = errno;
      continue;
    }
    error = connect(socket, at->ai_addr, at->ai_addrlen) == 0 ? 0 : errno;
    if (error == EINPROGRESS) {
      pollfd ready = {socket, POLLOUT, 0};
      int glances = int(kRetry / kGlance);
      while (!isStopped_ && glances > 0 && poll(&ready, 1, int(kGlance.count())) <= 0) --glances;
      socklen_t size = sizeof error;
      if (isStopped_ || glances == 0) {
        error = ETIMEDOUT;
      } else {
        getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size);
      }
    }
    if (error == 0) {
      made = socket;
    } else {
      close(socket);
    }
  }
  freeaddrinfo(found);
  if (made < 0 && !isStopped_) complain(std::strerror(error));
  return made;
}

bool TevSender::sendAll(int socket, const std::string& bytes) {
  size_t sent = 0;
  while (sent < bytes.size()) {
    if (isStopped_) return false;
    const ssize_t count = send(socket, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (count > 0) {
      sent += size_t(count);
    } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
      pollfd ready = {socket, POLLOUT, 0};
      poll(&ready, 1, int(kGlance.count()));
    } else if (errno != EINTR) {
      return false;
    }
  }
  return true;
}

}  // namespace restlab
