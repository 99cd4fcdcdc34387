#include "core/scene/mitsuba/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <pugixml.hpp>
#include <set>

#include "core/base/error.h"

namespace restlab::mitsuba {
namespace fs = std::filesystem;
namespace {

constexpr uint64_t kMostXmlBytes = uint64_t(256) << 20;
constexpr int kMostDepth = 64;     // of elements in each other
constexpr int kMostIncludes = 16;  // of files in each other
constexpr size_t kMostElements = 1u
                                 << 22;  // of all files, includes counted as often as they are read
constexpr size_t kMostValueBytes = 1u << 24;

// Places in a text: offset to line and column.
class Lines {
 public:
  Lines(std::string file, const std::vector<uint8_t>& bytes) : file_(std::move(file)) {
    for (size_t i = 0; i < bytes.size(); ++i)
      if (bytes[i] == '\n') starts_.push_back(i + 1);
  }
  std::string place(ptrdiff_t offset) const {
    const size_t at = offset < 0 ? 0 : size_t(offset);
    const auto next = std::upper_bound(starts_.begin(), starts_.end(), at);
    const size_t line = size_t(next - starts_.begin());
    return fmt::format("{}:{}:{}", file_, line, at - starts_[line - 1] + 1);
  }

 private:
  std::string file_;
  std::vector<size_t> starts_ = {0};
};

bool isNameLetter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

class XmlReader {
 public:
  XmlReader(const Definitions& given, Files& files, Report& report)
      : given_(given), values_(given), files_(files), report_(report) {}

  Element readScene(const fs::path& file, bool& isLegacy) {
    Element scene;
    scene.tag = "scene";
    readFile(file, "", scene, &isLegacy);
    checkGiven(file.string());
    return scene;
  }

 private:
  void readFile(const fs::path& file, const std::string& from, Element& into, bool* isLegacy) {
    const fs::path normal = file.lexically_normal();
    if (std::find(open_.begin(), open_.end(), normal) != open_.end())
      report_.fail(from, fmt::format("'{}' includes itself", file.string()));
    if (int(open_.size()) >= kMostIncludes)
      report_.fail(from, fmt::format("more than {} files include each other", kMostIncludes));
    open_.push_back(normal);
    const std::vector<uint8_t> bytes = files_.read(file, from, kMostXmlBytes);
    const Lines lines(file.string(), bytes);
    pugi::xml_document xml;
    // Tags and texts take several times the bytes of the file.
    report_.takeMemory(file.string(), 16 * uint64_t(bytes.size()));
    const pugi::xml_parse_result result = xml.load_buffer(bytes.data(), bytes.size());
    if (!result) {
      std::string text = result.description();
      for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      report_.fail(lines.place(result.offset), fmt::format("{}; complete XML expected", text));
    }
    const pugi::xml_node root = xml.document_element();
    const std::string place = lines.place(root.offset_debug() - 1);
    if (std::string(root.name()) != "scene")
      report_.fail(place,
                   fmt::format("the root is <{}>; <scene version=\"3.0.0\"> of Mitsuba expected",
                               root.name()));
    readVersion(root, place, isLegacy);
    if (isLegacy != nullptr) {
      into.place = place;
      into.name = "scene";
    }
    readChildren(root, lines, into, 1);
    open_.pop_back();
  }

  void readVersion(const pugi::xml_node& root, const std::string& place, bool* isLegacy) {
    const std::string version = root.attribute("version").value();
    if (version.empty()) report_.fail(place, "<scene> has no version; version=\"3.0.0\" expected");
    const size_t dot = version.find('.');
    const std::string major = version.substr(0, dot);
    const bool isKnown = dot != std::string::npos &&
                         (major == "0" || major == "1" || major == "2" || major == "3") &&
                         version.find_first_not_of("0123456789.") == std::string::npos;
    if (!isKnown)
      report_.fail(place, fmt::format("version '{}' is unknown; 0.4.0 to 3.x.x expected", version));
    if (isLegacy != nullptr) *isLegacy = major == "0" || major == "1";
  }

  void readChildren(const pugi::xml_node& node, const Lines& lines, Element& into, int depth) {
    for (const pugi::xml_node& child : node.children()) {
      const std::string place = lines.place(child.offset_debug() - 1);
      if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata)
        report_.fail(place, fmt::format("text stands between elements: '{}'",
                                        std::string(child.value()).substr(0, 40)));
      if (child.type() != pugi::node_element) continue;
      if (depth > kMostDepth)
        report_.fail(place, fmt::format("elements are nested deeper than {} levels", kMostDepth));
      if (++elements_ > kMostElements)
        report_.fail(place, fmt::format("more than {} elements", kMostElements));
      readChild(child, lines, place, into, depth);
    }
  }

