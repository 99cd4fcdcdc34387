// From the viewer to its pages: texts and images, of which the newest count.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>

#include "experiments/view/view_messages.h"
#include "experiments/view/view_queue.h"

namespace restlab {

// Slots of images; those of panes are 0 and 1, those of the layers over them 16 more.
constexpr uint32_t kReferenceSlot = 2, kFirstLayerSlot = 16;

class ViewSender {
 public:
  // Floats of so many bytes go out even while something moves.
  static constexpr size_t kSmallBytes = 512 << 10;

  ViewSender(const ViewServerOptions& options, PageEvents& events);

  std::string url() const { return server_.url(); }
  // Pages that somebody sees.
  bool hasPages() const { return pages_.size() > unseen_.size(); }
  void opened(ClientId page) { pages_.insert(page); }
  void closed(ClientId page) {
    pages_.erase(page);
    unseen_.erase(page);
  }
  // In the background of a browser a page gets no numbers and no images.
  void setSeen(ClientId page, bool isSeen);

  // In their order. A page that takes none for long is let go.
  void tell(ClientId page, const std::string& text) { server_.send(page, text); }
  void tellAll(const std::string& text);
  // Of each kind the newest.
  void tellState(const std::string& text) { tellNewest(kStateSlot, text, true); }
  void tellNumbers(const std::string& text) { tellNewest(kNumbersSlot, text, false); }
  // `isExact`: as floats, whatever it takes. To all pages that somebody sees.
  void show(ImageHeader header, const Image& image, bool isExact);

  size_t bytesUnread(ClientId page) const { return server_.bytesUnread(page); }
  void setReport(std::string html) { server_.setReport(std::move(html)); }

  // The slot's last image went out in halves.
  bool isRounded(uint32_t slot) const;
  // Of the panes' last image, and bytes on their way over the last second.
  Transport transport();

 private:
  static constexpr uint32_t kStateSlot = 1000, kNumbersSlot = 1001;
  void tellNewest(uint32_t slot, const std::string& text, bool isForUnseen);

  std::set<ClientId> pages_, unseen_;
  std::map<uint32_t, PixelFormat> formats_;  // by slot
  std::chrono::steady_clock::time_point measured_ = std::chrono::steady_clock::now();
  uint64_t measuredBytes_ = 0;
  double megabytesPerSecond_ = 0.0;
  ViewServer server_;  // the first to go: it calls back
};

}  // namespace restlab
