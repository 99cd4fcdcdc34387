#include <fmt/format.h>

#include <map>
#include <regex>
#include <sstream>

#include "tests/lint/rules.h"

namespace restlab::lint {

std::vector<Finding> findDimensionClashes(const std::vector<SourceText>& headers) {
  static const std::regex constant(R"(^const uint (RL_DIM\w+) = (\d+)u;(.*)$)");
  static const std::regex donors(R"(\+ donor index \((\d+) at most\))");
  struct Dimension {
    Finding where;
    std::string name;
    unsigned long first, count;
  };
  std::vector<Dimension> dimensions;
  std::vector<Finding> found;
  unsigned long limit = 0;
  for (const SourceText& header : headers) {
    std::istringstream lines(header.text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
      std::smatch match;
      if (!std::regex_match(line, match, constant)) continue;
      const unsigned long value = std::stoul(match[2]);
      if (match[1] == "RL_DIMENSIONS") {
        limit = value;
        continue;
      }
      const std::string comment = match[3];
      unsigned long count = 1;
      std::smatch range;
      if (std::regex_search(comment, range, donors)) {
        count = std::stoul(range[1]);
      } else if (comment.find("donor index") != std::string::npos) {
        found.push_back(
            {header.path, number, fmt::format("{}: say how many, '(N at most)'", match[1].str())});
      }
      dimensions.push_back({{header.path, number, ""}, match[1], value, count});
    }
  }
  std::map<unsigned long, std::string> owner;
  for (Dimension& d : dimensions) {
    for (unsigned long k = d.first; k < d.first + d.count; ++k) {
      const auto [it, isNew] = owner.emplace(k, d.name);
      if (isNew) continue;
      d.where.message = fmt::format("{} uses dimension {}, which is {}'s", d.name, k, it->second);
      found.push_back(d.where);
      break;
    }
    if (d.first + d.count > limit) {
      d.where.message = fmt::format("{} reaches beyond RL_DIMENSIONS = {}", d.name, limit);
      found.push_back(d.where);
    }
  }
  return found;
}

}  // namespace restlab::lint
