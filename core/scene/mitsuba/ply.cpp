#include <fmt/format.h>

#include <bit>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <string_view>

#include "core/scene/mitsuba/mesh_files.h"

namespace restlab::mitsuba {
namespace {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::optional<PlyType> plyType(std::string_view name) {
  constexpr std::pair<const char*, PlyType> kNames[] = {
      {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
      {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
      {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
      {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
      {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
      {"float64", PlyType::float64}};
  for (const auto& [known, type] : kNames)
    if (name == known) return type;
  return std::nullopt;
}

size_t sizeOf(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::float64:
      return 8;
    default:
      return 4;
  }
}

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  std::optional<PlyType> count;  // of a list
};
struct PlyElement {
  std::string name;
  uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

class PlyReader {
 public:
  PlyReader(const Bytes& bytes, const std::string& file, Report& report)
      : text_(reinterpret_cast<const char*>(bytes.data()), bytes.size()),
        file_(file),
        report_(report) {}

  MeshGeometry read() {
    readHeader();
    for (const PlyElement& element : elements_) readElement(element);
    checkMesh(mesh_, file_, report_);
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& text) const {
    report_.fail(inHeader_ || isText_
                     ? fmt::format("{}:{}:{}", file_, line_, at_ - std::min(lineStart_, at_) + 1)
                     : fmt::format("{}: byte {}", file_, at_),
                 text);
  }

  std::string_view nextLine() {
    if (at_ >= text_.size()) fail("the file ends within its header; 'end_header' expected");
    const size_t end = text_.find('\n', at_);
    if (end == std::string_view::npos)
      fail("the file ends within its header; 'end_header' expected");
    std::string_view line = text_.substr(at_, end - at_);
    lineStart_ = at_;
    ++line_;
    at_ = end + 1;
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
  }

  static std::vector<std::string_view> wordsOf(std::string_view line) {
    std::vector<std::string_view> words;
    while (true) {
      const size_t first = line.find_first_not_of(" \t");
      if (first == std::string_view::npos) return words;
      line.remove_prefix(first);
      const size_t end = std::min(line.find_first_of(" \t"), line.size());
      words.push_back(line.substr(0, end));
      line.remove_prefix(end);
    }
  }

  void readHeader() {
    if (text_.substr(0, 3) != "ply") report_.fail(file_ + ":1:1", "does not begin with 'ply'");
    nextLine();
    bool hasFormat = false;
    while (true) {
      const std::string_view line = nextLine();
      const std::vector<std::string_view> words = wordsOf(line);
      const size_t next = at_;
      at_ = lineStart_;  // the place of errors
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") {
      } else if (words[0] == "format") {
        readFormat(words);
        hasFormat = true;
      } else if (words[0] == "element") {
        readElementLine(words);
      } else if (words[0] == "property") {
        readPropertyLine(words);
      } else if (words[0] == "end_header") {
        if (!hasFormat) fail("the header has no 'format'");
        at_ = lineStart_ = next;
        inHeader_ = false;
        ++line_;
        return;
      } else {
        fail(fmt::format("'{}' is no line of a PLY header", words[0].substr(0, 40)));
      }
      at_ = next;
    }
  }

  void readFormat(const std::vector<std::string_view>& words) {
    const std::string_view name = words.size() > 1 ? words[1] : "";
    if (name != "ascii" && name != "binary_little_endian" && name != "binary_big_endian")
      fail(fmt::format("format '{}'; ascii, binary_little_endian or binary_big_endian expected",
                       name.substr(0, 40)));
    isText_ = name == "ascii";
    isBig_ = name == "binary_big_endian";
  }

  void readElementLine(const std::vector<std::string_view>& words) {
    PlyElement element;
    if (words.size() != 3) fail("'element NAME COUNT' expected");
    const auto [stop, error] =
        std::from_chars(words[2].data(), words[2].data() + words[2].size(), element.count);
    if (error != std::errc() || stop != words[2].data() + words[2].size())
      fail(fmt::format("'{}' is no number of elements", words[2].substr(0, 40)));
    element.name = words[1];
    elements_.push_back(std::move(element));
  }

  void readPropertyLine(const std::vector<std::string_view>& words) {
    if (elements_.empty()) fail("a property stands before the first element");
    const bool isList = words.size() == 5 && words[1] == "list";
    if (!isList && words.size() != 3)
      fail("'property TYPE NAME' or 'property list TYPE TYPE NAME' expected");
    PlyProperty property;
    property.name = words.back();
    const std::string_view typeName = words[isList ? 3 : 1];
    const std::optional<PlyType> type = plyType(typeName);
    if (isList) property.count = plyType(words[2]);
    if (!type || (isList && !property.count))
      fail(fmt::format("type '{}' is unknown", (type ? words[2] : typeName).substr(0, 40)));
    property.type = *type;
    elements_.back().properties.push_back(std::move(property));
  }

  // Each value has at least a digit and a gap as text: no count may claim more than the file holds.
  void checkCount(const PlyElement& element) const {
    uint64_t least = 0;
    for (const PlyProperty& p : element.properties)
      least += isText_ ? 2 : sizeOf(p.count ? *p.count : p.type);
    if (element.properties.empty()) fail(fmt::format("element '{}' has no property", element.name));
    const uint64_t left = text_.size() - std::min(at_, text_.size()) + 1;
    if (element.count > left / least)
      fail(fmt::format("{} elements '{}' need at least {} bytes; the file has {} more",
                       element.count, element.name,
                       element.count > left ? "that many" : std::to_string(element.count * least),
                       left - 1));
  }

  double value(PlyType type) { return isText_ ? textValue() : binaryValue(type); }

  double textValue() {
    while (at_ < text_.size() &&
           (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\r' || text_[at_] == '\n')) {
      if (text_[at_++] == '\n') {
        ++line_;
        lineStart_ = at_;
      }
    }
    if (at_ == text_.size()) fail("the file ends early; a number expected");
    double number = 0.0;
    const char *begin = text_.data() + at_, *end = text_.data() + text_.size();
    const auto [stop, error] = std::from_chars(begin, end, number);
    if (error != std::errc()) fail("a number expected");
    at_ += size_t(stop - begin);
    return number;
  }

  template <class T>
  double binary() {
    if (text_.size() - at_ < sizeof(T)) fail("the file ends early");
    uint8_t bytes[sizeof(T)];
    std::memcpy(bytes, text_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    if (isBig_ != (std::endian::native == std::endian::big))
      for (size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(bytes[i], bytes[sizeof(T) - 1 - i]);
    T v;
    std::memcpy(&v, bytes, sizeof(T));
    return double(v);
  }

  double binaryValue(PlyType type) {
    switch (type) {
      case PlyType::int8:
        return binary<int8_t>();
      case PlyType::uint8:
        return binary<uint8_t>();
      case PlyType::int16:
        return binary<int16_t>();
      case PlyType::uint16:
        return binary<uint16_t>();
      case PlyType::int32:
        return binary<int32_t>();
      case PlyType::uint32:
        return binary<uint32_t>();
      case PlyType::float32:
        return binary<float>();
      case PlyType::float64:
        return binary<double>();
    }
    return 0.0;
  }

  uint64_t listLength(const PlyProperty& p) {
    const double count = value(*p.count);
    const double most = double(text_.size() - at_) / double(isText_ ? 2 : sizeOf(p.type)) + 1.0;
    if (!(count >= 0.0 && count == std::floor(count) && count <= most))
      fail(fmt::format("a list of {:g} values; the file has no room for them", count));
    return uint64_t(count);
  }

  void readElement(const PlyElement& element) {
    if (element.count == 0) return;
    checkCount(element);
    if (element.name == "vertex") return readVertices(element);
    const bool isFace = element.name == "face";
    for (uint64_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& p : element.properties) {
        if (!p.count) {
          value(p.type);
          continue;
        }
        const uint64_t count = listLength(p);
        if (isFace && (p.name == "vertex_indices" || p.name == "vertex_index")) {
          readPolygon(p, count);
        } else {
          for (uint64_t k = 0; k < count; ++k) value(p.type);
        }
      }
    }
  }

  void readPolygon(const PlyProperty& p, uint64_t count) {
    if (count < 3) fail(fmt::format("a face of {} corners; at least 3 expected", count));
    uint32_t first = 0, last = 0;
    for (uint64_t k = 0; k < count; ++k) {
      const double index = value(p.type);
      if (!(index >= 0.0 && index < double(mesh_.positions.size()) && index == std::floor(index)))
        fail(
            fmt::format("vertex {:g} does not exist; there are {}", index, mesh_.positions.size()));
      if (k == 0) first = uint32_t(index);
      if (k >= 2) mesh_.triangles.push_back({first, last, uint32_t(index)});
      last = uint32_t(index);
    }
  }

  void readVertices(const PlyElement& element) {
    if (!mesh_.positions.empty()) fail("a second element 'vertex'");
    if (element.count >= rl::RL_INVALID)
      fail(fmt::format("{} vertices; fewer than {} expected", element.count, rl::RL_INVALID));
    // Where a value goes: 0 to 2 position, 3 to 5 normal, 6 and 7 texture coordinates, 8 to 10
    // colour.
    constexpr const char* kNames[] = {"x", "y", "z", "nx", "ny", "nz", "u", "v"};
    std::vector<int> places;
    bool has[8] = {};
    for (const PlyProperty& p : element.properties) {
      std::string name = p.name == "s" || p.name == "texture_u" ? "u" : p.name;
      if (name == "t" || name == "texture_v") name = "v";
      int place = -1;
      for (int i = 0; i < 8; ++i)
        if (name == kNames[i] && !p.count) place = i;
      if (place >= 0) has[place] = true;
      places.push_back(place);
    }
    if (!(has[0] && has[1] && has[2])) fail("element 'vertex' lacks x, y or z");
    const bool hasNormals = has[3] && has[4] && has[5], hasUvs = has[6] && has[7];
    report_.takeMemory(file_, element.count * 32);
    for (uint64_t i = 0; i < element.count; ++i) {
      double v[9] = {};
      for (size_t k = 0; k < places.size(); ++k) {
        const PlyProperty& p = element.properties[k];
        const uint64_t count = p.count ? listLength(p) : 1;
        for (uint64_t n = 0; n < count; ++n) v[places[k] < 0 ? 8 : places[k]] = value(p.type);
      }
      mesh_.positions.push_back(glm::dvec3(v[0], v[1], v[2]));
      if (hasNormals) mesh_.normals.push_back(glm::dvec3(v[3], v[4], v[5]));
      if (hasUvs) mesh_.uvs[0].push_back(glm::dvec2(v[6], v[7]));
    }
  }

  std::string_view text_;
  const std::string& file_;
  Report& report_;
  size_t at_ = 0, lineStart_ = 0, line_ = 0;
  bool inHeader_ = true, isText_ = false, isBig_ = false;
  std::vector<PlyElement> elements_;
  MeshGeometry mesh_;
};

}  // namespace

MeshGeometry readPly(const Bytes& bytes, const std::string& file, Report& report) {
  return PlyReader(bytes, file, report).read();
}

}  // namespace restlab::mitsuba
