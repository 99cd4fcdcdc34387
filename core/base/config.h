// TOML to typed values with positions. A table remembers which keys were read; finish() then
// reports the first key that was not, with file, line, column and the nearest name:
//   suite.toml:4:1: unknown key 'sceen', did you mean 'scene'?
// Every error is an Error with ExitCode::badUsage.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/frame/integrator.h"

namespace restlab {

class ConfigTable {
 public:
  // Parses a file and the files that it includes (core/base/config_include.h).
  static ConfigTable parseFile(const std::filesystem::path& file);
  // Parses `text`; `name` replaces the file name in messages.
  static ConfigTable parseText(const std::string& text, const std::string& name);

  bool has(const std::string& key) const;

  // Values by key; the fallback is returned if the key is absent. Ranges are inclusive. A NaN is
  // never inside a range.
  std::string getString(const std::string& key, const std::string& fallback) const;
  std::string getChoice(const std::string& key, const std::string& fallback,
                        const std::vector<std::string>& choices) const;
  bool getBool(const std::string& key, bool fallback) const;
  int64_t getInteger(const std::string& key, int64_t fallback, int64_t min, int64_t max) const;
  double getNumber(const std::string& key, double fallback,
                   double min = -std::numeric_limits<double>::max(),
                   double max = std::numeric_limits<double>::max()) const;
  // Reads an array of strings, or one string as an array of one.
  std::vector<std::string> getStrings(const std::string& key,
                                      const std::vector<std::string>& fallback = {}) const;
  std::vector<int64_t> getIntegers(const std::string& key, const std::vector<int64_t>& fallback,
                                   int64_t min, int64_t max) const;
  // Reads the values of an array, or one value, each as TOML text that assign() accepts.
  std::vector<std::string> getTexts(const std::string& key) const;
  // Keys in the order of the file.
  std::vector<std::string> keys() const;
  // Keys that were read, in alphabetical order.
  std::vector<std::string> known() const;
  // The table as TOML, including assigned values.
  std::string text() const;
  // Reads an array of `count` numbers, each inside the range, or one number as an array of one.
  std::vector<double> getNumbers(const std::string& key, const std::vector<double>& fallback,
                                 size_t count, double min, double max) const;
  // Reads an array of numbers of any length; empty if the key is absent.
  std::vector<double> getList(const std::string& key, double min, double max) const;
  // Reads an array of arrays of `width` numbers; empty if the key is absent.
  std::vector<std::vector<double>> getRows(const std::string& key, size_t width, double min,
                                           double max) const;
  // [key]: an empty table if the key is absent.
  ConfigTable getTable(const std::string& key) const;
  // [[key]]: the tables in the order of the file.
  std::vector<ConfigTable> getTables(const std::string& key) const;
  // Reads the key `info.name` with the type, range and choices of `info`; nullopt if absent.
  std::optional<ParameterValue> getParameter(const ParameterInfo& info) const;

  // Sets a key of this table as `--set` does: `valueText` is a TOML value, or else a bare string.
  // Messages about the value name `place` instead of a file and line.
  void assign(const std::string& key, const std::string& valueText, const std::string& place);

  // Takes a key out of this table.
  void remove(const std::string& key);

  // Throws badUsage at the key (or at the table if the key is absent): "place: message".
  [[noreturn]] void fail(const std::string& key, const std::string& message) const;
  // "file:line:column" of the key's value, or of the table.
  std::string place(const std::string& key = "") const;
  // Throws badUsage at the first key, in file order, that was never read.
  void finish() const;

 private:
  struct Node;
  struct Document;
  ConfigTable(std::shared_ptr<Document> document, Node* node);
  std::shared_ptr<Document> document_;
  Node* node_;  // owned by the document
};

// Parses the value of `--set NAME=TEXT` with the type, range and choices of `info`; errors name
// `place`.
ParameterValue parseParameter(const ParameterInfo& info, const std::string& text,
                              const std::string& place);

// Splits "KEY=VALUE" of an option; throws badUsage if '=' or the key is missing.
std::pair<std::string, std::string> splitAssignment(const std::string& assignment,
                                                    const std::string& option = "--set");

}  // namespace restlab
