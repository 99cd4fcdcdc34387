// Strict parser for the XML of plots: elements, attributes, text, the five entities.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace restlab::report_test {

struct XmlElement {
  std::string name, text;  // text: without the text of children
  std::map<std::string, std::string> attributes;
  std::vector<XmlElement> children;

  double number(const std::string& attribute) const;
  bool hasClass(const std::string& word) const;
};

// Throws std::runtime_error if `text` is not well-formed.
XmlElement parseXml(std::string_view text);

// Returns all elements of this name below `root`, in document order.
std::vector<const XmlElement*> findAll(const XmlElement& root, const std::string& name,
                                       const std::string& cssClass = "");

// Parses "x,y x,y ..." into pairs.
std::vector<std::pair<double, double>> pointList(const std::string& text);

}  // namespace restlab::report_test
