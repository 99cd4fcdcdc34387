// A frame as code: the parts of a method record their buffers and passes, one part after another,
// for every frame. The graph is a description; core/frame/pipeline.h runs it on a backend.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/dialect/features.h"
#include "core/frame/part.h"

namespace restlab {

// Handle of a buffer in the graph. A buffer that is not there is false; kernels see it as null.
struct Buffer {
  static constexpr uint32_t kNone = 0xffffffffu;
  uint32_t index = kNone;
  explicit operator bool() const { return index != kNone; }
  bool operator==(const Buffer&) const = default;
};

// Two buffers of one kind: one of this frame and one of an earlier frame.
struct History {
  Buffer now, previous;
};

// Buffers that parts leave for the parts after them. Not there until a part has set them.
struct FrameBuffers {
  Buffer radiance;   // radiance of the frame, 12 bytes per pixel
  Buffer shown;      // the frame that is shown, 12 bytes per pixel; set by denoisers
  History surfaces;  // at pixel centres: core/gbuffer/gbuffer.h
  History features;  // of film samples, for denoisers: core/gbuffer/guide_data.h
  Buffer motion;     // of the features, to the last frame
  // Rasterised first hits: at pixel centres, and at the frame's film sample; and the boxes that
  // they were drawn from. Set by the first part that needs them (core/gbuffer/first_hits.h).
  Buffer centreHits, filmHits, rasterBoxes;
  // Number of frames that the radiance of each pixel averages, this one included: a float.
  Buffer radianceFrames;
  Buffer changes;  // core/temporal_gradients
  // Caches in world space: core/caches/README.md
  Buffer proposals, shadingPoints, insertions;
  // Radiance cache, in the order of rl::RadianceBuffers.
  Buffer cellKeys, cellPlaces, cellLight, cellRays;
};

// Facts about the frame to record.
struct FrameInfo {
  const std::string& mode;         // of the integrator
  const ParameterMap& parameters;  // resolved
  size_t pixels = 0;
  bool isNewView = true;             // camera or parameters differ from those of the frame before
  bool wantsRadianceFrames = false;  // a part reads FrameBuffers::radianceFrames
  const CompiledScene* scene = nullptr;
  // Frames recorded since buffers hold nothing of this scene with these parameters, and since its
  // light changed, if that was later. Cameras may have moved.
  uint32_t sceneAge = 0, lightAge = 0;
  // Box around the scene without strays, relative to CompiledScene::origin(): low and high corner.
  std::array<glm::vec3, 2> sceneBox{};

  // Number of groups of `perGroup` pixels; the last one may have fewer.
  size_t groups(size_t perGroup) const { return (pixels + perGroup - 1) / perGroup; }
};

// FrameInfo::sceneBox of a scene.
std::array<glm::vec3, 2> sceneBoxOf(const CompiledScene& scene);

// A buffer of the graph: `count` elements.
struct GraphBuffer {
  std::string name;  // unique in the graph
  std::string part;
  size_t count = 0;
  uint32_t elementBytes = 0;
  rl::FeatureMask features = 0;  // allocated only if kernels have one of these features; 0: always
  bool isHistory = false;
  bool isTransient = false;                                    // holds nothing between frames
  std::shared_ptr<const std::vector<uint32_t>> contents = {};  // from the host; null: zero at first
  bool isOnce = false;                                         // FrameGraph::onceBuffer

  size_t bytes() const { return count * elementBytes; }
};

// A pass of the graph: one kernel over all pixels, or over `entries` elements.
struct GraphPass {
  std::string name;  // name of its time column
  std::string part;
  std::string kernel;
  std::string vertexKernel;       // of a raster pass, whose fragment stage is `kernel`; "": none
  std::vector<std::byte> params;  // gParams
  std::vector<Buffer> slots;      // of the kernel's Buffers struct, in its order
  std::vector<Buffer> read, written;
  uint32_t entries = 0;   // 0: pixels
  bool isReplay = false;  // repeats earlier work whose health was already counted
  bool isOnce = false;    // work for the scene, of which no frame is the owner
  // This pass and those after it, `loopPasses` in all, run `loopTimes` times in turn. 0: no loop
  // begins here.
  uint32_t loopPasses = 0, loopTimes = 1;

  // The kernel finds the buffers that the pass declares, and null in all other slots.
  GraphPass& reads(std::initializer_list<Buffer> buffers);
  GraphPass& writes(std::initializer_list<Buffer> buffers);
  // Writes that depend on what was there, or leave some of it.
  GraphPass& updates(std::initializer_list<Buffer> buffers);
  // Runs over this many elements, at least one, instead of over pixels (RL_ENTRY_ROW).
  GraphPass& over(size_t elements);
  GraphPass& replays();
  // Draws the scene's triangles instead, with this vertex stage (core/raster/raster.h).
  GraphPass& rasters(const std::string& vertexStage);
  // Marks work for the scene, if `isForScene`: its time is told apart from that of frames.
  GraphPass& once(bool isForScene = true);

