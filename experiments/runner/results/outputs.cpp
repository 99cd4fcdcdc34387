#include "experiments/runner/results/outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/control_characters.h"
#include "core/image/io/atomic_file.h"
#include "experiments/report/report_html.h"
#include "experiments/report/text.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/tables/disturbed.h"
#include "experiments/runner/tables/parameter_sweep.h"
#include "experiments/runner/tables/preview.h"
#include "experiments/runner/tables/report.h"
#include "experiments/runner/tables/report_document.h"

namespace restlab {

namespace {

double meanOf(const Image& image) {
  glm::dvec3 sum(0.0);
  for (const glm::vec3& pixel : image.pixels) sum += glm::dvec3(pixel);
  return (sum.x + sum.y + sum.z) / (3.0 * double(image.pixels.size()));
}

}  // namespace

std::string Outputs::add(const Suite& suite, BlockResult result) {
  const float exposure = previewExposure(result.reference.mean);
  writeBlockImages(out_ / "images", suite, result, exposure);
  Block& block = blocks_.emplace_back(Block{&suite, std::move(result), {}, 0.0});
  block.referenceMean = meanOf(block.result.reference.mean);
  block.rows = summarise(suite, block.result);
  for (MethodResult& method : block.result.methods) {
    // Free the images: only the numbers are needed from here on.
    method.measured = BiasRuns();
    method.shown = Image();
  }
  Reference& reference = block.result.reference;
  reference.mean = Image();
  reference.variance.reset();
  if (reference.half0) reference.half0 = reference.half1 = Image();
  block.result.withoutLights.clear();
  documents_.push_back(blockDocument(suite, block.rows, exposure));
  return blockTable(suite, block.rows);
}

std::vector<SweptBlock> Outputs::sweptBlocks() const {
  std::vector<SweptBlock> blocks;
  for (const Block& block : blocks_)
    blocks.push_back({block.suite, &block.rows, block.referenceMean});
  return blocks;
}

std::vector<SceneSweep> Outputs::sweeps() const { return sceneSweeps(sweptBlocks()); }

std::string Outputs::sweepTables() const { return restlab::sweepTables(sweeps()); }

std::string Outputs::nonfinite() const {
  uint64_t values = 0;
  size_t rows = 0;
  std::string first;
  for (const Block& block : blocks_) {
    for (const MethodSummary& row : block.rows) {
      if (row.nonfinite == 0) continue;
      if (rows++ == 0) first = fmt::format("{} in {}", row.method->name, block.result.scene);
      values += row.nonfinite;
    }
  }
  if (rows == 0) return "";
  return fmt::format("{} are not finite, in {}, the first of which is {}", counted(values, "value"),
                     counted(rows, "row"), first);
}

std::string Outputs::wrongEnergies() const {
  size_t rows = 0;
  std::string first;
  for (const Block& block : blocks_) {
    for (const MethodSummary& row : block.rows) {
      if (!isFarOff(row.energyRatio, row.suite->holdsWithin)) continue;
      if (rows++ > 0) continue;
      first = fmt::format("{} in {}, with {}{}", row.method->name, block.result.scene,
                          shortNumber(row.energyRatio.value, kEnergyDigits),
                          intervalText(row.energyRatio.lo, row.energyRatio.hi, kEnergyDigits));
    }
  }
  if (rows == 0) return "";
  return fmt::format("the energy of {} is not that of the reference; the first is {}",
                     counted(rows, "row"), first);
}

std::vector<nlohmann::ordered_json> Outputs::documents() const {
  std::vector<nlohmann::ordered_json> documents, blocks = documents_;
  for (const SceneSweep& sweep : sweeps()) {
    documents.push_back(sweepDocument(sweep));
    for (const std::optional<size_t>& block : sweep.blocks)
      if (block) blocks[*block]["part_of"] = sweep.id;
  }
  for (SettingSweep& sweep : settingSweeps(sweptBlocks())) {
    for (const size_t block : sweep.blocks)
      if (!blocks[block].contains("part_of")) blocks[block]["part_of"] = sweep.document["id"];
    documents.push_back(std::move(sweep.document));
  }
  documents.insert(documents.end(), blocks.begin(), blocks.end());
  return documents;
}

void Outputs::writePages(const Suite& suite, const nlohmann::ordered_json& record) const {
  if (documents_.empty()) return;
  const nlohmann::ordered_json document = reportDocument(suite, record, documents(), notes_);
  writePlots(out_, document);
  writeReport(out_, document);
}

namespace {

// Returns "Made on 2026-11-27 by restlab 0.2.0 (b07e551): `restlab run ...`", the program by its
// name alone.
std::string madeBy(const nlohmann::ordered_json& record) {
  if (!record.contains("argv") || record["argv"].empty()) return "";
  auto words = record["argv"].get<std::vector<std::string>>();
  words[0] = "restlab";
  const nlohmann::ordered_json& build = record.at("build");
  return fmt::format("Made on {} by restlab {} ({}{}): `{}`\n\n",
                     record.at("started").get<std::string>().substr(0, 10),
                     build.at("version").get<std::string>(),
                     build.at("git_commit").get<std::string>(),
                     build.at("git_dirty").get<bool>() ? ", modified" : "", shellCommand(words));
}

}  // namespace

void Outputs::write(const Suite& suite, const nlohmann::ordered_json& record, bool finished) const {
  std::string csv;
  for (const Block& block : blocks_) {
    const std::string part = summaryCsv(block.rows);
    // All blocks have the same columns: one heading is enough.
    csv += csv.empty() ? part : part.substr(std::min(part.size(), part.find('\n') + 1));
  }
  if (!csv.empty()) writeTextFile(out_ / "summary.csv", csv);
  std::string tex;
  for (const Block& block : blocks_) tex += blockTex(*block.suite, block.rows);
  if (!tex.empty()) writeTextFile(out_ / "table.tex", tex);
  std::string text = fmt::format("# {}\n\n", suite.name);
  if (!suite.question.empty()) text += suite.question + "\n\n";
  text += madeBy(record);
  if (!finished) text += "Not finished: the rows below are of what was.\n\n";
  for (const std::string& line : notes_) text += line + "\n\n";
  const bool hasRatios = std::any_of(blocks_.begin(), blocks_.end(), [](const Block& block) {
    return std::any_of(block.rows.begin(), block.rows.end(), [](const MethodSummary& row) {
      return !row.isBaseline && !std::isnan(row.timeRatio.value);
    });
  });
  if (hasRatios) text += timesExplained() + "\n\n";
  text += sweepTables();
  for (const Block& block : blocks_) text += blockTable(*block.suite, block.rows);
  const bool usesVulkan = std::any_of(devices_.begin(), devices_.end(),
                                      [](const DeviceUse& use) { return use.backend == "vulkan"; });
  // The machine of the jobs: a folder may have been collected elsewhere.
  const bool isKnown = record.is_object() && record.contains("machine");
  const nlohmann::ordered_json machine = isKnown ? record.at("machine") : machineJson();
  text += fmt::format(
      "{}, {} cores, {}, {} {}; times are of the passes of a frame by the "
      "steady clock{}, without metrics and files.\n",
      machine.value("cpu", cpuModel()), machine.at("cores").dump(), librariesText(),
      buildInfo().compiler, buildInfo().buildType,
      usesVulkan ? " (vulkan: by the device's timestamps)" : "");
  for (const DeviceUse& use : devices_)
    text += fmt::format("\n{}: {}; rays by {}.\n", use.backend, use.device, use.rayTracing);
  writeTextFile(out_ / "table.md", withoutControls(text, true));
}

}  // namespace restlab
