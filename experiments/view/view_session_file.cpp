#include "experiments/view/view_session_file.h"

#include <fmt/format.h>

namespace restlab {

namespace fs = std::filesystem;

std::string freeSessionName(const fs::path& folder, const std::string& stem) {
  std::error_code status;
  const auto isTaken = [&](const std::string& name) {
    return fs::exists(folder / (name + ".toml"), status) ||
           fs::exists(folder / resultsOfSession(name), status);
  };
  std::string name = stem;
  for (int i = 2; isTaken(name); ++i) name = fmt::format("{}-{}", stem, i);
  return name;
}

fs::path resultsOfSession(const std::string& name) { return fs::path("results") / name; }

}  // namespace restlab
