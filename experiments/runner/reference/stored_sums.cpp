#include "experiments/runner/reference/stored_sums.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/base/error.h"

namespace restlab {

namespace fs = std::filesystem;

std::string headText(const nlohmann::ordered_json& head) {
  return head.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

StoredPrefix prefixOf(const StoredKind& kind, const std::string& headText) {
  return {kind.magic, kind.version, uint32_t(headText.size()),
          XXH3_64bits(headText.data(), headText.size())};
}

StoredPrefix readPrefix(const fs::path& file, const StoredKind& kind, std::istream& in) {
  StoredPrefix prefix;
  in.read(reinterpret_cast<char*>(&prefix), sizeof(prefix));
  if (!in || prefix.magic != kind.magic)
    failInput(fmt::format("{}: is no {}", file.string(), kind.name));
  if (prefix.version != kind.version) {
    failInput(
        fmt::format("{}: is of version {}, not {}", file.string(), prefix.version, kind.version));
  }
  if (prefix.headBytes > kind.maxHeadBytes) failDamaged(file, "its header is too long");
  return prefix;
}

nlohmann::json readHead(const fs::path& file, const StoredPrefix& prefix, std::istream& in) {
  std::string text(prefix.headBytes, '\0');
  in.read(text.data(), std::streamsize(text.size()));
  if (!in || XXH3_64bits(text.data(), text.size()) != prefix.headHash)
    failDamaged(file, "its header is not what was written");
  return nlohmann::json::parse(text);
}

void failDamaged(const fs::path& file, const std::string& why) {
  failInput(fmt::format("{}: is damaged: {}", file.string(), why));
}

void SumsHash::add(const ImageSum& sum) {
  XXH3_64bits_update(state_.get(), sum.sums().data(), sum.sums().size() * sizeof(glm::dvec3));
}

void writeSums(std::ostream& out, const ImageSum& sum, SumsHash& hash) {
  out.write(reinterpret_cast<const char*>(sum.sums().data()),
            std::streamsize(sum.sums().size() * sizeof(glm::dvec3)));
  hash.add(sum);
}

ImageSum readSums(std::istream& in, uint32_t width, uint32_t height, uint64_t count,
                  SumsHash& hash) {
  if (count == 0) return {};
  std::vector<glm::dvec3> sums(size_t(width) * height);
  in.read(reinterpret_cast<char*>(sums.data()), std::streamsize(sums.size() * sizeof(glm::dvec3)));
  ImageSum sum(width, height, count, std::move(sums));
  hash.add(sum);
  return sum;
}

nlohmann::ordered_json countersJson(const HealthSum& sum) {
  return {
      {"health", sum.health.counts}, {"rays_path", sum.raysPath}, {"rays_shadow", sum.raysShadow}};
}

HealthSum countersOf(const fs::path& file, const nlohmann::json& head) {
  HealthSum sum;
  const auto health = head.at("health").get<std::vector<uint64_t>>();
  if (health.size() != sum.health.counts.size())
    failDamaged(file, "its counters are not those of this program");
  std::copy(health.begin(), health.end(), sum.health.counts.begin());
  sum.raysPath = head.at("rays_path").get<uint64_t>();
  sum.raysShadow = head.at("rays_shadow").get<uint64_t>();
  return sum;
}

nlohmann::ordered_json checksJson(const RelmseChecks& checks) {
  auto list = nlohmann::ordered_json::array();
  for (const RelmseCheck& check : checks.kept()) {
    list.push_back({{"spp", check.spp}, {"relmse", check.relmse}, {"rays_path", check.raysPath}});
  }
  return list;
}

RelmseChecks checksOf(const nlohmann::json& checks) {
  std::vector<RelmseCheck> kept;
  for (const nlohmann::json& check : checks) {
    const nlohmann::json& relmse = check.at("relmse");  // null: was not finite
    kept.push_back(
        {check.at("spp").get<uint64_t>(),
         relmse.is_null() ? std::numeric_limits<double>::quiet_NaN() : relmse.get<double>(),
         check.at("rays_path").get<uint64_t>()});
  }
  return RelmseChecks(std::move(kept));
}

}  // namespace restlab
