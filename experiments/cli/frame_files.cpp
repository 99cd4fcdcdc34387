#include "experiments/cli/frame_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "core/base/error.h"
#include "experiments/runner/base/files.h"

namespace restlab {

namespace {

namespace fs = std::filesystem;

// Name split around a run of #, which stands for the number.
struct Pattern {
  fs::path folder;
  std::string before, after;
  size_t digits = 0;  // 0: no #
};

Pattern patternOf(const std::string& text) {
  const fs::path path(text);
  const std::string name = path.filename().string();
  Pattern pattern{path.parent_path(), name, "", 0};
  const size_t first = name.find('#');
  if (first == std::string::npos) return pattern;
  const size_t end = std::min(name.find_first_not_of('#', first), name.size());
  if (name.find('#', end) != std::string::npos || text.find('#') < text.size() - name.size())
    failUsage(fmt::format("{}: must have one run of # at most, in the file's name", text));
  pattern.before = name.substr(0, first);
  pattern.after = name.substr(end);
  pattern.digits = end - first;
  return pattern;
}

fs::path fileOf(const Pattern& pattern, uint64_t number) {
  return pattern.folder /
         fmt::format("{}{:0{}}{}", pattern.before, number, pattern.digits, pattern.after);
}

std::vector<uint64_t> numbersThere(const std::string& text, const Pattern& pattern) {
  std::vector<uint64_t> numbers;
  std::error_code error;
  const fs::path folder = pattern.folder.empty() ? "." : pattern.folder;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.size() < pattern.before.size() + pattern.digits + pattern.after.size() ||
        !name.starts_with(pattern.before) || !name.ends_with(pattern.after))
      continue;
    const char* from = name.data() + pattern.before.size();
    const char* to = name.data() + name.size() - pattern.after.size();
    uint64_t number = 0;
    const auto [end, status] = std::from_chars(from, to, number);
    if (status == std::errc() && end == to && name == fileOf(pattern, number).filename().string())
      numbers.push_back(number);
  }
  std::sort(numbers.begin(), numbers.end());
  if (numbers.empty()) failInput(fmt::format("{}: no such files", text));
  for (size_t i = 1; i < numbers.size(); ++i) {
    if (numbers[i] == numbers[i - 1] + 1) continue;
    failInput(fmt::format("{}: is missing between {} and {}",
                          fileOf(pattern, numbers[i - 1] + 1).string(), numbers[i - 1],
                          numbers[i]));
  }
  return numbers;
}

// Rejects outputs that would overwrite the input of a later frame.
void requireOthers(const std::vector<FrameFiles>& files) {
  std::set<fs::path> inputs;
  for (const FrameFiles& frame : files) inputs.insert(resolvedPath(frame.input));
  for (const FrameFiles& frame : files) {
    if (inputs.contains(resolvedPath(frame.output)))
      failUsage(fmt::format("-o {}: is an input", frame.output.string()));
  }
}

}  // namespace

std::vector<FrameFiles> frameFiles(const std::string& input, const std::string& output) {
  for (const std::string& text : {input, output}) {
    std::string extension = fs::path(text).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    if (extension != ".exr") failUsage(fmt::format("{}: must be named *.exr", text));
  }
  const Pattern from = patternOf(input), to = patternOf(output);
  if ((from.digits == 0) != (to.digits == 0))
    failUsage(fmt::format("-o {}: the input {} # for a sequence, so the output must{}", output,
                          from.digits == 0 ? "has no" : "has",
                          from.digits == 0 ? " have none" : ""));
  std::vector<FrameFiles> files;
  if (from.digits == 0) {
    files.push_back({input, output});
  } else {
    for (const uint64_t number : numbersThere(input, from))
      files.push_back({fileOf(from, number), fileOf(to, number)});
  }
  requireOthers(files);
  return files;
}

}  // namespace restlab
