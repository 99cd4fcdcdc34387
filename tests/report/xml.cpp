#include "tests/report/xml.h"

#include <cstdint>
#include <sstream>
#include <stdexcept>

namespace restlab::report_test {
namespace {

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  XmlElement document() {
    skipBlanks();
    XmlElement root = element();
    skipBlanks();
    if (at_ != text_.size()) fail("text after the end");
    return root;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error("XML, byte " + std::to_string(at_) + ": " + what);
  }
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  bool take(std::string_view word) {
    if (text_.substr(at_, word.size()) != word) return false;
    at_ += word.size();
    return true;
  }
  void expect(std::string_view word) {
    if (!take(word)) fail("expected " + std::string(word));
  }
  void skipBlanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n')) ++at_;
  }
  std::string name() {
    const size_t begin = at_;
    while (std::isalnum(static_cast<unsigned char>(peek())) || peek() == '-' || peek() == ':')
      ++at_;
    if (at_ == begin) fail("expected a name");
    return std::string(text_.substr(begin, at_ - begin));
  }
  // Reads characters up to `end`, which is not consumed.
  std::string characters(char end) {
    std::string out;
    while (peek() != end) {
      const char c = peek();
      if (at_ == text_.size() || c == '<') fail("'<' or the end inside text");
      if (uint8_t(c) < 0x20 && c != '\n' && c != '\t') fail("a control character");
      if (c != '&') {
        out += c;
        ++at_;
      } else if (take("&amp;")) {
        out += '&';
      } else if (take("&lt;")) {
        out += '<';
      } else if (take("&gt;")) {
        out += '>';
      } else if (take("&quot;")) {
        out += '"';
      } else if (take("&#39;")) {
        out += '\'';
      } else {
        fail("an unknown entity");
      }
    }
    return out;
  }
  XmlElement element() {
    XmlElement out;
    expect("<");
    out.name = name();
    for (;;) {
      skipBlanks();
      if (take("/>")) return out;
      if (take(">")) break;
      const std::string key = name();
      expect("=\"");
      if (!out.attributes.emplace(key, characters('"')).second) fail(key + " is there twice");
      expect("\"");
    }
    while (!take("</")) {
      if (peek() == '<') {
        out.children.push_back(element());
      } else {
        out.text += characters('<');
      }
    }
    expect(out.name);
    expect(">");
    return out;
  }

  std::string_view text_;
  size_t at_ = 0;
};

}  // namespace

double XmlElement::number(const std::string& attribute) const {
  return std::stod(attributes.at(attribute));
}

bool XmlElement::hasClass(const std::string& word) const {
  const auto found = attributes.find("class");
  std::istringstream words(found == attributes.end() ? "" : found->second);
  for (std::string one; words >> one;) {
    if (one == word) return true;
  }
  return false;
}

XmlElement parseXml(std::string_view text) { return Parser(text).document(); }

std::vector<const XmlElement*> findAll(const XmlElement& root, const std::string& name,
                                       const std::string& cssClass) {
  std::vector<const XmlElement*> found;
  for (const XmlElement& child : root.children) {
    if (child.name == name && (cssClass.empty() || child.hasClass(cssClass))) {
      found.push_back(&child);
    }
    for (const XmlElement* inner : findAll(child, name, cssClass)) found.push_back(inner);
  }
  return found;
}

std::vector<std::pair<double, double>> pointList(const std::string& text) {
  std::vector<std::pair<double, double>> points;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const size_t comma = word.find(',');
    points.emplace_back(std::stod(word.substr(0, comma)), std::stod(word.substr(comma + 1)));
  }
  return points;
}

}  // namespace restlab::report_test
