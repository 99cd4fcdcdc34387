// Server of `restlab view`: one page over HTTP and a WebSocket for each open page.
//
// Listens on loopback unless told otherwise. A request must have the token of the printed address,
// name this machine in Host and, if it comes from a page, come from this page's origin: other sites
// open in the browser reach nothing. The targets are "/", "/socket" and "/report"; nothing is read
// from the disk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace restlab {

struct ViewServerOptions {
  std::string listen = "127.0.0.1";  // an address or the name of this machine
  uint16_t port = 0;                 // 0: any free port
  std::string page;                  // HTML
  size_t mostClients = 8;
  size_t mostMessageBytes = 64 << 10;  // limit for a message of a client
  // Limit of queued texts and layers per client. A client that exceeds it is disconnected.
  size_t mostWaiting = 256;
  // Limit of queued bytes of texts, besides the one being written, which may have any size.
  size_t mostWaitingBytes = 64 << 20;
};

using ClientId = uint64_t;

// Called on the server's thread; must not block.
struct ViewServerEvents {
  std::function<void(ClientId)> opened, closed;
  std::function<void(ClientId, const std::string& text)> said;
};

using Bytes = std::vector<std::byte>;

class ViewServer {
 public:
  // Listens from here on. Throws Error (badUsage) if the address does not belong to this machine or
  // the port is taken.
  ViewServer(const ViewServerOptions& options, ViewServerEvents events);
  // Closes all connections.
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  uint16_t port() const;
  // Address with the token, to be opened in a browser.
  std::string url() const;

  // Callable from any thread; ignored if the client is gone. Texts arrive in order.
  void send(ClientId client, std::string text);
  // Replaces a waiting message of the same slot: a slow client gets fewer messages, not older ones.
  void sendNewest(ClientId client, uint32_t slot, std::shared_ptr<const Bytes> bytes);
  void sendNewest(ClientId client, uint32_t slot, std::string text);

  // Bytes of texts that the client has not taken; 0 if it is gone.
  size_t bytesUnread(ClientId client) const;

  // Sets the HTML page of "/report", which does not exist before.
  void setReport(std::string html);

  // Bytes written to all clients since the server began.
  uint64_t bytesWritten() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace restlab
