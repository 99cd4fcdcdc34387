// docs/gltf.md must list, file by file, the errors of the glTF validator that the import accepts;
// the corpus has the validator's report of each file.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "core/base/error.h"
#include "core/scene/scene.h"
#include "tests/scene/corpus.h"

namespace restlab {
namespace {

namespace fs = std::filesystem;

struct Count {
  size_t accepted = 0, files = 0;
  bool operator==(const Count&) const = default;
};
using Counts = std::map<std::string, Count>;

void PrintTo(const Count& count, std::ostream* out) {
  *out << count.accepted << '/' << count.files;
}

std::string textOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::set<std::string> errorCodes(const fs::path& report) {
  std::set<std::string> codes;
  const nlohmann::json document = nlohmann::json::parse(textOf(report));
  for (const nlohmann::json& message : document.at("issues").at("messages")) {
    if (message.at("severity") == 0) codes.insert(message.at("code").get<std::string>());
  }
  return codes;
}

bool isAccepted(const fs::path& file) {
  try {
    loadGltf(file);
    return true;
  } catch (const Error&) {
    return false;
  }
}

// Entry of a table row: "`CODE` 2/3" means accepted in 2 of the 3 files that have the error.
Counts listed() {
  const std::string text = textOf(fs::path(RESTLAB_SOURCE_DIR) / "docs/gltf.md");
  static const std::regex entry("`([A-Z_]+)` (\\d+)/(\\d+)");
  Counts counts;
  for (std::sregex_iterator it(text.begin(), text.end(), entry), end; it != end; ++it) {
    const auto number = [&](size_t group) { return std::stoul((*it)[group].str()); };
    EXPECT_TRUE(counts.emplace((*it)[1].str(), Count{number(2), number(3)}).second)
        << (*it)[1] << " is listed twice";
  }
  return counts;
}

TEST(GltfValidator, AcceptedErrorsAreListedWithTheirReason) {
  const fs::path folder = test::sceneFolder() / "bad-gltf/validator";
  SKIP_WITHOUT(folder);
  Counts found;
  for (const fs::path& file : test::gltfsBelow(folder)) {
    const bool accepted = isAccepted(file);
    for (const std::string& code : errorCodes(file.string() + ".report.json")) {
      ++found[code].files;
      found[code].accepted += accepted ? 1 : 0;
    }
  }
  ASSERT_FALSE(found.empty());
  std::erase_if(found, [](const auto& entry) { return entry.second.accepted == 0; });
  const Counts expected = listed();
  for (const auto& [code, count] : found) {
    const auto it = expected.find(code);
    if (it == expected.end()) {
      ADD_FAILURE() << code << " is accepted, but not in docs/gltf.md";
    } else {
      EXPECT_EQ(count, it->second) << code;
    }
  }
  for (const auto& [code, count] : expected) {
    EXPECT_EQ(found.count(code), 1u) << code << " is in docs/gltf.md, but never accepted";
  }
}

}  // namespace
}  // namespace restlab
