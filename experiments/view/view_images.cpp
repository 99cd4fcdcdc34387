#include "experiments/view/view_images.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "experiments/runner/base/image_file.h"
#include "experiments/runner/reference/beside_reference.h"

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

void takeReference(const fs::path& file, ViewImages& images) {
  images.reference = readReference(file);
  images.referenceFile = file;
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
    images.list.push_back(
        {freeName(images, file), file, std::move(read.layers.at("")), std::move(read.metadata)});
  }
  requireOneSize(images);
  if (images.reference) warnOfNoReference(images.referenceFile.string(), *images.reference);
  if (images.reference && !anyReference) requireOneScene(images);
  return images;
}

std::vector<std::string> tablesOfResults(const fs::path& folder) {
  std::vector<std::string> tables;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / "images", error)) {
    const std::string stem = entry.path().stem().string();
    if (entry.path().extension() == ".exr" && stem.ends_with(kReferenceEnd))
      tables.push_back(stem.substr(0, stem.size() - std::string(kReferenceEnd).size()));
  }
  std::sort(tables.begin(), tables.end());
  return tables;
}

ViewImages readResultsImages(const fs::path& folder, const std::string& table, bool anyReference) {
  const std::vector<std::string> tables = tablesOfResults(folder);
  if (tables.empty()) {
    failInput(fmt::format("{}: has no images of `restlab run` (images/*-reference.exr)",
                          folder.string()));
  }
  const std::string label = table.empty() ? tables.front() : table;
  if (std::find(tables.begin(), tables.end(), label) == tables.end()) {
    failUsage(fmt::format("--table {}: {} has no such table (it has: {}){}", label, folder.string(),
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
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / "images")) {
    const fs::path& file = entry.path();
    if (file.extension() == ".exr" && tableOf(file.stem().string()) == label && file != reference)
      files.push_back(file);
  }
  if (files.empty()) {
    failInput(fmt::format("{}: has no image of a method beside its reference", reference.string()));
  }
  std::sort(files.begin(), files.end());
  ViewImages images = readViewImages(files, reference, true, anyReference);
  images.title = fmt::format("{}: {}", folder.filename().string(), label);
  for (FileImage& one : images.list) {
    const std::string name = one.file.stem().string().substr(label.size() + 1);
    if (images.find(name) == nullptr && name != kReferenceSource) one.name = name;
  }
  return images;
}

}  // namespace restlab
