#include "experiments/cli/option_text.h"

#include <fmt/format.h>

namespace restlab {

bool isCommon(const CLI::Option& option) {
  return option.check_lname("help") || option.check_lname("quiet") || option.check_lname("verbose");
}

std::string kindOf(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const size_t colon = type.find(':');
  if (colon != std::string::npos) return type.substr(colon + 1);
  return type == "TEXT" ? "text" : type;
}

std::vector<std::string> dashedNames(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

std::string namesOf(const CLI::Option& option) {
  const std::vector<std::string> names = dashedNames(option);
  return names.empty() ? option.get_name(true) : fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace restlab
