// The XML of a Mitsuba scene as a tree: includes, <default>, $names and aliases are resolved, and
// every element knows its place.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/scene/mitsuba/files.h"
#include "core/scene/mitsuba/report.h"

namespace restlab::mitsuba {

struct Element {
  std::string tag;   // "shape", "rgb", ...
  std::string type;  // of a plugin
  std::string name;  // of a parameter, as of version 3: toWorld is to_world
  std::string id;
  std::vector<std::pair<std::string, std::string>> attributes;  // the others
  std::vector<Element> children;
  std::string place;  // "file:line:column"

  // nullptr if there is none of this name.
  const std::string* attribute(const std::string& name) const;
};

// Values of $names that the command line gives.
using Definitions = std::map<std::string, std::string>;

class Document {
 public:
  // Reads a file and what it includes. Throws Error (badInput).
  Document(const std::filesystem::path& file, const Definitions& given, Files& files,
           Report& report);

  const Element& scene() const { return scene_; }
  // Returns the element that a <ref> names; any other one is returned as it is.
  const Element& resolve(const Element& element) const;
  // Returns whether the file is of Mitsuba 0.4 to 0.6.
  bool isLegacy() const { return isLegacy_; }

 private:
  void readAliases();
  void collect(const Element& element);

  Report& report_;
  Element scene_;
  bool isLegacy_ = false;
  std::map<std::string, const Element*> ids_;
};

// "toWorld" and "intIOR" to "to_world" and "int_ior".
std::string snakeCase(const std::string& name);

}  // namespace restlab::mitsuba
