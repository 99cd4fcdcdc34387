#include "experiments/view/view_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/base/image_file.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/reference/beside_reference.h"
#include "experiments/view/command.h"
#include "experiments/view/results_record.h"

namespace restlab {

namespace {

namespace fs = std::filesystem;

constexpr const char* kReferenceEnd = "-reference";

bool saysItIsReference(const fs::path& file, const LayeredImage& read) {
  const auto kind = read.metadata.find("kind");
  return file.extension() == ".exr" && kind != read.metadata.end() && kind->second == "reference";
}

// Returns the shortest name that is not taken.
std::string freeName(const ViewImages& images, const fs::path& file) {
  const auto isFree = [&](const std::string& name) {
    return !name.empty() && name != kReferenceSource && images.find(name) == nullptr;
  };
  for (const std::string& name : {file.stem().string(), file.string()})
    if (isFree(name)) return name;
  for (int i = 2;; ++i) {
    const std::string name = fmt::format("{} {}", file.stem().string(), i);
    if (isFree(name)) return name;
  }
}

void requireOneSize(const ViewImages& images) {
  const FileImage& first = images.list.front();
  const auto require = [&](const fs::path& file, const Image& image) {
    const PixelWindow window = windowOf(image), firstWindow = windowOf(first.image);
    if (window == firstWindow) return;
    failInput(fmt::format("{}: is {}, and {} is {}; images of one {} can be compared",
                          file.string(), windowText(window, firstWindow), first.file.string(),
                          windowText(firstWindow, window),
                          window.origin == firstWindow.origin ? "size" : "window"));
  };
  for (const FileImage& one : images.list) require(one.file, one.image);
  if (images.reference) require(images.referenceFile, images.reference->mean);
}

// Requires that all images are of the reference's scene, as `compare` does.
void requireOneScene(const ViewImages& images) {
  const std::string reference = images.referenceFile.string();
  for (const FileImage& one : images.list)
    requireOfReference(one.file.string(), one.metadata, reference, images.reference->metadata);
}

// Milliseconds of a picture that `render` made.
std::optional<double> timeOf(const std::map<std::string, std::string>& metadata) {
  const auto kind = metadata.find("kind"), time = metadata.find("render_time_s");
  if (kind == metadata.end() || kind->second != "image" || time == metadata.end()) return {};
  const double seconds = std::strtod(time->second.c_str(), nullptr);
  return seconds > 0.0 ? std::optional(1000.0 * seconds) : std::nullopt;
}

void takeReference(const fs::path& file, ViewImages& images) {
  images.reference = readReference(file);
  images.referenceFile = file;
}

// Returns `found` in the order of `wanted`; names that it lacks stand at the end.
std::vector<std::string> inOrderOf(const std::vector<std::string>& wanted,
                                   std::vector<std::string> found) {
  const auto rank = [&](const std::string& name) {
    return std::find(wanted.begin(), wanted.end(), name) - wanted.begin();
  };
  std::stable_sort(found.begin(), found.end(),
                   [&](const std::string& a, const std::string& b) { return rank(a) < rank(b); });
  return found;
}

RecordedTable recordOf(const fs::path& folder, const std::string& label) {
  try {
    for (RecordedTable& table : recordedTables(folder, label))
      if (table.label == label) return std::move(table);
  } catch (const std::exception& error) {
    logWarning(fmt::format(
        "{}; methods and tables stand in the order of their names, without times", error.what()));
  }
  return {};
}

std::vector<std::string> recordedLabels(const fs::path& folder) {
  std::vector<std::string> labels;
  try {
    for (const RecordedTable& table : recordedTables(folder)) labels.push_back(table.label);
  } catch (const std::exception&) {
    labels.clear();  // recordOf() says so
  }
  return labels;
}

}  // namespace

const FileImage* ViewImages::find(const std::string& name) const {
  const auto found = std::find_if(list.begin(), list.end(),
                                  [&](const FileImage& one) { return one.name == name; });
  return found == list.end() ? nullptr : &*found;
}

ViewImages readViewImages(const std::vector<fs::path>& files, const fs::path& reference,
                          bool looksForReference, bool anyReference) {
  if (files.empty()) failUsage("no image is named");
  ViewImages images;
  if (files.size() > kMostImages) {
    failUsage(fmt::format("{} images are named, and a page shows at most {}; name fewer",
                          files.size(), kMostImages));
  }
  images.anyReference = anyReference;
  images.title = files.front().filename().string();
  if (files.size() > 1) images.title += fmt::format(" and {} more", files.size() - 1);
  if (!reference.empty()) takeReference(reference, images);
  for (const fs::path& file : files) {
    LayeredImage read = readColours(file);
    const bool isOnly = files.size() == 1;
    if (looksForReference && !images.reference && !isOnly && saysItIsReference(file, read)) {
      takeReference(file, images);
      continue;
    }
    images.list.push_back({freeName(images, file),
                           file,
                           std::move(read.layers.at("")),
                           std::move(read.metadata),
                           {}});
    images.list.back().ms = timeOf(images.list.back().metadata);
  }
  requireOneSize(images);
  const Image& first = images.list.front().image;
  requireMemory(fmt::format("{} images for a page", images.list.size() + 1), first.width,
                first.height, (images.list.size() + 1) * sizeof(glm::vec3));
  if (images.reference) warnOfNoReference(images.referenceFile.string(), *images.reference);
  if (images.reference && !anyReference) requireOneScene(images);
  return images;
}

std::vector<std::string> tablesOfResults(const fs::path& folder) {
  std::vector<std::string> found;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / "images", error)) {
    const std::string stem = entry.path().stem().string();
    if (entry.path().extension() == ".exr" && stem.ends_with(kReferenceEnd))
      found.push_back(stem.substr(0, stem.size() - std::string(kReferenceEnd).size()));
  }
  std::sort(found.begin(), found.end());
  return found.empty() ? found : inOrderOf(recordedLabels(folder), found);
}

