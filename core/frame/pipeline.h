// The passes of a frame and their buffers: those of a method's parts, in order.
#pragma once

#include <array>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/backend/backend.h"
#include "core/frame/frame_graph.h"

namespace restlab {

// The frame that was submitted last.
struct ShownFrame {
  const ParameterMap& parameters;
  const rl::FrameData& frame;
  const CompiledScene& scene;
};

class Pipeline {
 public:
  // `wanted`: the features of the kernels. Allocates nothing yet.
  Pipeline(Backend& backend, std::vector<const PartInfo*> parts, const std::string& mode,
           const ParameterMap& parameters, rl::FeatureMask wanted, size_t pixels,
           std::shared_ptr<const CompiledScene> scene);

  rl::FeatureMask featuresUsed() const { return used_; }
  // Bytes per pixel of each buffer that the kernels in use can touch, rounded up; 0: it uses the
  // memory of another one.
  std::vector<std::pair<std::string, size_t>> bufferBytesPerPixel() const;
  // Their sum, rounded up once: it may be less than the sum of the rounded ones.
  size_t bytesPerPixel() const { return bytesPerPixelOf(pixels_); }
  // Bytes per pixel for an image of another size: buffers of fixed size are shared by more or fewer
  // pixels.
  size_t bytesPerPixelOf(size_t pixels) const;
  // The frame begun last; before the first one, a frame of a new view.
  const FrameGraph& graph() const { return graph_; }
  // Bytes of a buffer of the graph; 0: no kernel in use touches it.
  size_t bytesOf(Buffer buffer) const;

  // Sets other parameters of the same mode, and makes passes ready that were left out before.
  // Returns false, and does nothing, if buffers would change their size or kernels need others.
  bool setParameters(const ParameterMap& parameters, StartupReport& report);
  // Values that the parts keep for a pixel: layers and other values.
  std::vector<ProbeValue> probe(size_t pixel, const ShownFrame& shown);
  std::vector<Donor> donors(size_t pixel, const ShownFrame& shown);
  std::vector<PathVertex> path(size_t pixel, const ShownFrame& shown);
  // PartInfo::residuals of the first part that has them.
  std::vector<double> residuals(const ShownFrame& shown);
  // Values of a part's layer, one per pixel.
  std::vector<float> layer(const LayerInfo& info, const ShownFrame& shown);

  // Sets the scene of later frames, which differs in its light alone.
  void setScene(std::shared_ptr<const CompiledScene> scene);

  // Kernels of the passes.
  std::vector<KernelUse> kernels() { return kernelsOf(graph_); }
  // Machine code of those that were compiled for the scene.
  size_t codeBytes();
  void allocate();
  void prepare(StartupReport& report);
  // Zeroes every buffer but the host's tables.
  void clear();
  // Copies every buffer that frames change. The first call allocates as much memory again as
  // allocate() did, and throws as Backend::allocate() does.
  void keep();
  bool hasCopies() const { return kept_.has_value(); }
  // Restores the snapshot taken by keep(); later frames are discarded.
  void restore();

  // Records the next frame and returns its passes. `isNewView`: camera or parameters differ from
  // the frame before.
  std::vector<PassRun> beginFrame(bool isNewView);
  // Returns names and times of a frame's passes, in the order of a new view's; `result` holds only
  // those that ran. A pass without work has no time.
  struct PassResult {
    std::string name;
    double timeMs = 0.0;
    PassCounters counters;
    bool isOnce = false;  // work for the scene (GraphPass::once)
  };
  std::vector<PassResult> collect(const FrameResult& result);

  // The shown buffer of the frame that was submitted last.
  BufferId shown() const;
  // Finds a buffer by name, to write data that no pass produces; kNoBuffer if it is not allocated.
  BufferId buffer(const std::string& name) const;
  // Reads a buffer; empty if it is not allocated.
  std::vector<uint32_t> words(Buffer buffer);
  std::vector<uint32_t> words(const std::string& buffer) { return words(graph_.find(buffer)); }

 private:
  FrameGraph recorded(const ParameterMap& parameters, size_t pixels) const;
  FrameInfo frameInfo(const ParameterMap& parameters, size_t pixels, bool isNewView,
                      uint32_t age) const;
  bool isUsed(const GraphBuffer& buffer) const;
  // Bytes that are allocated for the buffer itself.
  size_t ownBytes(const FrameGraph& graph, size_t index) const;
  // Bytes of the buffer's copy for keep().
  size_t copyBytes(size_t index) const;
  BufferId idOf(Buffer buffer) const;
  // Feature mask of the kernel that serves the scene.
  rl::FeatureMask maskOf(const std::string& kernel);
  std::vector<KernelUse> kernelsOf(const FrameGraph& graph);
  PassRun runOf(const GraphPass& pass);
  // Parameters that kernels of a part had in the frame begun last.
  std::span<const std::byte> paramsOf(const PartInfo& part) const;
  // Pairs of each buffer and its copy.
  std::vector<std::pair<BufferId, BufferId>> withCopies() const;

  // A pass that a frame may run, in the table of times.
  struct Column {
    std::string name;
    bool isReplay = false, isOnce = false;
    bool operator==(const Column&) const = default;
  };
  static Column columnOf(const GraphPass& pass) { return {pass.name, pass.isReplay, pass.isOnce}; }
  // Passes of a new view, and those that ran in one frame.
  struct Ran {
    std::vector<Column> columns;
    std::vector<size_t> runs;  // column of each run, in their order
  };

  Backend& backend_;
  std::vector<const PartInfo*> parts_;
  std::string mode_;
  ParameterMap parameters_;
  rl::FeatureMask wanted_ = 0;
  std::map<std::string, rl::FeatureMask> masks_;  // by kernel
  size_t pixels_ = 0;
  std::shared_ptr<const CompiledScene> scene_;
  struct Ages {
    uint32_t scene = 0, light = 0;  // FrameInfo::sceneAge, lightAge, of the next frame
  };
  Ages ages_;
  std::array<glm::vec3, 2> sceneBox_{};
  FrameGraph graph_;
  rl::FeatureMask used_ = 0;
  std::vector<Column> columns_;
  std::vector<BufferId> ids_;       // by buffer of the graph; kNoBuffer: not allocated
  std::deque<Ran> ran_;             // of the frames in flight
  std::optional<FrameGraph> kept_;  // snapshot of keep(); copies_ holds the contents
  Ages keptAges_;
  std::vector<BufferId> copies_;  // by buffer of the graph
};

}  // namespace restlab
