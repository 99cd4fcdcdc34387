// Common base of integrators, caches and denoisers: parameters, and the passes that a part records
// for a frame (core/frame/frame_graph.h), one part after another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace rl {
struct FrameData;  // core/dialect/types.h
}

namespace restlab {

class CompiledScene;  // core/scene/compiled/compiled_scene.h
class FrameGraph;     // core/frame/frame_graph.h
struct FrameInfo;     // core/frame/frame_graph.h

using ParameterValue = std::variant<bool, int64_t, double, std::string>;

// A tunable constant: its default, range, meaning and the source of the default.
struct ParameterInfo {
  std::string name;  // unique among all parts: a method's parameters form one table
  ParameterValue defaultValue;
  double minValue = 0.0, maxValue = 0.0;  // inclusive; numbers only
  std::vector<std::string> choices;       // strings only
  std::string help;
  std::string source;  // paper, equation, or the measurement behind the default
  // A change of the value begins a new history: the old one holds light of the old value.
  bool beginsHistory = false;
  // Optional input that the parameter belongs to: without that input the number is 0. "": none.
  std::string needs = {};
  // The value changes noise and time, not the expected image.
  bool sameMean = false;
};

using ParameterMap = std::map<std::string, ParameterValue>;

// Bias of the mean over independent runs.
enum class BiasClass { unbiased, consistent, biased };

// Condition on a parameter: met if the method has `parameter` and it equals `value`. Without
// `value`, an integer must not be 0; any other type always meets the condition.
struct EnabledIf {
  const char* parameter = nullptr;  // null: always
  const char* value = nullptr;      // for a string parameter
};
bool isEnabled(const EnabledIf& only, const ParameterMap& resolved);

// Snapshot of a frame: buffers of the method after it, and its inputs.
struct FrameSnapshot {
  // All words of a buffer of any part, by name; empty if it is not allocated.
  std::function<std::span<const uint32_t>(const std::string& buffer)> words;
  const ParameterMap& parameters;  // resolved
  // Inputs of that frame; set only by a session.
  const rl::FrameData* frame = nullptr;
  const CompiledScene* scene = nullptr;
  std::span<const std::byte> params = {};  // gParams, from the frame
};

// A value that a part keeps for a pixel, as text for people.
struct ProbeValue {
  std::string name;
  std::string value;
};

// A candidate of a pixel's reservoir in the last frame: the donor of the sample, and the outcome.
struct Donor {
  std::string reuse;        // "canonical": the pixel's own; "space", "time", "entry"
  size_t id = 0;            // index of the donor's pixel; index of the entry
  std::string shift;        // "accepted", or the test that the shift to the pixel failed
  double confidence = 0.0;  // confidence with which it entered the merge
  // Known only for some accepted shifts. misWeight: resampling MIS weight; share: fraction of the
  // sum of resampling weights, which is the probability of being selected.
  std::optional<double> misWeight, share, jacobian;
  bool isSelected = false;  // selected in its merge
};

// A vertex of the path of a pixel's sample.
struct PathVertex {
  std::string
      name;  // "x1", "x2" and so on from the camera; the end may be "light" or "environment"
  // In metres, relative to CompiledScene::origin() until Session::path() has added it.
  glm::vec3 posW = {};
  bool isDirection = false;  // to the environment or a directional light: posW is a unit vector
  // Place on this frame's film, in pixels; it may lie outside the image. None: behind the camera.
  std::optional<glm::vec2> film;
  bool isReconnected = false;  // a shift keeps it; false: it is traced again from the other pixel
};

// A value that a part keeps for every pixel, shown as an image: one number per pixel.
struct LayerInfo {
  std::string name;     // unique among the parts of a method and Session::aovNames()
  std::string summary;  // one line: what it shows; the value is 0 where there is nothing
  std::string unit;     // "" if it has none
  bool isName = false;  // numbers are identifiers, not amounts: shown in false colours
  EnabledIf enabledIf = {};
  // Returns the words for a number, which a probe shows in its place. Null: it shows the number.
  std::string (*wordsOf)(float) = nullptr;
  // Returns the number of a pixel; valid while `FrameSnapshot` lives.
  std::function<std::function<float(size_t pixel)>(const FrameSnapshot&)> values;
};

struct PartInfo {
  std::string name;
  std::string summary;  // one line
  std::vector<ParameterInfo> parameters;
  // Defaults for parameters of other parts, if this part is in the method.
  std::map<std::string, ParameterValue> defaults;
  // Records the part's buffers and passes of a frame. Empty: it has none.
  std::function<void(FrameGraph&, const FrameInfo&)> record;
  // Buffers of FrameBuffers that the part cannot do without: they are recorded before it.
  bool needsSurfaces = false, needsFeatures = false;
  // The part reads FrameBuffers::changes, if the method finds changes (core/temporal_gradients).
  bool followsChanges = false;
  // The part reads FrameBuffers::radianceFrames, if the method has them.
  bool readsRadianceFrames = false;
  // If the condition is not met, the part records nothing.
  EnabledIf enabledIf = {};
  bool hasHistory = false;  // a frame depends on earlier frames
  // Best bias class of a method that contains this part.
  BiasClass bias = BiasClass::unbiased;
  // Says why a parameter (of this part or another one) or the "mode" has no effect, given the
  // parameters; "" if it has an effect, or if another part answers. Empty: every setting has an
  // effect.
  std::function<std::string(const std::string& name, const ParameterMap&)> reasonUnused;
  std::vector<LayerInfo> layers;
  // Values of a pixel beside its layers; empty: none.
  std::function<std::vector<ProbeValue>(const FrameSnapshot&, size_t pixel)> probe;
  // Recomputes the donors from the buffers that the frame has left, so that frames cost nothing
  // extra. Empty: the part merges no samples.
  std::function<std::vector<Donor>(const FrameSnapshot&, size_t pixel)> donors;
  // How far an iterated solution was from the next one, by iteration; empty: the part has none.
  std::function<std::vector<double>(const FrameSnapshot&)> residuals;
  // Traces the path of the sample that a pixel holds after the frame. Empty: the part keeps none.
  std::function<std::vector<PathVertex>(const FrameSnapshot&, size_t pixel)> path;
};

// A string of the resolved parameters.
inline const std::string& textOf(const ParameterMap& parameters, const char* name) {
  return std::get<std::string>(parameters.at(name));
}

// Bytes of a Params struct.
template <typename T>
std::vector<std::byte> bytesOf(const T& params) {
  const auto* from = reinterpret_cast<const std::byte*>(&params);
  return std::vector<std::byte>(from, from + sizeof(T));
}

}  // namespace restlab
