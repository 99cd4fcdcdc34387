// Sends images to a running tev, on a thread of its own: rendering never waits for it. Sends the
// newest of each image, at most twice a second. If tev is missing or goes away, warns once and
// retries from time to time.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "core/image/image.h"

namespace restlab {

struct TevAddress {
  std::string host;
  uint16_t port = 14158;
};

// Reads "HOST", "HOST:PORT" or "[IPv6]:PORT". Throws Error (badUsage) if `text` is none of them.
TevAddress parseTevAddress(const std::string& text);

class TevSender {
 public:
  static constexpr std::chrono::milliseconds kInterval{500};

  explicit TevSender(TevAddress address);
  ~TevSender();
  TevSender(const TevSender&) = delete;
  TevSender& operator=(const TevSender&) = delete;

  // Number of the current connection, 0 if there is none. A new connection knows no image of an
  // older one.
  uint64_t connection() const { return connection_; }
  // True if an image of that name would be sent now.
  bool takes(const std::string& name) const;
  void show(const std::string& name, const Image& image);

 private:
  using Clock = std::chrono::steady_clock;
  using Waiting = std::map<std::string, Image>;
  using Sizes = std::map<std::string, std::pair<uint32_t, uint32_t>>;  // sizes of tev's images

  void work();
  void serve(int socket);
  std::optional<Waiting> nextImages(int socket);
  void complain(const std::string& why);
  // Waits; returns false if the sender is to end.
  bool rest(std::chrono::milliseconds time);
  int connected();
  bool sendAll(int socket, const std::string& bytes);

  const TevAddress address_;
  std::atomic<bool> isStopped_{false};
  std::atomic<uint64_t> connection_{0};
  bool isSaid_ = false;  // warned already; only used by the thread

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Waiting waiting_;
  std::map<std::string, Clock::time_point> taken_;
  std::thread thread_;  // last: uses the members above
};

}  // namespace restlab
