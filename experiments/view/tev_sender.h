// Images on their way to a running tev, on a thread of its own: who renders never waits for it. Of
// each image the newest goes, twice a second at most. Where tev is not there, or goes away, that is
// said once, and tried again from time to time.
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

// "HOST", "HOST:PORT" or "[IPv6]:PORT". Throws Error (badUsage) where it is none.
TevAddress parseTevAddress(const std::string& text);

class TevSender {
 public:
  static constexpr std::chrono::milliseconds kInterval{500};

  explicit TevSender(TevAddress address);
  ~TevSender();
  TevSender(const TevSender&) = delete;
  TevSender& operator=(const TevSender&) = delete;

  // A number for each connection, which knows nothing of what went over another; 0: there is none.
  uint64_t connection() const { return connection_; }
  // An image of that name would be sent now.
  bool takes(const std::string& name) const;
  void show(const std::string& name, const Image& image);

 private:
  using Clock = std::chrono::steady_clock;
  using Waiting = std::map<std::string, Image>;
  using Sizes = std::map<std::string, std::pair<uint32_t, uint32_t>>;  // of images that tev has

  void work();
  void serve(int socket);
  std::optional<Waiting> nextImages(int socket);
  void complain(const std::string& why);
  // False once this is to end.
  bool rest(std::chrono::milliseconds time);
  int connected();
  bool sendAll(int socket, const std::string& bytes);

  const TevAddress address_;
  std::atomic<bool> isStopped_{false};
  std::atomic<uint64_t> connection_{0};
  bool isSaid_ = false;  // of the thread

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Waiting waiting_;
  std::map<std::string, Clock::time_point> taken_;
  std::thread thread_;  // the last: it uses the others
};

}  // namespace restlab
