// The passes of a frame and the buffers that they work on: those of a method's parts, in order.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/backend/backend.h"
#include "core/part.h"

namespace restlab {

// The frame that was submitted last.
struct ShownFrame {
  const ParameterMap& parameters;
  const rl::FrameData& frame;
  const CompiledScene& scene;
};

class Pipeline {
 public:
  // `wanted`: the features of the kernels. Throws Error (badUsage) where a part asks for a buffer
  // that no earlier part has. Nothing is allocated yet.
  Pipeline(Backend& backend, std::vector<const PartInfo*> parts, const std::string& mode,
           const ParameterMap& parameters, uint32_t wanted, size_t pixels);

  uint32_t featuresUsed() const { return used_; }
  // Of the buffers that the kernels in use can touch: one that they cannot is not allocated. Each
  // is rounded up, and so is their sum: it may be less than that of the rounded ones.
  std::vector<std::pair<std::string, size_t>> bufferBytesPerPixel() const;
  size_t bytesPerPixel() const;
  // Of an image of another size: what is no pixel's is shared by more or fewer of them.
  size_t bytesPerPixelOf(size_t pixels) const;

  // Other parameters, of the same mode. False, and nothing is done, where buffers would have
  // another size.
  bool setParameters(const std::string& mode, const ParameterMap& parameters);
  // What the parts keep of a pixel: their layers, and what else they have to say.
  std::vector<ProbeValue> probe(size_t pixel, const ShownFrame& shown);
  std::vector<Donor> donors(size_t pixel, const ShownFrame& shown);
  // A layer of a part, of every pixel.
  std::vector<float> layer(const LayerInfo& info, const ShownFrame& shown);

  void allocate();
  void prepare(StartupReport& report);
  // Zeroes every buffer.
  void clear();

  // The passes of the next frame, after histories have traded places. `isNewView`: its camera
  // or its parameters are not those of the frame before it.
  std::vector<PassRun> beginFrame(bool isNewView);
  // Names and times of a frame's passes, of which results holds those that ran; in the order of
  // beginFrame(). A pass that had nothing to do has no time.
  struct PassResult {
    std::string name;
    double timeMs = 0.0;
    PassCounters counters;
  };
  std::vector<PassResult> collect(const FrameResult& result);

  // Of the frame that was submitted last.
  BufferId shown() const;
  // A buffer by name, for who writes to it what no pass does; kNoBuffer where it is not allocated.
  BufferId buffer(const std::string& name) const;
  // Reads a buffer by name; empty where it is not allocated.
  std::vector<uint32_t> words(const std::string& buffer);

 private:
  struct Stage {
    const PartInfo* info = nullptr;
    std::vector<std::byte> params;
    std::vector<std::byte> shownParams;  // of the frame that was begun last
    std::vector<uint32_t> masks;         // of each pass
    std::vector<uint32_t> entries;       // of each pass; 0: pixels
    std::vector<bool> isThere;           // of each pass: PassInfo::onlyWith, and that of the part
    std::vector<size_t> bytes;           // of each own buffer; 0: not allocated
    std::vector<BufferId> buffers;       // the part's own
    bool runs = true;                    // in the frame that was begun last
  };

  size_t bytesOf(const PartInfo& part, const BufferInfo& buffer,
                 const ParameterMap& parameters) const;
  void pack(Stage& stage, const std::string& mode, const ParameterMap& parameters) const;
  std::optional<std::pair<size_t, size_t>> find(const std::string& name, size_t before) const;
  BufferId bound(const Stage& stage, size_t buffer) const;
  std::vector<BufferId> bindings(size_t stage) const;
  PassRun runOf(size_t stage, size_t pass) const;

  Backend& backend_;
  std::vector<Stage> stages_;
  size_t pixels_ = 0;
  ParameterMap parameters_;
  uint32_t used_ = 0;
  std::deque<std::vector<bool>> ran_;  // by pass, of the frames under way
};

}  // namespace restlab
