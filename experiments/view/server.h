// The server of `restlab view`: one page over HTTP, and a WebSocket for each page that is open.
//
// It listens on loopback unless it is told otherwise. Whoever asks must know the token of the
// address that was printed, name this machine in Host and, from a page, come from this page's
// origin: another site that a browser has open reaches nothing. There are three targets, "/",
// "/socket" and "/report"; nothing is read from the disk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace restlab {

struct ViewServerOptions {
  std::string listen = "127.0.0.1";  // an address of this machine, or its name
  uint16_t port = 0;                 // 0: any that is free
  std::string page;                  // HTML
  size_t mostClients = 8;
  size_t mostMessageBytes = 64 << 10;  // of a client
  // Texts and layers that a client has not taken. One that falls behind so far is let go.
  size_t mostWaiting = 256;
  // The same of texts beside the one that is under way, which may have any size.
  size_t mostWaitingBytes = 64 << 20;
};

using ClientId = uint64_t;

// All are called on the server's thread, and must not wait.
struct ViewServerEvents {
  std::function<void(ClientId)> opened, closed;
  std::function<void(ClientId, const std::string& text)> said;
};

using Bytes = std::vector<std::byte>;

class ViewServer {
 public:
  // Listens from here on. Throws Error (badUsage) where the address is none of this machine's or
  // the port is taken.
  ViewServer(const ViewServerOptions& options, ViewServerEvents events);
  // Closes what is open.
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  uint16_t port() const;
  // With the token, to be opened in a browser.
  std::string url() const;

  // From any thread; to a client that is gone: nothing. Texts come in their order.
  void send(ClientId client, std::string text);
  // What waits of the same slot is replaced: a slow client gets fewer of them, not older ones.
  void sendNewest(ClientId client, uint32_t slot, std::shared_ptr<const Bytes> bytes);
  void sendNewest(ClientId client, uint32_t slot, std::string text);

  // Bytes of texts that the client has not taken; 0 of one that is gone.
  size_t bytesUnread(ClientId client) const;

  // What "/report" is from here on, an HTML page; before, it is not there.
  void setReport(std::string html);

  // To all clients since the server began.
  uint64_t bytesWritten() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace restlab
