#include "experiments/view/server.h"

#include <fmt/format.h>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <deque>
#include <map>
#include <optional>
#include <thread>

#include "core/base/error.h"
#include "experiments/report/script_policy.h"
#include "experiments/view/server_address.h"
#include "experiments/view/unread.h"

namespace restlab {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using Tcp = asio::ip::tcp;
using ErrorCode = boost::system::error_code;
using Request = http::request<http::empty_body>;
using Response = http::response<http::string_body>;

constexpr std::chrono::seconds kRequestTimeout{10};
constexpr std::chrono::seconds kPageTimeout{120};  // reports hold images
constexpr std::chrono::milliseconds kAcceptPause{100};
constexpr uint32_t kMostHeaderBytes = 8 << 10;

// Content-Security-Policy: loads nothing from other servers and runs only the page's own scripts.
std::string policyOf(const std::string& page) {
  return fmt::format(
      "default-src 'none'; script-src {}; style-src 'unsafe-inline'; img-src data: blob:; "
      "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
      scriptHashes(page));
}

// HTML page with its policy.
struct Page {
  explicit Page(std::string text) : html(std::move(text)), policy(policyOf(html)) {}
  const std::string html, policy;
};

std::string textOf(beast::string_view text) { return std::string(text.data(), text.size()); }

ServerTarget targetOf(const Request& request) { return parseTarget(textOf(request.target())); }

}  // namespace

class ViewServer::Impl {
 public:
  Impl(const ViewServerOptions& options, ViewServerEvents events)
      : options_(options),
        events_(std::move(events)),
        page_(std::make_shared<const Page>(options.page)),
        token_(newToken()),
        acceptor_(io_),
        acceptAgain_(io_) {
    listen();
    accept();
    thread_ = std::thread([this] { io_.run(); });
  }

  ~Impl();

  uint16_t port() const { return port_; }
  std::string url() const {
    return fmt::format("http://{}:{}/?token={}", inUrl(openedAs(options_.listen)), port_, token_);
  }

  void post(std::function<void()> task) { asio::post(io_, std::move(task)); }

  struct Message {
    std::shared_ptr<const std::string> text;
    std::shared_ptr<const Bytes> bytes;  // used if `text` is null
    std::optional<uint32_t> slot;        // replaces a waiting message of the same slot
    // Bytes of a text that is never replaced by a newer one.
    size_t keptBytes() const { return text && !slot ? text->size() : 0; }
  };
  void send(ClientId id, Message message);
  void setReport(std::string html) {
    post([this, report = std::make_shared<const Page>(std::move(html))] { report_ = report; });
  }
  size_t bytesUnread(ClientId id) const { return unread_.of(id); }
  uint64_t bytesWritten() const { return bytesWritten_.load(std::memory_order_relaxed); }

 private:
  class Client;
  class Connection;

  void listen() {
    ErrorCode error;
    address_ = addressToListenOn();
    const Tcp::endpoint endpoint(address_, options_.port);
    acceptor_.open(endpoint.protocol(), error);
    if (!error) acceptor_.set_option(asio::socket_base::reuse_address(true), error);
    if (!error) acceptor_.bind(endpoint, error);
    if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
    if (error == asio::error::address_in_use) {
      failUsage(fmt::format("--port {}: is taken; another number, or 0 for any that is free",
                            options_.port));
    }
    if (error == asio::error::address_family_not_supported || error.value() == EADDRNOTAVAIL) {
      failUsage(fmt::format(
          "--listen {}: is no address of this machine; 127.0.0.1 is this machine alone, 0.0.0.0 "
          "every network",
          options_.listen));
    }
    if (error == asio::error::access_denied) {
      failUsage(
          fmt::format("--port {}: is for the administrator alone; a number from 1024, or 0 for any "
                      "that is free",
                      options_.port));
    }
    if (error) {
      failUsage(fmt::format("{}:{}: cannot listen there: {}", inUrl(options_.listen), options_.port,
                            error.message()));
    }
    port_ = acceptor_.local_endpoint().port();
  }

