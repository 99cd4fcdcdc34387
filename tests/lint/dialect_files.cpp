#include "tests/lint/dialect_files.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>

#include "tests/lint/tokens.h"
#include "tests_kernel_list.h"

namespace restlab::lint {

namespace {

const std::filesystem::path kRoot = RESTLAB_SOURCE_DIR;
const std::filesystem::path kGenerated = RESTLAB_GENERATED_DIR;

void follow(const std::string& path, std::set<std::string>& seen) {
  if (!seen.insert(path).second) return;
  for (const Directive& d : tokenize(path, readSource(path)).directives) {
    const size_t open = d.text.find('"');
    if (d.text.find("include") == std::string::npos || open == std::string::npos) continue;
    const size_t close = d.text.find('"', open + 1);
    follow(d.text.substr(open + 1, close - open - 1), seen);
  }
}

// Blanks the lines in which a closure declares itself: they are C++ of the host.
std::string withoutDeclaration(std::string text) {
  const size_t begin = text.find("#ifdef RL_CLOSURE_DECLARED");
  if (begin == std::string::npos) return text;
  const size_t first = text.find('\n', begin), end = text.find("#else", begin);
  for (size_t i = first; i < end; ++i) {
    if (text[i] != '\n') text[i] = ' ';
  }
  return text;
}

bool hasExtension(const std::string& path, const char* extension) {
  return std::filesystem::path(path).extension() == extension;
}

}  // namespace

const std::vector<Kernel>& kernels() {
  static const std::vector<Kernel> list = {RESTLAB_KERNEL_LIST};
  return list;
}

const std::vector<std::string>& traceFiles() {
  static const std::vector<std::string> files = {"core/geometry/trace_bvh.glsl"};
  return files;
}

std::string readSource(const std::string& path) {
  std::ifstream stream(kRoot / path, std::ios::binary);
  if (!stream) stream.open(kGenerated / path, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot read " + (kRoot / path).string());
  return withoutDeclaration(
      {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()});
}

const std::vector<std::string>& dialectFiles() {
  static const std::vector<std::string> files = [] {
    std::set<std::string> seen;
    follow("core/dialect/order.h", seen);
    follow("core/dialect/order.glsl", seen);
    for (const std::string& trace : traceFiles()) follow(trace, seen);
    for (const Kernel& kernel : kernels()) {
      follow(kernel.header, seen);
      follow(kernel.file, seen);
    }
    return std::vector<std::string>(seen.begin(), seen.end());
  }();
  return files;
}

std::vector<std::string> dialectHeaders() {
  std::vector<std::string> headers;
  for (const std::string& file : dialectFiles()) {
    if (hasExtension(file, ".h")) headers.push_back(file);
  }
  return headers;
}

std::vector<std::string> allGlslFiles() {
  std::vector<std::string> files;
  for (const char* folder : {"core", "integrators"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / folder)) {
      if (!entry.is_regular_file() || entry.path().extension() != ".glsl") continue;
      const std::string path = std::filesystem::relative(entry.path(), kRoot).generic_string();
      if (!path.starts_with("core/backend/")) files.push_back(path);
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace restlab::lint