  // Buffer of a slot as the kernel sees it.
  Buffer bound(size_t slot) const;

 private:
  void declare(std::initializer_list<Buffer> buffers, std::vector<Buffer>& as);
};

class FrameGraph;

// Kernels that share one Buffers struct and one Params struct.
class Kernels {
 public:
  Kernels(FrameGraph& graph, std::vector<std::byte> params, std::vector<Buffer> slots)
      : graph_(graph), params_(std::move(params)), slots_(std::move(slots)) {}
  // Appends a pass to the frame. The reference holds until the next pass is appended.
  GraphPass& pass(const std::string& name, const std::string& kernel) const;

 private:
  FrameGraph& graph_;
  std::vector<std::byte> params_;
  std::vector<Buffer> slots_;
};

class FrameGraph {
 public:
  FrameBuffers shared;

  // Records a frame of the parts, in order, after forgetting the passes of the frame before.
  // Buffers stay; histories keep their turn. Parts whose condition is not met record nothing. Sets
  // frame.wantsRadianceFrames if a part reads them.
  void record(const std::vector<const PartInfo*>& parts, FrameInfo frame);

  // Declares a buffer, zero at first; the same one in every frame. Not there if `count` is 0. Its
  // contents stay until a pass writes it.
  Buffer buffer(const std::string& name, size_t count, uint32_t elementBytes,
                rl::FeatureMask features = 0);
  // Declares a buffer that passes write, as a whole, only in frames whose sceneAge or lightAge is
  // 0: a frame that is undone need not restore it.
  Buffer onceBuffer(const std::string& name, size_t count, uint32_t elementBytes);
  // Declares a buffer whose contents nobody needs after the frame's passes, except to look at the
  // frame before the next one begins. It may share memory: shareMemory().
  Buffer transient(const std::string& name, size_t count, uint32_t elementBytes,
                   rl::FeatureMask features = 0);
  // Declares two such buffers, `name` and `name_previous`.
  History history(const std::string& name, size_t count, uint32_t elementBytes,
                  rl::FeatureMask features = 0);
  // Begins a new element of a history: `now` of the last frame becomes `previous`.
  History advance(const History& history);

  // Declares a buffer that the host fills with whole elements before the first frame. Passes only
  // read it.
  Buffer table(const std::string& name, std::shared_ptr<const std::vector<uint32_t>> contents,
               uint32_t elementBytes);
  // Runs the passes that `body` records several times in turn. Their times are added up.
  void loop(uint32_t times, const std::function<void()>& body);

  // Lets transient buffers use the memory of histories whose last frame is not read any more when
  // the buffer is first written, in this frame of a new view and in a frame of a still view of the
  // same parts. `still`: that frame, recorded after this one.
  void shareMemory(const FrameGraph& still);
  // Returns whether the same histories lend to the same buffers.
  bool sharesAlike(const FrameGraph& other) const { return lenders_ == other.lenders_; }
  // The buffer that lends its memory to a transient one in this frame; false: it has its own.
  Buffer lenderOf(Buffer buffer) const;

  // Slots are in the order of the struct `Buffers`; each is a reference of 8 bytes.
  template <class Buffers, class Params>
  Kernels kernels(const Params& params, std::initializer_list<Buffer> slots) {
    return kernels<Buffers>(bytesOf(params), slots);
  }
  // `params`: bytes of the Params struct.
  template <class Buffers>
  Kernels kernels(std::vector<std::byte> params, std::initializer_list<Buffer> slots) {
    return {*this, std::move(params), checkedSlots(sizeof(Buffers), slots)};
  }

  const std::vector<GraphBuffer>& buffers() const { return buffers_; }
  const std::vector<GraphPass>& passes() const { return passes_; }
  // Passes in the order in which they run, with every turn of their loops.
  std::vector<size_t> order() const;
  // Passes of one part.
  std::vector<const GraphPass*> passesOf(const std::string& part) const;
  // Finds a buffer by name, with histories as the last recorded frame had them.
  Buffer find(const std::string& name) const;

 private:
  friend class Kernels;
  static std::vector<Buffer> checkedSlots(size_t structBytes, std::initializer_list<Buffer> slots);
  Buffer declare(const GraphBuffer& wanted);
  History historyOf(uint32_t first) const;
  bool isFreeFrom(uint32_t first, Buffer transient) const;

  std::vector<GraphBuffer> buffers_;
  std::map<std::string, uint32_t> byName_;
  std::vector<bool> isDeclared_;  // by buffer: in the frame that is recorded
  // By buffer: it is the first of a history, whose second is `now`.
  std::vector<bool> isSwapped_;
  std::vector<bool> isAdvanced_;   // by buffer, the first of a history: in this frame
  std::vector<uint32_t> lenders_;  // by buffer: the first of the history that lends; kNone
  std::vector<GraphPass> passes_;
  std::string part_;  // that records
};

}  // namespace restlab