  // Returns the given address, or the address of a given host name. `localhost` is this machine
  // (RFC 6761) also where no file of hosts says so: a new Debian 12 has none.
  asio::ip::address addressToListenOn() {
    if (options_.listen == "localhost") return asio::ip::address_v4::loopback();
    ErrorCode error;
    const asio::ip::address given = asio::ip::make_address(options_.listen, error);
    if (!error) return given;
    const auto found = Tcp::resolver(io_).resolve(options_.listen, "", error);
    if (error || found.empty()) {
      failUsage(
          fmt::format("--listen {}: is no address and no name of one; 127.0.0.1 is this machine "
                      "alone, 0.0.0.0 every network",
                      options_.listen));
    }
    for (const auto& entry : found)
      if (entry.endpoint().address().is_v4()) return entry.endpoint().address();
    return found.begin()->endpoint().address();
  }

  void accept();

  // Returns status and reason of a refusal, or nothing if the request may be served.
  std::optional<std::pair<http::status, std::string>> refusal(const Request& request) const {
    const auto refuse = [](http::status status, const std::string& why) {
      return std::make_optional(std::make_pair(status, why));
    };
    if (request.method() != http::verb::get)
      return refuse(http::status::method_not_allowed, "only GET is served here");
    // Refuse duplicates: a proxy may have checked the other one.
    for (const http::field field : {http::field::host, http::field::origin}) {
      if (request.count(field) > 1)
        return refuse(http::status::bad_request,
                      fmt::format("{}: is there more than once", textOf(http::to_string(field))));
    }
    if (request.count(http::field::host) == 0)
      return refuse(http::status::bad_request, "Host: is missing");
    const std::string host = textOf(request[http::field::host]);
    if (!isOurName(hostName(host)))
      return refuse(http::status::forbidden, "Host: this server has another name");
    const std::string origin = textOf(request[http::field::origin]);
    if (!origin.empty() && origin != "http://" + host)
      return refuse(http::status::forbidden, "Origin: another page's requests are not served");
    const ServerTarget target = targetOf(request);
    if (target.path != "/" && target.path != "/socket" && target.path != "/report")
      return refuse(http::status::not_found, "there are /, /socket and /report");
    if (!equalSecrets(target.token, token_))
      return refuse(http::status::forbidden,
                    "the token of the printed address is missing or wrong");
    const bool isSocket = target.path == "/socket";
    if (isSocket != websocket::is_upgrade(request))
      return refuse(http::status::bad_request, "/socket is a WebSocket, and nothing else is");
    if (target.path == "/report" && !report_)
      return refuse(http::status::not_found, "nothing was measured yet");
    if (isSocket && clients_.size() >= options_.mostClients) {
      return refuse(http::status::service_unavailable,
                    fmt::format("{} pages are open, which is the limit", clients_.size()));
    }
    return std::nullopt;
  }

  // Accepts any name if the user chose to listen to other machines.
  bool isOurName(const std::string& name) const {
    if (!address_.is_loopback()) return !name.empty();
    return name == "localhost" || name == "127.0.0.1" || name == "[::1]" ||
           name == inUrl(options_.listen);
  }

  const ViewServerOptions options_;
  const ViewServerEvents events_;
  const std::shared_ptr<const Page> page_;
  const std::string token_;
  asio::io_context io_;
  asio::ip::address address_;
  Tcp::acceptor acceptor_;
  asio::steady_timer acceptAgain_;
  uint16_t port_ = 0;
  bool isClosing_ = false;
  std::atomic<uint64_t> bytesWritten_{0};
  ClientId nextId_ = 1;
  std::map<ClientId, std::shared_ptr<Client>> clients_;
  std::shared_ptr<const Page> report_;
  Unread unread_;
  std::thread thread_;
};

// Connection to an open page.
class ViewServer::Impl::Client : public std::enable_shared_from_this<Client> {
 public:
  Client(Impl& server, ClientId id, beast::tcp_stream stream)
      : server_(server), id_(id), socket_(std::move(stream)) {}

