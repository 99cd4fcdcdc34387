#include "tests/lint/std_headers.h"

#include <algorithm>
#include <regex>

namespace restlab::lint {

namespace {

struct StdHeader {
  const char* name;
  std::regex calls;
};

const std::vector<StdHeader>& headers() {
  static const std::vector<StdHeader> all = {
      {"<algorithm>",
       std::regex("std::(ranges::)?(adjacent_find|all_of|any_of|binary_search|clamp|copy|copy_if|"
                  "copy_n|count|count_if|equal|equal_range|fill|fill_n|find|find_if|find_if_not|"
                  "for_each|generate|includes|inplace_merge|is_sorted|lower_bound|make_heap|max|"
                  "max_element|merge|min|min_element|minmax|minmax_element|mismatch|none_of|"
                  "nth_element|partial_sort|partition|partition_point|pop_heap|push_heap|remove|"
                  "remove_if|replace|replace_if|reverse|rotate|set_difference|set_intersection|"
                  "shuffle|sort|stable_partition|stable_sort|transform|unique|upper_bound) *[(<]")},
      {"<numeric>", std::regex("std::(accumulate|gcd|inner_product|iota|lcm|midpoint|partial_sum|"
                               "reduce) *[(<]")}};
  return all;
}

}  // namespace

std::vector<Finding> findMissingStdHeaders(const std::string& path, const std::string& text) {
  std::vector<Finding> found;
  for (const StdHeader& header : headers()) {
    if (text.find("#include " + std::string(header.name)) != std::string::npos) continue;
    std::smatch call;
    if (!std::regex_search(text, call, header.calls)) continue;
    const int line = 1 + int(std::count(text.begin(), text.begin() + call.position(), '\n'));
    found.push_back(
        {path, line,
         call.str().substr(0, call.str().size() - 1) + " needs #include " + header.name});
  }
  return found;
}

}  // namespace restlab::lint
