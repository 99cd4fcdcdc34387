// What integrators, caches and denoisers have in common: parameters, buffers and passes. A session
// runs the passes of its parts, one part after another.
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

class CompiledScene;  // core/scene/compiled_scene.h

using ParameterValue = std::variant<bool, int64_t, double, std::string>;

// A tunable constant: its default, range, meaning and where the default comes from.
struct ParameterInfo {
  std::string name;  // unique among all parts: a method's parameters are one table
  ParameterValue defaultValue;
  double minValue = 0.0, maxValue = 0.0;  // inclusive; numbers only
  std::vector<std::string> choices;       // strings only
  std::string help;
  std::string source;  // paper, equation, or the measurement behind the default
  // A history under another value holds other light: a change begins a new one.
  bool beginsHistory = false;
  // The optional input that it is about: where that is missing, the number is 0. "": none.
  std::string needs = {};
};

using ParameterMap = std::map<std::string, ParameterValue>;

// How far the mean over independent runs is from the truth.
enum class BiasClass { unbiased, consistent, biased };

// Of what not every method has: it is there where the method has the parameter, with this value if
// one is named; otherwise, of an integer, with `least` or more.
struct OnlyWith {
  const char* parameter = nullptr;  // null: always
  const char* value = nullptr;      // of a parameter that is a string
  int64_t least = 1;
};
bool isThere(const OnlyWith& only, const ParameterMap& resolved);

// A buffer of as many entries as there are pixels, or as a parameter says.
struct BufferInfo {
  std::string name;  // unique among the parts of a method
  uint32_t entryBytes = 0;
  uint32_t neededFeatures = 0;  // allocated only when the mask has one of these bits; 0: always
  int swapWith = -1;            // index of the buffer it trades places with from frame to frame
  // Names of integer parameters, or null: so many entries a pixel; one for so many pixels; so many,
  // however many pixels there are. Not allocated where the method has no such parameter.
  const char* perParameter = nullptr;
  const char* onePerParameter = nullptr;
  const char* entriesParameter = nullptr;
};

struct PassInfo {
  std::string name;             // as in the time columns
  std::string kernel;           // as in CMake's rl_add_kernel
  bool hasFeatures = true;      // false: NO_FEATURES, it is the same for every scene
  bool onlyOnNewViews = false;  // it has nothing to do in a still view
  // An integer parameter: the pass runs over so many entries (RL_ENTRY_ROW), not over pixels.
  const char* entriesParameter = nullptr;
  // Another one: over groups of so many pixels, or of those entries.
  const char* onePerParameter = nullptr;
  OnlyWith onlyWith = {};
  // Of several passes of one kernel: gParams there begins with this number, a uint. -1: with what
  // packParameters() packed.
  int step = -1;
  bool isReplay = false;  // it does again what was done before, and its health was counted then
};

// What a method has left in its buffers after a frame.
struct Kept {
  // All words of a buffer of any of its parts, by name; empty where it is not allocated.
  std::function<std::span<const uint32_t>(const std::string& buffer)> words;
  const ParameterMap& parameters;  // resolved
  // Of that frame; of a session alone.
  const rl::FrameData* frame = nullptr;
  const CompiledScene* scene = nullptr;
  std::span<const std::byte> params = {};  // as the kernels of the part had them
};

// What a part keeps of a pixel, for people.
struct ProbeValue {
  std::string name;
  std::string value;
};

// Whose sample the reservoir of a pixel was offered in the last frame, and what came of it.
struct Donor {
  std::string reuse;        // "own": the pixel's, as it entered the merge; "space", "time", "entry"
  size_t id = 0;            // number of the donor's pixel; place of the entry
  std::string shift;        // "accepted", or the test that the shift to the pixel failed
  double confidence = 0.0;  // with which it entered
  // Where they are known, of a shift that was accepted: the resampling MIS weight, and the share
  // of the sum of resampling weights, which is the chance of being selected.
  std::optional<double> misWeight, share, jacobian;
  bool isSelected = false;  // in the merge that it entered
};

// What a part keeps of every pixel, as a picture: a number for each.
struct LayerInfo {
  std::string name;     // unique among the parts of a method and Session::aovNames()
  std::string summary;  // one line: what it shows; 0 where there is nothing
  std::string unit;     // "" where it has none
  bool isName = false;  // the numbers say which, not how much: to be seen in false colours
  OnlyWith onlyWith = {};
  // The number of a pixel, while `Kept` lives.
  std::function<std::function<float(size_t pixel)>(const Kept&)> values;
};

struct PartInfo {
  std::string name;
  std::string summary;  // one line
  std::vector<ParameterInfo> parameters;
  // Of other parts' parameters, where this part is in the method.
  std::map<std::string, ParameterValue> defaults;
  // Buffers of earlier parts by name, which the kernels' Buffers struct begins with.
  std::vector<std::string> inputs;
  // Such buffers after them, null where no earlier part has one of that name.
  std::vector<std::string> optionalInputs;
  // The part's own buffers: the rest of that struct, in order.
  std::vector<BufferInfo> buffers;
  std::vector<PassInfo> passes;
  // Otherwise it has no buffers, and its passes do not run.
  OnlyWith onlyWith = {};
  bool hasHistory = false;  // a frame depends on those before it
  // What the whole method is at best with this part in it.
  BiasClass bias = BiasClass::unbiased;
  // The passes run where this frame's view or parameters are new; otherwise what they left stands,
  // and buffers that swap are both that of the last run.
  bool onlyOnNewViews = false;
  // Why a parameter (of this part or of another one) or the "mode" changes nothing, the parameters
  // being what they are; "" where it does, or where another part knows. Empty: each does.
  std::function<std::string(const std::string& name, const ParameterMap&)> whyWithoutEffect;
  // Packs validated parameters into the block that kernels read as gParams. `mode` is the
  // integrator's.
  std::function<std::vector<std::byte>(const std::string& mode, const ParameterMap&)>
      packParameters;
  std::vector<LayerInfo> layers;
  // What there is to say of a pixel beside its layers; empty: nothing.
  std::function<std::vector<ProbeValue>(const Kept&, size_t pixel)> probe;
  // Computed again from what the frame has left, so that frames nobody asks about cost nothing.
  // Empty: the part merges no samples.
  std::function<std::vector<Donor>(const Kept&, size_t pixel)> donors;
};

// Of a buffer, with resolved parameters.
size_t bufferBytes(const BufferInfo& buffer, const ParameterMap& parameters, size_t pixels);

// For packParameters: an integer and a number of the resolved parameters, as kernels have them.
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
