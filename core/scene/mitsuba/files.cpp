#include "core/scene/mitsuba/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "core/base/error.h"
#include "core/base/file_reason.h"
#include "core/scene/content_hash.h"

namespace restlab::mitsuba {
namespace fs = std::filesystem;
namespace {

std::vector<std::string> fileNamesIn(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator it(folder.empty() ? "." : folder, error), end; !error && it != end;
       it.increment(error))
    names.push_back(it->path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

fs::path pathBelow(const std::string& name, const std::string& place, const Report& report) {
  if (name.empty()) report.fail(place, "the file's name is empty");
  if (name.find('\0') != std::string::npos) report.fail(place, "the name holds a zero character");
  const fs::path path = fs::path(name).lexically_normal();
  if (path.is_absolute() || path.begin() == path.end() || *path.begin() == "..") {
    report.fail(place,
                fmt::format("'{}' leaves the scene's folder; only files below it are read", name));
  }
  return path;
}

}  // namespace

void Files::addFolder(const std::string& name, const std::string& place) {
  more_.push_back(folder_ / pathBelow(name, place, report_));
}

fs::path Files::find(const std::string& name, const std::string& place) const {
  const fs::path path = pathBelow(name, place, report_);
  std::error_code error;
  if (fs::is_regular_file(folder_ / path, error)) return folder_ / path;
  for (const fs::path& folder : more_)
    if (fs::is_regular_file(folder / path, error)) return folder / path;
  const fs::path file = folder_ / path;
  if (fs::exists(file, error)) report_.fail(place, fmt::format("'{}' is not a file", name));
  if (name.find('\\') != std::string::npos) {
    report_.fail(place,
                 fmt::format("file '{}' does not exist; folders are separated by '/'", name));
  }
  report_.fail(place,
               fmt::format("file '{}' does not exist{}", name,
                           didYouMean(path.filename().string(), fileNamesIn(file.parent_path()))));
}

std::vector<uint8_t> Files::read(const fs::path& file, const std::string& place,
                                 uint64_t mostBytes) {
  const std::string start = place.empty() ? "" : place + ": ";
  if (const std::string reason = unreadableReason(file); !reason.empty())
    failInput(fmt::format("{}{}: {}", start, file.string(), reason));
  std::error_code error;
  const uint64_t size = fs::file_size(file, error);
  if (error || !fs::is_regular_file(file, error))
    failInput(fmt::format("{}{}: is not a file", start, file.string()));
  if (size > mostBytes) {
    failInput(
        fmt::format("{}{}: {} bytes; at most {} expected", start, file.string(), size, mostBytes));
  }
  report_.takeMemory(fmt::format("{}{}: {} bytes", start, file.string(), size), size);
  std::vector<uint8_t> bytes(size);
  std::ifstream stream(file, std::ios::binary);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!stream || static_cast<uint64_t>(stream.gcount()) != size)
    failInput(fmt::format("{}{}: cannot be read", start, file.string()));
  hash_ = hashBytes(bytes.data(), bytes.size(), hash_);
  return bytes;
}

void Files::hash(const std::string& text) { hash_ = hashBytes(text.data(), text.size(), hash_); }

}  // namespace restlab::mitsuba
