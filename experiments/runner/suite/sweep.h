// Sweeps: lists of values of a setting, each of which makes tables of its own, or of something of a
// method, each of which makes a method of its own.
#pragma once

#include <string>
#include <vector>

#include "core/config.h"

namespace restlab {

// KEY of [settings], or KEY, method.KEY or method.NAME.KEY of methods.
struct SweepAxis {
  std::string key;                 // as it is written
  std::string method, leaf;        // "" of every method that knows the leaf; "" for a setting
  std::vector<std::string> texts;  // TOML values
  std::string place;               // file:line:column or the option, for errors
};

struct Sweep {
  std::vector<SweepAxis> settings, methods;
};

// What --set and [sweep] may change of a method besides its integrator's parameters.
const std::vector<std::string>& methodKeys();
// And with the parameters of that integrator.
std::vector<std::string> methodKeys(const std::string& integrator, const std::string& denoiser);
// Of a [[method]], whether it is rendered or a row of images.
std::vector<std::string> methodKeys(const ConfigTable& method);

// "method.KEY" or "method.NAME.KEY" into name ("" in the first case) and key; false for others.
bool splitMethodKey(const std::string& key, std::string& method, std::string& leaf);

// A TOML string without its quotes; any other value as it is.
std::string unquoted(const std::string& text);

// "--sweep KEY=VALUES" as a TOML array: 1..8 counts, a,b,c are values or bare words, [..] is
// itself. Throws Error (badUsage) naming the option.
std::string sweepValues(const std::string& key, const std::string& values);

// Reads [sweep] of `root`. `settingsKeys`: those that [settings] has. Throws Error (badUsage) with
// the place: empty lists, values twice, keys that nothing knows.
Sweep readSweep(const ConfigTable& root, const std::vector<std::string>& settingsKeys);

// Every combination of the axes' values, the last axis fastest; one empty one where there is none.
// Throws Error (badUsage) at the axis that makes more than 2000 of them.
std::vector<std::vector<size_t>> combinations(const std::vector<SweepAxis>& axes);

// "confidence_cap=20, mode=biased", without the quotes of strings.
std::string sweepLabel(const std::vector<SweepAxis>& axes, const std::vector<size_t>& choice);

}  // namespace restlab
