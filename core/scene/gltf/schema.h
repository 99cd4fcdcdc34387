// The part of glTF 2.0 that is imported, as tables: property names, types, ranges, references.
#pragma once

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace restlab::gltf {

struct Schema;

enum class Kind {
  integer,  // non-negative unless `low` says otherwise
  number,   // representable as a 32-bit float
  boolean,
  text,
  numbers,       // array of `count` numbers (0: any length)
  texts,         // array of strings
  object,        // JSON object of `schema`
  objects,       // array of objects of `schema`
  reference,     // index into the top-level array `target`
  references,    // array of such indices
  referenceMap,  // object: name -> index into `target`
  integerMap,    // object: name -> integer
  ignored,       // not imported; its content is not checked
};

// Consequence of a number out of range.
enum class OutOfRange {
  fails,
  clamps,  // a warning, and the nearest number in range is used
  warns,   // a warning, and the number is used
};

struct Field {
  const char* name;
  Kind kind;
  bool required = false;
  double low = -std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::max();
  bool lowExcluded = false;
  OutOfRange outOfRange = OutOfRange::fails;
  size_t count = 0;
  const char* target = nullptr;
  const Schema* schema = nullptr;
  std::vector<int> integers = {};       // allowed values (empty: all in range)
  std::vector<const char*> words = {};  // allowed strings (empty: all)
  // Nothing that is drawn depends on the field: a useless value gives a warning and is left out.
  // The same applies if the object has `unreadBeside`, or unless `enabledIf.name` has the value
  // `enabledIf.word`.
  bool isDispensable = false;
  const char* unreadBeside = nullptr;  // a property of the same object
  struct Says {
    const char* name = nullptr;
    const char* word = nullptr;
  } enabledIf = {};
};

struct Schema {
  std::vector<Field> fields;
  // Extension objects that are read on this object.
  std::vector<std::pair<const char*, const Schema*>> extensions = {};
};

// Schema of the whole document; all others hang below it.
const Schema& documentSchema();

// Names of the extensions that are imported.
const std::vector<std::string>& supportedExtensions();

}  // namespace restlab::gltf
