#include "experiments/view/view_sender.h"

namespace restlab {

namespace {

ViewServerEvents eventsInto(PageEvents& events) {
  using Kind = PageEvent::Kind;
  ViewServerEvents result;
  result.opened = [&events](ClientId page) { events.add({Kind::opened, page, ""}); };
  result.closed = [&events](ClientId page) { events.add({Kind::closed, page, ""}); };
  result.said = [&events](ClientId page, const std::string& text) {
    events.add({Kind::said, page, text});
  };
  return result;
}

}  // namespace

ViewSender::ViewSender(const ViewServerOptions& options, PageEvents& events)
    : server_(options, eventsInto(events)) {}

void ViewSender::tellAll(const std::string& text) {
  for (const ClientId page : pages_) server_.send(page, text);
}

void ViewSender::tellNewest(uint32_t slot, const std::string& text, bool isForUnseen) {
  for (const ClientId page : pages_)
    if (isForUnseen || unseen_.count(page) == 0) server_.sendNewest(page, slot, text);
}

uint64_t ViewSender::seenPanes() const {
  uint64_t seen = pages_.empty() ? ~uint64_t(0) : 0;
  for (const ClientId page : pages_) {
    if (unseen_.count(page) > 0) continue;
    const auto its = panes_.find(page);
    seen |= its == panes_.end() ? ~uint64_t(0) : its->second;
  }
  return seen;
}

void ViewSender::setSeen(ClientId page, bool isSeen, uint64_t panes) {
  if (pages_.count(page) > 0) panes_[page] = panes;
  if (isSeen) {
    unseen_.erase(page);
  } else if (pages_.count(page) > 0) {
    unseen_.insert(page);
  }
}

void ViewSender::show(ImageHeader header, const Image& image, bool isExact) {
  if (!hasPages()) return;
  const bool isSmall = image.pixels.size() * sizeof(glm::vec3) <= kSmallBytes;
  header.format = isExact || isSmall ? PixelFormat::floats : PixelFormat::halves;
  formats_[header.slot] = header.format;
  const auto bytes = std::make_shared<const Bytes>(imageMessage(header, image));
  for (const ClientId page : pages_)
    if (unseen_.count(page) == 0) server_.sendNewest(page, header.slot, bytes);
}

void ViewSender::showOnce(ImageHeader header, const Image& image) {
  const Version version{header.epoch, header.frame};
  std::shared_ptr<const Bytes> bytes;
  for (const ClientId page : pages_) {
    if (unseen_.count(page) > 0) continue;
    const auto [sent, isFirst] = standing_[page].try_emplace(header.slot, version);
    if (!isFirst && sent->second == version) continue;
    sent->second = version;
    if (!bytes) bytes = std::make_shared<const Bytes>(imageMessage(header, image));
    server_.sendNewest(page, header.slot, bytes);
  }
}

bool ViewSender::isRounded(uint32_t slot) const {
  const auto found = formats_.find(slot);
  return found != formats_.end() && found->second == PixelFormat::halves;
}

Transport ViewSender::transport() {
  const auto now = std::chrono::steady_clock::now();
  const std::chrono::duration<double> spent = now - measured_;
  if (spent.count() >= 1.0) {
    const uint64_t bytes = server_.bytesWritten();
    megabytesPerSecond_ = double(bytes - measuredBytes_) / 1e6 / spent.count();
    measuredBytes_ = bytes;
    measured_ = now;
  }
  return {isRounded(0) ? PixelFormat::halves : PixelFormat::floats, megabytesPerSecond_};
}

}  // namespace restlab
