// The passes of a frame and their buffers: those of a method's parts, in order.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/backend/backend.h"
#include "core/frame/part.h"

namespace restlab {

// The frame that was submitted last.
struct ShownFrame {
  const ParameterMap& parameters;
  const rl::FrameData& frame;
  const CompiledScene& scene;
};

class Pipeline {
 public:
  // `wanted`: the features of the kernels. Throws Error (badUsage) if a part needs a buffer that no
  // earlier part has. Allocates nothing yet.
  Pipeline(Backend& backend, std::vector<const PartInfo*> parts, const std::string& mode,
           const ParameterMap& parameters, uint32_t wanted, size_t pixels);

  uint32_t featuresUsed() const { return used_; }
  // Bytes per pixel of the allocated buffers (those that the kernels in use can touch). Each is
  // rounded up, and so is their sum, which may be less than the sum of the rounded ones.
  std::vector<std::pair<std::string, size_t>> bufferBytesPerPixel() const;
  size_t bytesPerPixel() const;
  // Bytes per pixel for an image of another size: buffers of fixed size are shared by more or fewer
  // pixels.
  size_t bytesPerPixelOf(size_t pixels) const;

  // Sets other parameters of the same mode. Returns false, and does nothing, if buffers would
  // change their size.
  bool setParameters(const std::string& mode, const ParameterMap& parameters);
  // Values that the parts keep for a pixel: layers and other values.
  std::vector<ProbeValue> probe(size_t pixel, const ShownFrame& shown);
  std::vector<Donor> donors(size_t pixel, const ShownFrame& shown);
  // Values of a part's layer, one per pixel.
  std::vector<float> layer(const LayerInfo& info, const ShownFrame& shown);

  void allocate();
  void prepare(StartupReport& report);
  // Zeroes every buffer.
  void clear();
  // Copies every buffer. The first call allocates as much memory again as allocate() did, and
  // throws as Backend::allocate() does.
  void keep();
  bool hasCopies() const { return !kept_.empty(); }
  // Restores the snapshot taken by keep(); later frames are discarded.
  void restore();

  // Swaps histories and returns the passes of the next frame. `isNewView`: camera or parameters
  // differ from the frame before.
  std::vector<PassRun> beginFrame(bool isNewView);
  // Returns names and times of a frame's passes, in the order of beginFrame(); `result` holds only
  // those that ran. A pass without work has no time.
  struct PassResult {
    std::string name;
    double timeMs = 0.0;
    PassCounters counters;
  };
  std::vector<PassResult> collect(const FrameResult& result);

  // The shown buffer of the frame that was submitted last.
  BufferId shown() const;
  // Finds a buffer by name, to write data that no pass produces; kNoBuffer if it is not allocated.
  BufferId buffer(const std::string& name) const;
  // Reads a buffer by name; empty if it is not allocated.
  std::vector<uint32_t> words(const std::string& buffer);

 private:
  struct Stage {
    const PartInfo* info = nullptr;
    std::vector<std::byte> params;
    std::vector<std::byte> shownParams;  // parameters of the frame begun last
    std::vector<uint32_t> masks;         // by pass
    std::vector<uint32_t> entries;       // by pass; 0: pixels
    std::vector<bool> isEnabled;         // by pass: its PassInfo::enabledIf and its part's are met
    std::vector<size_t> bytes;           // by own buffer; 0: not allocated
    std::vector<BufferId> buffers;       // the part's own
    bool runs = true;                    // in the frame begun last
  };

  size_t bytesOf(const PartInfo& part, const BufferInfo& buffer,
                 const ParameterMap& parameters) const;
  void pack(Stage& stage, const std::string& mode, const ParameterMap& parameters) const;
  std::optional<std::pair<size_t, size_t>> find(const std::string& name, size_t before) const;
  BufferId bound(const Stage& stage, size_t buffer) const;
  std::vector<BufferId> bindings(size_t stage) const;
  // Pairs of each buffer of kept_ and its copy.
  std::vector<std::pair<BufferId, BufferId>> keptBuffers() const;
  PassRun runOf(size_t stage, size_t pass) const;

  Backend& backend_;
  std::vector<Stage> stages_;
  size_t pixels_ = 0;
  ParameterMap parameters_;
  uint32_t used_ = 0;
  std::deque<std::vector<bool>> ran_;  // by pass, for the frames in flight
  std::vector<Stage> kept_;            // snapshot of keep(); copies_ holds the contents
  std::vector<BufferId> copies_;       // copies of all buffers of all stages, in the order of kept_
};

}  // namespace restlab
