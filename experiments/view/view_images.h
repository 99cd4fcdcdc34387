// Images of files that a viewer shows in the place of methods: named one by one, or those that
// `run` left in a folder.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/runner/reference/reference.h"

namespace restlab {

struct FileImage {
  std::string name;  // unique, and none of kMethodSource and kReferenceSource
  std::filesystem::path file;
  Image image;
  std::map<std::string, std::string> metadata = {};
};

// All of one size.
struct ViewImages {
  std::string title;
  std::vector<FileImage> list;
  std::optional<Reference> reference;
  std::filesystem::path referenceFile;

  // Null where none has that name.
  const FileImage* find(const std::string& name) const;
};

// What a pane shows, beside the names of images.
constexpr const char* kMethodSource = "";
constexpr const char* kReferenceSource = "reference";

// A file that says of itself that it is a reference becomes that, where `reference` names none,
// another image is there and it is looked for: methods have a reference of their own. Throws Error
// (badInput) where a file cannot be read, is of another size than the first one or, unless
// `anyReference`, says that it is of another scene or setting than the reference; (badUsage) where
// there is none.
ViewImages readViewImages(const std::vector<std::filesystem::path>& files,
                          const std::filesystem::path& reference = {},
                          bool looksForReference = true, bool anyReference = false);

// Of one table of a folder of results: the one of that name, or the first. Throws Error (badInput)
// where the folder has no images of `run`, and as readViewImages() does; (badUsage) where it has
// none of that table.
ViewImages readResultsImages(const std::filesystem::path& folder, const std::string& table,
                             bool anyReference = false);

// Those of a folder that have images, in alphabetical order: "cornell-box-all".
std::vector<std::string> tablesOfResults(const std::filesystem::path& folder);

}  // namespace restlab