  void readChild(const pugi::xml_node& node, const Lines& lines, const std::string& place,
                 Element& into, int depth) {
    Element element;
    element.tag = node.name();
    element.place = place;
    for (const pugi::xml_attribute& attribute : node.attributes()) {
      const std::string value = substitute(attribute.value(), place);
      const std::string name = attribute.name();
      if (name == "type") {
        element.type = value;
      } else if (name == "name") {
        element.name = value;
      } else if (name == "id") {
        element.id = value;
      } else {
        element.attributes.emplace_back(name, value);
      }
    }
    if (element.tag == "default") return readDefault(element);
    if (element.tag == "include") {
      const fs::path file = files_.find(needed(element, "filename"), place);
      return readFile(file, place, into, nullptr);
    }
    if (element.tag == "path") return files_.addFolder(needed(element, "value"), place);
    element.name = snakeCase(element.name);
    readChildren(node, lines, element, depth + 1);
    into.children.push_back(std::move(element));
  }

  const std::string& needed(const Element& element, const char* name) const {
    const std::string* value = element.attribute(name);
    if (value == nullptr)
      report_.fail(element.place, fmt::format("<{}> has no '{}'", element.tag, name));
    return *value;
  }

  void readDefault(const Element& element) {
    if (element.name.empty()) report_.fail(element.place, "<default> has no 'name'");
    known_.insert(element.name);
    values_.emplace(element.name, needed(element, "value"));  // what is given wins
  }

  std::string substitute(const std::string& text, const std::string& place) {
    if (text.find('$') == std::string::npos) return text;
    std::string result;
    for (size_t i = 0; i < text.size();) {
      if (text[i] != '$') {
        result += text[i++];
        continue;
      }
      size_t end = i + 1;
      while (end < text.size() && isNameLetter(text[end])) ++end;
      const std::string name = text.substr(i + 1, end - i - 1);
      const auto value = values_.find(name);
      if (value == values_.end()) {
        std::vector<std::string> names;
        for (const auto& [key, unused] : values_) names.push_back(key);
        report_.fail(place, fmt::format("'${}' has no value; <default name=\"{}\" value=\"...\"/> "
                                        "above or --define {}=... expected{}",
                                        name, name, name, didYouMean(name, names)));
      }
      known_.insert(name);
      result += value->second;
      bytes_ += value->second.size();
      // A few values that name each other twice would grow without end.
      if (bytes_ > kMostValueBytes)
        report_.fail(
            place, fmt::format("values of $names have more than {} bytes in all", kMostValueBytes));
      i = end;
    }
    return result;
  }

  void checkGiven(const std::string& file) const {
    for (const auto& [name, value] : given_) {
      if (known_.count(name) != 0) continue;
      report_.fail(file, fmt::format("no <default> and no '$' has the name '{}' that is defined{}",
                                     name, didYouMean(name, {known_.begin(), known_.end()})));
    }
  }

  const Definitions& given_;
  Definitions values_;
  Files& files_;
  Report& report_;
  std::set<std::string> known_;
  std::vector<fs::path> open_;
  size_t elements_ = 0;
  size_t bytes_ = 0;
};

}  // namespace

std::string snakeCase(const std::string& name) {
  std::string result;
  const auto isUpper = [&](size_t i) {
    return i < name.size() && std::isupper(static_cast<unsigned char>(name[i])) != 0;
  };
  for (size_t i = 0; i < name.size(); ++i) {
    const bool begins = isUpper(i) && i > 0 && name[i - 1] != '_' &&
                        (!isUpper(i - 1) || (i + 1 < name.size() && !isUpper(i + 1)));
    if (begins) result += '_';
    result += static_cast<char>(std::tolower(static_cast<unsigned char>(name[i])));
  }
  return result;
}

const std::string* Element::attribute(const std::string& wanted) const {
  for (const auto& [key, value] : attributes)
    if (key == wanted) return &value;
  return nullptr;
}

Document::Document(const fs::path& file, const Definitions& given, Files& files, Report& report)
    : report_(report) {
  XmlReader reader(given, files, report);
  scene_ = reader.readScene(file, isLegacy_);
  collect(scene_);
  readAliases();
}

void Document::collect(const Element& element) {
  for (const Element& child : element.children) {
    if (!child.id.empty() && child.tag != "ref" && child.tag != "alias") {
      const auto [first, isNew] = ids_.emplace(child.id, &child);
      if (!isNew)
        report_.fail(child.place, fmt::format("the id '{}' is already that of {}", child.id,
                                              first->second->place));
    }
    collect(child);
  }
}

void Document::readAliases() {
  for (const Element& child : scene_.children) {
    if (child.tag != "alias") continue;
    const std::string* as = child.attribute("as");
    const auto found = ids_.find(child.id);
    if (as == nullptr || as->empty()) report_.fail(child.place, "<alias> has no 'as'");
    if (found == ids_.end())
      report_.fail(child.place, fmt::format("nothing has the id '{}'", child.id));
    if (!ids_.emplace(*as, found->second).second)
      report_.fail(child.place, fmt::format("the id '{}' is already taken", *as));
  }
}

const Element& Document::resolve(const Element& element) const {
  if (element.tag != "ref") return element;
  const auto found = ids_.find(element.id);
  if (found != ids_.end()) return *found->second;
  std::vector<std::string> names;
  for (const auto& [id, unused] : ids_) names.push_back(id);
  report_.fail(element.place,
               fmt::format("nothing has the id '{}'{}", element.id, didYouMean(element.id, names)));
}

}  // namespace restlab::mitsuba
