// restlab bsdf: checks how a material scatters light against the laws of a BSDF.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "core/image/image.h"
#include "core/image/io/atomic_file.h"
#include "core/scene/material_notes.h"
#include "experiments/bsdf/laws.h"
#include "experiments/bsdf/polar.h"
#include "experiments/bsdf/tested_material.h"
#include "experiments/cli/bsdf_tables.h"
#include "experiments/cli/verbs.h"
#include "experiments/runner/base/print.h"

namespace restlab {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr uint32_t kBallSpp = 256;

// The verdict in words. A law that is declared broken may hold for some settings.
std::string wordOf(const LawVerdict& verdict, bool isDeclared) {
  if (verdict.holds) return "holds";
  return isDeclared ? "broken, as declared" : "BROKEN";
}

Json lawsJson(const Scattering& scattering, const BsdfLaws& laws,
              const std::vector<std::string>& declared) {
  Json verdicts = Json::array();
  for (const LawVerdict& v : laws.verdicts) {
    const bool isDeclared = std::find(declared.begin(), declared.end(), v.law) != declared.end();
    verdicts.push_back({{"law", v.law},
                        {"verdict", wordOf(v, isDeclared)},
                        {"holds", v.holds},
                        {"declared_broken", isDeclared},
                        {"value", v.value},
                        {"meaning", v.meaning}});
  }
  Json albedo = Json::array();
  for (const AlbedoRow& row : laws.albedo) {
    albedo.push_back({{"degrees", row.degrees},
                      {"albedo", {row.albedo.x, row.albedo.y, row.albedo.z}},
                      {"standard_error", {row.error.x, row.error.y, row.error.z}}});
  }
  return {{"kind", scattering.kind->name},
          {"summary", scattering.kind->summary},
          {"source", scattering.kind->source},
          {"alpha", laws.alpha},
          {"power", laws.power},
          {"samples", laws.samples},
          {"laws", verdicts},
          {"albedo", albedo}};
}

std::string textOf(const Json& json) {
  std::string text =
      fmt::format("{}: {}\n", json["kind"].get<std::string>(), json["summary"].get<std::string>());
  const double alpha = json["alpha"];
  if (alpha > 0.0 && alpha < 1.0)
    text +=
        fmt::format("  alpha {:.4g} of its narrowest lobe, a power of {:.4g} of the half vector\n",
                    alpha, json["power"].get<double>());
  for (const Json& v : json["laws"]) {
    text += fmt::format("  {:<13} {:<20} {:.4g}: {}\n", v["law"].get<std::string>(),
                        v["verdict"].get<std::string>(), v["value"].get<double>(),
                        v["meaning"].get<std::string>());
  }
  text += "  angle   albedo: red, green, blue (standard error)\n";
  for (const Json& row : json["albedo"]) {
    const Json &a = row["albedo"], &e = row["standard_error"];
    text +=
        fmt::format("  {:>5.0f}   {:.4f} {:.4f} {:.4f} ({:.1g})\n", row["degrees"].get<double>(),
                    a[0].get<double>(), a[1].get<double>(), a[2].get<double>(),
                    std::max({e[0].get<double>(), e[1].get<double>(), e[2].get<double>()}));
  }
  return text;
}

// Checks one kind, writes its files, and returns the figures.
Json checked(const BsdfOptions& options, const std::string& fileName) {
  const TestedMaterial tested = testedMaterial(options.kind, options.settings);
  const Scattering& scattering = tested.scattering;
  const BsdfProbe probe(tested.material, tested.inputs);
  const BsdfLaws laws = checkLaws(probe, options.samples);
  std::vector<std::string> declared;
  if (scattering.kind->closure != nullptr)
    declared = brokenLaws(*scattering.kind->closure, scattering.closure);
  Json json = lawsJson(scattering, laws, declared);
  if (options.output.empty()) return json;
  const fs::path folder = options.output;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) failInput(fmt::format("{}: {}", folder.string(), error.message()));
  writeTextFile(folder / (fileName + ".json"), json.dump(2) + "\n");
  writeTextFile(folder / (fileName + ".svg"), polarSvg(probe, fileName));
  writePng(folder / (fileName + ".png"),
           renderBall(tested.material, tested.inputs, options.ballSize, kBallSpp), 1.0f);
  return json;
}

