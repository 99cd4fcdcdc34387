// Sweeps: lists of values of a setting, each making its own tables, or of a key of a method, each
// making its own method.
#pragma once

#include <string>
#include <vector>

#include "core/base/config.h"
#include "experiments/runner/suite/swept_value.h"

namespace restlab {

// A key of [settings], or KEY, method.KEY or method.NAME.KEY of methods.
struct SweepAxis {
  std::string key;                 // as written
  std::string method, leaf;        // method "": every method that knows the leaf; or a setting
  std::vector<std::string> texts;  // TOML values
  std::string place;               // file:line:column or the option, for errors
};

struct Sweep {
  std::vector<SweepAxis> settings, methods;
};

// Lists the keys of a method that --set and [sweep] may change, without parameters.
const std::vector<std::string>& methodKeys();
// Lists the same keys and the parameters of that integrator and denoiser.
std::vector<std::string> methodKeys(const std::string& integrator, const std::string& denoiser);
// Lists the keys of a [[method]], rendered or a row of images.
std::vector<std::string> methodKeys(const ConfigTable& method);

// Splits "method.KEY" or "method.NAME.KEY" into name ("" in the first case) and key; false for
// other texts.
bool splitMethodKey(const std::string& key, std::string& method, std::string& leaf);

// Returns a TOML string without its quotes; any other value unchanged.
std::string unquoted(const std::string& text);

// Converts VALUES of "--sweep KEY=VALUES" to a TOML array: 1..8 counts, a,b,c are values or bare
// words, [..] stays as it is. Throws Error (badUsage) naming the option.
std::string sweepValues(const std::string& key, const std::string& values);

// Reads [sweep] of `root`. `settingsKeys`: known keys of [settings]. Throws Error (badUsage) with
// the place: empty lists, repeated values, unknown keys.
Sweep readSweep(const ConfigTable& root, const std::vector<std::string>& settingsKeys);

// Returns every combination of the axes' values, the last axis fastest; one empty combination
// without axes. Throws Error (badUsage) at the axis that makes more than 2000.
std::vector<std::vector<size_t>> combinations(const std::vector<SweepAxis>& axes);

// Returns the value of each axis.
std::vector<SweptValue> sweptValues(const std::vector<SweepAxis>& axes,
                                    const std::vector<size_t>& choice);

// Returns "confidence_cap=20, mode=biased", without the quotes of strings.
std::string sweepLabel(const std::vector<SweptValue>& values);

}  // namespace restlab
