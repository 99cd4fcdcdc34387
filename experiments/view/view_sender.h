// Sends texts and images to the viewer's pages; newer ones replace those still waiting.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "experiments/view/view_messages.h"
#include "experiments/view/view_queue.h"

namespace restlab {

// Slots of images: a pane or an image of a file has its index, the layer over a pane
// kFirstLayerSlot + pane. The page has the same numbers.
constexpr uint32_t kReferenceSlot = kMostImages, kFirstLayerSlot = 2 * kMostImages;

class ViewSender {
 public:
  // Images of at most this size are sent as floats even while something moves.
  static constexpr size_t kSmallBytes = 512 << 10;

  ViewSender(const ViewServerOptions& options, PageEvents& events);

  std::string url() const { return server_.url(); }
  // True if at least one page is visible.
  bool hasPages() const { return pages_.size() > unseen_.size(); }
  void opened(ClientId page) { pages_.insert(page); }
  void closed(ClientId page) {
    pages_.erase(page);
    unseen_.erase(page);
    panes_.erase(page);
    standing_.erase(page);
  }
  // Hides or shows a page: a page in the background gets no numbers and no images. `panes`: those
  // that it shows, as bits.
  void setSeen(ClientId page, bool isSeen, uint64_t panes);
  bool isHidden(ClientId page) const { return unseen_.count(page) > 0; }
  // Panes that a visible page shows, as bits; all if no page is open.
  uint64_t seenPanes() const;

  // Sends texts in order. A page that does not read them for long is disconnected.
  void tell(ClientId page, const std::string& text) { server_.send(page, text); }
  void tellAll(const std::string& text);
  // Replaces a waiting text of the same kind.
  void tellState(const std::string& text) { tellNewest(kStateSlot, text, true); }
  void tellNumbers(const std::string& text) { tellNewest(kNumbersSlot, text, false); }
  void tellProgress(const std::string& text) { tellNewest(kProgressSlot, text, false); }
  // Sends to all visible pages. `isExact`: as floats, whatever the size.
  void show(ImageHeader header, const Image& image, bool isExact);
  // Sends an image that stands still, exact, to the visible pages that have not got it: slot, epoch
  // and frame say which one it is. The pages share one copy.
  void showOnce(ImageHeader header, const Image& image);

  size_t bytesUnread(ClientId page) const { return server_.bytesUnread(page); }
  void setReport(std::string html) { server_.setReport(std::move(html)); }

  // True if the slot's last image was sent as halves.
  bool isRounded(uint32_t slot) const;
  // Format of the first pane's last image and rate of bytes written over the last second.
  Transport transport();

 private:
  static constexpr uint32_t kStateSlot = 1000, kNumbersSlot = 1001, kProgressSlot = 1002;
  void tellNewest(uint32_t slot, const std::string& text, bool isForUnseen);

  using Version = std::pair<uint64_t, uint32_t>;  // epoch and frame

  std::set<ClientId> pages_, unseen_;
  std::map<ClientId, uint64_t> panes_;                        // of pages that show some panes only
  std::map<ClientId, std::map<uint32_t, Version>> standing_;  // what pages got, by slot
  std::map<uint32_t, PixelFormat> formats_;                   // by slot
  std::chrono::steady_clock::time_point measured_ = std::chrono::steady_clock::now();
  uint64_t measuredBytes_ = 0;
  double megabytesPerSecond_ = 0.0;
  ViewServer server_;  // last, destroyed first: it calls back
};

}  // namespace restlab