// Every kind with its defaults, and those whose file declares a broken law with their other choices
// as well: the settings of each.
std::vector<std::pair<std::string, std::vector<std::string>>> allKinds() {
  std::vector<std::pair<std::string, std::vector<std::string>>> all;
  for (const MaterialKind& kind : materialKinds()) {
    all.emplace_back(kind.name, std::vector<std::string>{});
    if (kind.closure == nullptr || kind.closure->brokenLaws.empty()) continue;
    for (const ClosureParameter& p : kind.parameters) {
      if (p.name != kind.closure->brokenWhere) continue;
      for (size_t i = 1; i < p.choices.size(); ++i)
        all.push_back({kind.name, {p.name + "=" + p.choices[i]}});
    }
  }
  return all;
}

const Json& lawOf(const Json& json, const std::string& law) {
  return *std::find_if(json["laws"].begin(), json["laws"].end(),
                       [&](const Json& v) { return v["law"] == law; });
}

std::string figureOf(const Json& json, const std::string& law, const char* format) {
  const Json& v = lawOf(json, law);
  const std::string figure = fmt::format(fmt::runtime(format), v["value"].get<double>());
  return v["holds"].get<bool>() ? figure : figure + ", " + v["verdict"].get<std::string>();
}

// A row of a Markdown table.
std::string rowOf(const std::string& name, const Json& json) {
  return fmt::format("| {} | {} | {} | {} | {} |\n", name, figureOf(json, "non-negative", "{:.3g}"),
                     figureOf(json, "energy", "{:.3f}"), figureOf(json, "reciprocity", "{:.1e}"),
                     figureOf(json, "sampling", "{:.2g}"));
}

Json checkAll(const BsdfOptions& options) {
  if (!options.settings.empty()) failUsage("bsdf all: --set goes with one kind");
  Json all = Json::array();
  std::string table =
      "| kind | least f | largest albedo | f(wi, wo) against f(wo, wi) | p of its draws |\n"
      "|---|---|---|---|---|\n";
  for (const auto& [kind, settings] : allKinds()) {
    BsdfOptions one = options;
    one.kind = kind;
    one.settings = settings;
    const std::string choice =
        settings.empty() ? "" : settings.front().substr(settings.front().find('=') + 1);
    all.push_back(checked(one, choice.empty() ? kind : kind + "-" + choice));
    table += rowOf("`" + kind + "`" + (choice.empty() ? "" : ", " + choice), all.back());
  }
  if (!options.json) printText(table);
  return all;
}

void bsdf(const BsdfOptions& options, Outcome& outcome) {
  if (!options.simulate.empty()) {
    simulateTable(options);
    return;
  }
  if (options.kind.empty())
    failUsage("bsdf: a kind of material expected (restlab list closures), all, or --simulate FILE");
  if (!options.tabulate.empty()) {
    writeTable(options);
    return;
  }
  const bool isAll = options.kind == "all";
  const Json json = isAll ? checkAll(options) : checked(options, options.kind);
  if (options.json) {
    printJsonText(json.dump(2));
  } else if (!isAll) {
    printText(textOf(json));
  }
  for (const Json& one : isAll ? json : Json::array({json})) {
    for (const Json& v : one["laws"]) {
      if (!v["holds"].get<bool>() && !v["declared_broken"].get<bool>())
        outcome.code = ExitCode::comparisonFailed;
    }
  }
}

}  // namespace

Action addBsdfVerb(CLI::App& app) {
  auto options = std::make_shared<BsdfOptions>();
  CLI::App* verb = app.add_subcommand("bsdf", "a material against the laws of a BSDF");
  verb->add_option("kind", options->kind, "restlab list closures; all: a table of all");
  verb->add_option("--set", options->settings, "KEY=VALUE: a parameter of the kind");
  verb->add_option("-o,--output", options->output,
                   "folder for KIND.json, KIND.svg (lobes) and KIND.png (a ball)");
  verb->add_option("--size", options->ballSize, "of KIND.png, pixels a side")
      ->check(CLI::Range(16u, 4096u))
      ->capture_default_str();
  addTableOptions(*verb, *options);
  verb->add_option("--samples", options->samples, "draws for each angle of the chi-squared test")
      ->check(CLI::Range(uint64_t(1000), uint64_t(1'000'000'000)))
      ->capture_default_str();
  verb->add_flag("--json", options->json, "JSON on stdout");
  return [options](Outcome& outcome) { bsdf(*options, outcome); };
}

}  // namespace restlab
