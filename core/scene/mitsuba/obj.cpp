#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <unordered_map>

#include "core/scene/mitsuba/mesh_files.h"

namespace restlab::mitsuba {
namespace {

// A corner of a face: indices of position, texture coordinate and normal, from 0; -1: none.
struct ObjCorner {
  int64_t position = -1, uv = -1, normal = -1;
  bool operator==(const ObjCorner&) const = default;
};
struct ObjCornerHash {
  size_t operator()(const ObjCorner& c) const {
    uint64_t h = uint64_t(c.position) * 0x9e3779b97f4a7c15u;
    h = (h ^ (h >> 29) ^ uint64_t(c.uv + 1)) * 0xbf58476d1ce4e5b9u;
    return size_t((h ^ (h >> 31) ^ uint64_t(c.normal + 1)) * 0x94d049bb133111ebu);
  }
};

class ObjReader {
 public:
  ObjReader(const Bytes& bytes, const std::string& file, Report& report)
      : text_(reinterpret_cast<const char*>(bytes.data()), bytes.size()),
        file_(file),
        report_(report) {}

  MeshGeometry read() {
    while (!text_.empty()) {
      ++line_;
      const size_t end = std::min(text_.find('\n'), text_.size());
      rest_ = text_.substr(0, end);
      begin_ = rest_.data();
      text_.remove_prefix(std::min(end + 1, text_.size()));
      readLine();
    }
    if (!hasNormals_) mesh_.normals.clear();
    if (!hasUvs_) mesh_.uvs[0].clear();
    checkMesh(mesh_, file_, report_);
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& text) const {
    report_.fail(
        fmt::format("{}:{}:{}", file_, line_, (word_.empty() ? rest_ : word_).data() - begin_ + 1),
        text);
  }

  // The next word of the line; "" behind the last.
  std::string_view nextWord() {
    const size_t first = std::min(rest_.find_first_not_of(" \t\r"), rest_.size());
    rest_.remove_prefix(first);
    const size_t end = std::min(rest_.find_first_of(" \t\r"), rest_.size());
    word_ = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return word_;
  }

  void readLine() {
    const std::string_view kind = nextWord();
    if (kind == "v") {
      const double x = number(), y = number(), z = number();
      positions_.push_back(glm::dvec3(x, y, z));
    } else if (kind == "vt") {
      const double u = number();
      uvs_.push_back(glm::dvec2(u, nextWord().empty() ? 0.0 : numberOf(word_)));
    } else if (kind == "vn") {
      const double x = number(), y = number(), z = number();
      normals_.push_back(glm::dvec3(x, y, z));
    } else if (kind == "f") {
      readFace();
    } else if (kind == "l" || kind == "p") {
      report_.warn("points and lines", fmt::format("{}:{}:1", file_, line_),
                   "points and lines are not drawn");
    }
  }

  double number() {
    if (nextWord().empty()) fail("the line ends early; a number expected");
    return numberOf(word_);
  }
  double numberOf(std::string_view word) {
    double value = 0.0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || stop != word.data() + word.size() || !(std::abs(value) <= 3e38))
      fail(fmt::format("'{}' is not a finite number", word.substr(0, 40)));
    return value;
  }

  // An index counts from 1, or backwards from the last (-1).
  int64_t index(std::string_view word, size_t count, const char* what) const {
    int64_t value = 0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || stop != word.data() + word.size())
      fail(fmt::format("'{}' is not an index", word.substr(0, 40)));
    const int64_t found = value < 0 ? int64_t(count) + value : value - 1;
    if (value == 0 || found < 0 || found >= int64_t(count))
      fail(fmt::format("{} {} does not exist; there are {}", what, value, count));
    return found;
  }

  ObjCorner cornerOf(std::string_view word) const {
    ObjCorner c;
    const size_t first = word.find('/');
    c.position = index(word.substr(0, first), positions_.size(), "vertex");
    if (first == std::string_view::npos) return c;
    const std::string_view after = word.substr(first + 1);
    const size_t second = after.find('/');
    const std::string_view uv = after.substr(0, second);
    if (!uv.empty()) c.uv = index(uv, uvs_.size(), "texture coordinate");
    if (second == std::string_view::npos) return c;
    const std::string_view normal = after.substr(second + 1);
    if (!normal.empty()) c.normal = index(normal, normals_.size(), "normal");
    return c;
  }

  uint32_t vertexOf(const ObjCorner& c) {
    const auto [entry, isNew] = vertices_.emplace(c, uint32_t(mesh_.positions.size()));
    if (!isNew) return entry->second;
    if (mesh_.positions.size() + 1 >= rl::RL_INVALID) fail("too many vertices");
    mesh_.positions.push_back(positions_[size_t(c.position)]);
    mesh_.uvs[0].push_back(c.uv < 0 ? glm::vec2(0.0f) : uvs_[size_t(c.uv)]);
    mesh_.normals.push_back(c.normal < 0 ? glm::vec3(0.0f) : normals_[size_t(c.normal)]);
    hasUvs_ = hasUvs_ || c.uv >= 0;
    hasNormals_ = hasNormals_ || c.normal >= 0;
    return entry->second;
  }

  void readFace() {
    uint32_t first = 0, last = 0;
    size_t count = 0;
    while (!nextWord().empty()) {
      const uint32_t vertex = vertexOf(cornerOf(word_));
      if (count == 0) first = vertex;
      if (count >= 2) mesh_.triangles.push_back({first, last, vertex});
      last = vertex;
      ++count;
    }
    if (count < 3) fail(fmt::format("a face of {} corners; at least 3 expected", count));
  }

  std::string_view text_, rest_, word_;
  const char* begin_ = nullptr;  // of the line
  const std::string& file_;
  Report& report_;
  size_t line_ = 0;
  std::vector<glm::vec3> positions_, normals_;
  std::vector<glm::vec2> uvs_;
  std::unordered_map<ObjCorner, uint32_t, ObjCornerHash> vertices_;
  MeshGeometry mesh_;
  bool hasUvs_ = false, hasNormals_ = false;
};

}  // namespace

MeshGeometry readObj(const Bytes& bytes, const std::string& file, Report& report) {
  // The shortest corner has two bytes and becomes a vertex, an entry of the map and a triangle.
  report.takeMemory(file, 24 * uint64_t(bytes.size()));
  return ObjReader(bytes, file, report).read();
}

}  // namespace restlab::mitsuba