ViewImages readResultsImages(const fs::path& folder, const std::string& table, bool anyReference) {
  const std::vector<std::string> tables = tablesOfResults(folder);
  if (tables.empty()) {
    failInput(fmt::format("{}: has no images of `restlab run` (images/*-reference.exr)",
                          folder.string()));
  }
  const std::string label = table.empty() ? tables.front() : table;
  if (std::find(tables.begin(), tables.end(), label) == tables.end()) {
    failUsage(fmt::format("table {}: {} has no such table (it has: {}){}", label, folder.string(),
                          fmt::join(tables, ", "), didYouMean(label, tables)));
  }
  // Take the longest table name that fits: one table's name may begin with another's.
  const auto tableOf = [&](const std::string& stem) {
    std::string longest;
    for (const std::string& one : tables)
      if (stem.starts_with(one + "-") && one.size() > longest.size()) longest = one;
    return longest;
  };
  const fs::path reference = folder / "images" / (label + kReferenceEnd + ".exr");
  std::vector<std::string> found, recorded;  // names behind the table's in those of the files
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / "images")) {
    const fs::path& file = entry.path();
    const std::string stem = file.stem().string();
    if (file.extension() == ".exr" && tableOf(stem) == label && file != reference)
      found.push_back(stem.substr(label.size() + 1));
  }
  if (found.empty()) {
    failInput(fmt::format("{}: has no image of a method beside its reference", reference.string()));
  }
  std::sort(found.begin(), found.end());
  const RecordedTable record = recordOf(folder, label);
  for (const std::string& method : record.methods) recorded.push_back(safeFileName(method));
  found = inOrderOf(recorded, found);
  std::vector<fs::path> files;
  for (const std::string& name : found)
    files.push_back(folder / "images" / fmt::format("{}-{}.exr", label, name));
  ViewImages images = readViewImages(files, reference, true, anyReference);
  images.title = fs::absolute(folder).lexically_normal().filename().string();
  if (images.title.empty())  // a slash at the end
    images.title = fs::absolute(folder).lexically_normal().parent_path().filename().string();
  images.folder = folder;
  images.table = label;
  images.tables = tables;
  for (size_t i = 0; i < found.size(); ++i) {
    const auto method = std::find(recorded.begin(), recorded.end(), found[i]);
    const std::string name =
        method == recorded.end() ? found[i] : record.methods[size_t(method - recorded.begin())];
    if (images.find(name) == nullptr && name != kReferenceSource) images.list[i].name = name;
    const auto ms = record.msOf.find(name);
    if (ms != record.msOf.end()) images.list[i].ms = ms->second;
  }
  return images;
}

}  // namespace restlab