  void begin(const Request& request) {
    beast::get_lowest_layer(socket_).expires_never();
    socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    socket_.read_message_max(server_.options_.mostMessageBytes);
    socket_.async_accept(request, [self = shared_from_this()](ErrorCode error) {
      if (error) return self->end();
      self->server_.events_.opened(self->id_);
      self->read();
    });
  }

  void add(Message message) {
    for (size_t i = isWriting_ ? 1 : 0; message.slot && i < waiting_.size(); ++i) {
      if (waiting_[i].slot != message.slot) continue;
      waiting_[i] = std::move(message);
      return;
    }
    if (waiting_.size() >= server_.options_.mostWaiting ||
        waitingBytes_ > server_.options_.mostWaitingBytes)
      return drop();
    waitingBytes_ += message.keptBytes();
    waiting_.push_back(std::move(message));
    write();
  }

  // Closes the connection without a closing handshake.
  void drop() {
    ErrorCode ignored;
    beast::get_lowest_layer(socket_).socket().close(ignored);
  }

 private:
  void read() {
    socket_.async_read(buffer_, [self = shared_from_this()](ErrorCode error, size_t) {
      if (error) return self->end();
      if (!self->socket_.got_text()) return self->refuse("texts only");
      const std::string text = beast::buffers_to_string(self->buffer_.data());
      self->buffer_.consume(self->buffer_.size());
      self->server_.events_.said(self->id_, text);
      self->read();
    });
  }

  void refuse(const char* why) {
    socket_.async_close({websocket::close_code::bad_payload, why},
                        [self = shared_from_this()](ErrorCode) { self->end(); });
  }

  void write() {
    if (isWriting_ || waiting_.empty()) return;
    isWriting_ = true;
    const Message message = waiting_.front();
    waitingBytes_ -= message.keptBytes();
    socket_.text(message.text != nullptr);
    const asio::const_buffer data =
        message.text ? asio::buffer(*message.text)
                     : asio::buffer(message.bytes->data(), message.bytes->size());
    socket_.async_write(data, [self = shared_from_this(), message](ErrorCode error, size_t count) {
      self->isWriting_ = false;
      self->server_.unread_.take(self->id_, message.keptBytes());
      self->server_.bytesWritten_.fetch_add(count, std::memory_order_relaxed);
      if (error) return self->end();
      self->waiting_.pop_front();
      self->write();
    });
  }

  // Called by both reading and writing on an error; only the first call counts.
  void end() {
    server_.unread_.forget(id_);
    if (server_.clients_.erase(id_) > 0) server_.events_.closed(id_);
  }

  Impl& server_;
  const ClientId id_;
  websocket::stream<beast::tcp_stream> socket_;
  beast::flat_buffer buffer_;
  std::deque<Message> waiting_;  // the first is being written while isWriting_
  size_t waitingBytes_ = 0;      // bytes of the other texts
  bool isWriting_ = false;
};

