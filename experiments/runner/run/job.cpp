#include "experiments/runner/run/job.h"

#include <fmt/format.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <fstream>

#include "core/base/error.h"
#include "core/image/io/atomic_file.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/run/figures.h"
#include "experiments/runner/run/run_record.h"
#include "experiments/runner/suite/picture.h"

namespace restlab {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

constexpr int kJobSchema = 1;
// Prefix of folders being written, which remain if their writer is killed.
constexpr const char* kUnfinished = ".unfinished-";

std::string hexOf(XXH128_hash_t hash) { return hexHash(hash.high64) + hexHash(hash.low64); }

std::string hashOfText(const std::string& text) {
  return hexOf(XXH3_128bits(text.data(), text.size()));
}

std::string hashOfFile(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  return hashOfText(bytes);
}

std::string imageName(size_t method) { return fmt::format("method{}.exr", method); }

Json readRecord(const fs::path& folder, const std::string& key) {
  std::ifstream in(folder / "job.json", std::ios::binary);
  if (!in) failInput("has no job.json");
  Json document = Json::parse(in);
  const std::string sum = document.at("checksum").get<std::string>();
  document.erase("checksum");
  if (hashOfText(document.dump()) != sum) failInput("job.json is damaged");
  if (document.at("schema").get<int>() != kJobSchema ||
      document.at("key").get<std::string>() != key)
    failInput("job.json is of another job");
  return document;
}

JobData read(const fs::path& folder, const std::string& key) {
  const Json document = readRecord(folder, key);
  JobData job;
  for (const Json& method : document.at("methods")) {
    const fs::path file = folder / method.at("image").get<std::string>();
    if (hashOfFile(file) != method.at("image_hash").get<std::string>())
      failInput(fmt::format("{} is damaged", file.filename().string()));
    LayeredImage image = readExr(file, {ExrLayers::colours, {""}});
    JobMethod& read = job.methods.emplace_back();
    for (const Json& line : method.at("lines")) read.lines.push_back(line);
    read.measured = std::move(image.layers.at(""));
    read.metadata = std::move(image.metadata);
  }
  return job;
}

}  // namespace

std::string JobIdentity::key() const { return hashOfText(words.dump()); }

std::string imageHash(const Image& image) {
  return hexOf(XXH3_128bits(image.pixels.data(), image.pixels.size() * sizeof(glm::vec3)));
}

std::string referenceHash(const Reference& reference) {
  XXH3_state_t* state = XXH3_createState();
  XXH3_128bits_reset(state);
  const auto add = [&](const Image& image) {
    XXH3_128bits_update(state, image.pixels.data(), image.pixels.size() * sizeof(glm::vec3));
  };
  add(reference.mean);
  if (reference.half0) add(*reference.half0);
  if (reference.half1) add(*reference.half1);
  const XXH128_hash_t hash = XXH3_128bits_digest(state);
  XXH3_freeState(state);
  return hexOf(hash);
}

JobIdentity jobIdentity(const Suite& suite, const PreparedScene& prepared, const BlockResult& block,
                        uint32_t run, const BuildInfo& build, const std::string& referenceHash,
                        const std::vector<DeviceUse>& devices) {
  const SessionConfig picture = pictureOf(suite, block.width, block.height, block.component);
  Json methods = Json::array();
  for (const SuiteMethod& method : suite.rendered()) {
    const SessionConfig config = methodConfig(suite, method, prepared, picture);
    Json words = describe(prepared, config);
    words["name"] = method.name;
    words["source_hash"] = build.sourceHash;
    words["device"] = config.device;
    words["ray_tracing"] = config.rayTracing;
    words["validate"] = config.validate;
    methods.push_back(std::move(words));
  }
  Json uses = Json::array();
  for (const DeviceUse& use : devices) uses.push_back({use.backend, use.device, use.rayTracing});
  // Identify the path by its cameras, not by its name.
  Json cameras = Json::array();
  for (uint32_t frame = 0; block.motion && frame < suite.warmupFrames + suite.timedFrames; ++frame)
    cameras.push_back(cameraWords(cameraAt(*block.motion, frame)));
  Json events = Json::array();
  for (const LightEvent& event : suite.events)
    events.push_back({event.frame, event.light, event.factor});
  JobIdentity identity;
  identity.words = {
      {"schema", kJobSchema},
      {"results_schema", kResultsSchema},
      {"point", suite.point},
      {"seed", suite.seed + run},
      {"run", run},
      {"warmup_frames", suite.warmupFrames},
      {"timed_frames", suite.timedFrames},
      {"ages", suite.ages},
      {"accumulate", suite.accumulate ? Json("after the averages of methods") : Json(false)},
      {"temporal", suite.temporal ? Json("with squares") : Json(false)},
      {"timing", suite.timing},
      {"figures", figuresWords(suite)},
      {"threads", suite.threads},
      {"camera_path", suite.cameraPathName},
      {"cameras", hashOfText(cameras.dump())},
      {"events", std::move(events)},
      {"reference", referenceHash},
      {"measuring", build.measuringHash},
      {"compiler", build.compiler},
      {"flags", build.compilerFlags},
      {"build_type", build.buildType},
      {"cpu", cpuModel()},
      {"devices", std::move(uses)},
      {"methods", std::move(methods)}};
  return identity;
}

std::optional<JobData> JobStore::load(const std::string& key) const {
  const fs::path folder = folderOf(key);
  std::error_code status;
  if (!fs::is_directory(folder, status)) return std::nullopt;
  try {
    return read(folder, key);
  } catch (const std::exception& error) {
    logInfo(fmt::format("{}: {}; the run is made anew", folder.string(), error.what()));
    return std::nullopt;
  }
}

std::optional<Json> JobStore::record(const std::string& key) const {
  try {
    return readRecord(folderOf(key), key);
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

void JobStore::save(const JobIdentity& identity, const JobData& job) const {
  const std::string key = identity.key();
  makeWritableDirectory(folder_);
  const fs::path unfinished = folder_ / fmt::format("{}{}-{}", kUnfinished, key, getpid());
  std::error_code status;
  fs::remove_all(unfinished, status);
  try {
    makeWritableDirectory(unfinished);
    Json document = {{"schema", kJobSchema},
                     {"key", key},
                     {"identity", identity.words},
                     {"methods", Json::array()}};
    for (size_t m = 0; m < job.methods.size(); ++m) {
      LayeredImage image;
      image.layers[""] = job.methods[m].measured;
      image.metadata = job.methods[m].metadata;
      const fs::path file = unfinished / imageName(m);
      writeExr(file, image);
      document["methods"].push_back({{"image", imageName(m)},
                                     {"image_hash", hashOfFile(file)},
                                     {"lines", job.methods[m].lines}});
    }
    document["checksum"] = hashOfText(document.dump());
    writeTextFile(unfinished / "job.json", document.dump(1) + "\n");
    fs::remove_all(folderOf(key), status);  // a damaged job
    fs::rename(unfinished, folderOf(key), status);
    if (status) {
      failInput(fmt::format("{}: cannot be renamed: {}", unfinished.string(), status.message()));
    }
  } catch (...) {
    fs::remove_all(unfinished, status);
    throw;
  }
}

std::vector<std::string> JobStore::keys() const {
  std::vector<std::string> found;
  std::error_code status;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, status)) {
    const std::string name = entry.path().filename().string();
    const bool isKey =
        name.size() == 32 && name.find_first_not_of("0123456789abcdef") == std::string::npos;
    if (isKey && entry.is_directory(status)) found.push_back(name);
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace restlab
