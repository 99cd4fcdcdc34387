// Common base of integrators, caches and denoisers: parameters, buffers and passes. A session runs
// the passes of its parts, one part after another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
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
};

using ParameterMap = std::map<std::string, ParameterValue>;

// Bias of the mean over independent runs.
enum class BiasClass { unbiased, consistent, biased };

// Condition on a parameter: met if the method has `parameter` and it equals `value`. Without
// `value`, an integer must be at least `least`; any other type always meets the condition.
struct EnabledIf {
  const char* parameter = nullptr;  // null: always
  const char* value = nullptr;      // for a string parameter
  int64_t least = 1;
};
bool isEnabled(const EnabledIf& only, const ParameterMap& resolved);

// A buffer with one entry per pixel, or as many as a parameter says.
struct BufferInfo {
  std::string name;  // unique among the parts of a method
  uint32_t entryBytes = 0;
  uint32_t neededFeatures = 0;  // allocated only if the mask has one of these bits; 0: always
  int swapWith = -1;            // index of the buffer it swaps with every frame
  // Names of integer parameters, or null: number of entries per pixel; number of pixels per entry;
  // total number of entries. Not allocated if the method lacks the parameter.
  const char* perParameter = nullptr;
  const char* onePerParameter = nullptr;
  const char* entriesParameter = nullptr;
};

struct PassInfo {
  std::string name;             // name of its time column
  std::string kernel;           // name in CMake's rl_add_kernel
  bool hasFeatures = true;      // false: NO_FEATURES, one kernel for every scene
  bool onlyOnNewViews = false;  // nothing to do in a still view
  // Integer parameter: the pass runs over that many entries (RL_ENTRY_ROW), not over pixels.
  const char* entriesParameter = nullptr;
  // Integer parameter: the pass runs over groups of that many pixels, or entries.
  const char* onePerParameter = nullptr;
  EnabledIf enabledIf = {};
  // For several passes of one kernel: replaces the first word of gParams, a uint. -1: gParams stays
  // as packParameters() packed it.
  int step = -1;
  bool isReplay = false;  // repeats earlier work whose health was already counted
};

// Buffers of a method after a frame.
struct Kept {
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
  std::string reuse;        // "own": the pixel's own, entering the merge; "space", "time", "entry"
  size_t id = 0;            // index of the donor's pixel; index of the entry
  std::string shift;        // "accepted", or the test that the shift to the pixel failed
  double confidence = 0.0;  // confidence with which it entered the merge
  // Known only for some accepted shifts. misWeight: resampling MIS weight; share: fraction of the
  // sum of resampling weights, which is the probability of being selected.
  std::optional<double> misWeight, share, jacobian;
  bool isSelected = false;  // selected in its merge
};

// A value that a part keeps for every pixel, shown as an image: one number per pixel.
struct LayerInfo {
  std::string name;     // unique among the parts of a method and Session::aovNames()
  std::string summary;  // one line: what it shows; the value is 0 where there is nothing
  std::string unit;     // "" if it has none
  bool isName = false;  // numbers are identifiers, not amounts: shown in false colours
  EnabledIf enabledIf = {};
  // Returns the number of a pixel; valid while `Kept` lives.
  std::function<std::function<float(size_t pixel)>(const Kept&)> values;
};

struct PartInfo {
  std::string name;
  std::string summary;  // one line
  std::vector<ParameterInfo> parameters;
  // Defaults for parameters of other parts, if this part is in the method.
  std::map<std::string, ParameterValue> defaults;
  // Names of buffers of earlier parts; the kernels' Buffers struct begins with them.
  std::vector<std::string> inputs;
  // Optional buffers of earlier parts, next in that struct; null if no earlier part has the name.
  std::vector<std::string> optionalInputs;
  // Own buffers of the part: the rest of the Buffers struct, in order.
  std::vector<BufferInfo> buffers;
  std::vector<PassInfo> passes;
  // If the condition is not met, the part has no buffers and its passes do not run.
  EnabledIf enabledIf = {};
  bool hasHistory = false;  // a frame depends on earlier frames
  // Best bias class of a method that contains this part.
  BiasClass bias = BiasClass::unbiased;
  // Run the passes only if this frame's view or parameters are new. Otherwise the earlier results
  // stand, and both buffers of a swapping pair are that of the last run.
  bool onlyOnNewViews = false;
  // Says why a parameter (of this part or another one) or the "mode" has no effect, given the
  // parameters; "" if it has an effect, or if another part answers. Empty: every setting has an
  // effect.
  std::function<std::string(const std::string& name, const ParameterMap&)> reasonUnused;
  // Packs validated parameters into the block that kernels read as gParams. `mode` is the
  // integrator's.
  std::function<std::vector<std::byte>(const std::string& mode, const ParameterMap&)>
      packParameters;
  std::vector<LayerInfo> layers;
  // Values of a pixel beside its layers; empty: none.
  std::function<std::vector<ProbeValue>(const Kept&, size_t pixel)> probe;
  // Recomputes the donors from the buffers that the frame has left, so that frames cost nothing
  // extra. Empty: the part merges no samples.
  std::function<std::vector<Donor>(const Kept&, size_t pixel)> donors;
};

// Bytes of a buffer, with resolved parameters.
size_t bufferBytes(const BufferInfo& buffer, const ParameterMap& parameters, size_t pixels);

// For packParameters: an integer and a number of the resolved parameters, as kernel types.
inline uint32_t uintOf(const ParameterMap& parameters, const char* name) {
  return static_cast<uint32_t>(std::get<int64_t>(parameters.at(name)));
}
inline float floatOf(const ParameterMap& parameters, const char* name) {
  return static_cast<float>(std::get<double>(parameters.at(name)));
}

// For packParameters: the bytes of a Params struct.
template <typename T>
std::vector<std::byte> bytesOf(const T& params) {
  const auto* from = reinterpret_cast<const std::byte*>(&params);
  return std::vector<std::byte>(from, from + sizeof(T));
}

}  // namespace restlab