// Serves one request: with the page, a refusal, or by becoming a Client.
class ViewServer::Impl::Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(Impl& server, Tcp::socket socket) : server_(server), stream_(std::move(socket)) {
    parser_.header_limit(kMostHeaderBytes);
    parser_.body_limit(0);
  }

  void begin() {
    stream_.expires_after(kRequestTimeout);
    http::async_read(stream_, buffer_, parser_,
                     [self = shared_from_this()](ErrorCode error, size_t) { self->answer(error); });
  }

 private:
  void answer(ErrorCode error) {
    if (error == http::error::header_limit)
      return reply(http::status::request_header_fields_too_large, "the request is too long");
    if (error == http::error::body_limit)
      return reply(http::status::payload_too_large, "requests have no body here");
    if (error == http::error::end_of_stream || error == beast::error::timeout ||
        error == asio::error::connection_reset || error == asio::error::eof)
      return;
    if (error) return reply(http::status::bad_request, "this is no request of HTTP");
    const Request& request = parser_.get();
    if (const auto refusal = server_.refusal(request))
      return reply(refusal->first, refusal->second);
    if (!websocket::is_upgrade(request)) {
      const bool isReport = targetOf(request).path == "/report";
      return reply(http::status::ok, "", isReport ? server_.report_ : server_.page_);
    }
    const ClientId id = server_.nextId_++;
    const auto client = std::make_shared<Client>(server_, id, std::move(stream_));
    server_.clients_.emplace(id, client);
    client->begin(request);
  }

  // Sends a page, or a line that says why there is none.
  void reply(http::status status, const std::string& line,
             const std::shared_ptr<const Page>& page = nullptr) {
    const bool isPage = page != nullptr;
    response_.result(status);
    response_.version(11);
    response_.keep_alive(false);
    response_.set(http::field::content_type, isPage ? "text/html; charset=utf-8" : "text/plain");
    response_.set(http::field::cache_control, "no-store");
    response_.set("Content-Security-Policy", isPage ? page->policy : policyOf(""));
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set("Referrer-Policy", "no-referrer");
    response_.body() = isPage ? page->html : line + "\n";
    response_.prepare_payload();
    stream_.expires_after(isPage ? kPageTimeout : kRequestTimeout);
    http::async_write(stream_, response_, [self = shared_from_this()](ErrorCode, size_t) {
      ErrorCode ignored;
      self->stream_.socket().shutdown(Tcp::socket::shutdown_send, ignored);
    });
  }

  Impl& server_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  http::request_parser<http::empty_body> parser_;
  Response response_;
};

ViewServer::Impl::~Impl() {
  post([this] {
    isClosing_ = true;
    ErrorCode ignored;
    acceptor_.close(ignored);
    acceptAgain_.cancel();
    for (auto& [id, client] : clients_) client->drop();
    clients_.clear();
    io_.stop();
  });
  thread_.join();
}

void ViewServer::Impl::send(ClientId id, Message message) {
  unread_.add(id, message.keptBytes());
  post([this, id, message = std::move(message)] {
    if (const auto found = clients_.find(id); found != clients_.end())
      found->second->add(message);
    else
      unread_.forget(id);
  });
}

void ViewServer::Impl::accept() {
  acceptor_.async_accept([this](ErrorCode error, Tcp::socket socket) {
    if (isClosing_) return;
    if (!error) {
      std::make_shared<Connection>(*this, std::move(socket))->begin();
      return accept();
    }
    // An error such as no free descriptor: the connection keeps waiting and accept() would fail
    // again at once, so pause first.
    acceptAgain_.expires_after(kAcceptPause);
    acceptAgain_.async_wait([this](ErrorCode) {
      if (!isClosing_) accept();
    });
  });
}

ViewServer::ViewServer(const ViewServerOptions& options, ViewServerEvents events)
    : impl_(std::make_unique<Impl>(options, std::move(events))) {}
ViewServer::~ViewServer() = default;
uint16_t ViewServer::port() const { return impl_->port(); }
std::string ViewServer::url() const { return impl_->url(); }
void ViewServer::setReport(std::string html) { impl_->setReport(std::move(html)); }
size_t ViewServer::bytesUnread(ClientId client) const { return impl_->bytesUnread(client); }
uint64_t ViewServer::bytesWritten() const { return impl_->bytesWritten(); }
void ViewServer::send(ClientId client, std::string text) {
  impl_->send(client, {std::make_shared<const std::string>(std::move(text)), nullptr, {}});
}
void ViewServer::sendNewest(ClientId client, uint32_t slot, std::shared_ptr<const Bytes> bytes) {
  impl_->send(client, {nullptr, std::move(bytes), slot});
}
void ViewServer::sendNewest(ClientId client, uint32_t slot, std::string text) {
  impl_->send(client, {std::make_shared<const std::string>(std::move(text)), nullptr, slot});
}

}  // namespace restlab
