// Images of files that a viewer shows instead of methods: given one by one, or left by `run` in a
// folder.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/runner/reference/reference.h"

namespace restlab {

struct FileImage {
  std::string name;  // unique; neither kMethodSource nor kReferenceSource
  std::filesystem::path file;
  Image image;
  std::map<std::string, std::string> metadata = {};
  std::optional<double> ms = {};  // time of a frame of a run, or of the whole picture of `render`
};

// Images and reference of one size.
struct ViewImages {
  std::string title;
  std::vector<FileImage> list;
  std::optional<Reference> reference;
  std::filesystem::path referenceFile;
  // Folder of results and its tables; empty of other images.
  std::filesystem::path folder;
  std::string table;
  std::vector<std::string> tables;
  bool anyReference = false;

  // Returns null if no image has that name.
  const FileImage* find(const std::string& name) const;
};

// Sources of a pane besides the names of images.
constexpr const char* kMethodSource = "";
constexpr const char* kReferenceSource = "reference";

// Reads images. Without `reference`, a file whose metadata says that it is a reference becomes the
// reference, if there is another image and `looksForReference` is set (methods have a reference of
// their own). Throws Error (badInput) if a file cannot be read, has another size than the first one
// or, unless `anyReference`, names another scene or setting than the reference; (badUsage) if
// `files` is empty or more than kMostImages; (deviceUnavailable) if the copies that go to pages
// find no memory.
ViewImages readViewImages(const std::vector<std::filesystem::path>& files,
                          const std::filesystem::path& reference = {},
                          bool looksForReference = true, bool anyReference = false);

// Reads the images of one table of a folder of results, by the methods' names and in the suite's
// order; table "": the first. Throws Error (badInput) if the folder has no images of `run`, and as
// readViewImages() does; (badUsage) if there is no such table.
ViewImages readResultsImages(const std::filesystem::path& folder, const std::string& table,
                             bool anyReference = false);

// Names of the folder's tables that have images, "cornell-box-all", in the suite's order; those
// that no record of the run names come last.
std::vector<std::string> tablesOfResults(const std::filesystem::path& folder);

}  // namespace restlab
