#include "experiments/view/view_session_file.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/image/atomic_file.h"

namespace restlab {

std::string writeSession(const std::filesystem::path& folder, const std::string& toml,
                         const std::string& stem) {
  constexpr int kMostSessions = 1000;
  std::string name = stem + ".toml";
  std::error_code status;
  for (int i = 2; std::filesystem::exists(folder / name, status); ++i) {
    if (i > kMostSessions)
      failInput(fmt::format("{}: holds {} sessions", folder.string(), kMostSessions));
    name = fmt::format("{}-{}.toml", stem, i);
  }
  writeTextFile(folder / name, toml);
  return name;
}

}  // namespace restlab
