#include "experiments/cli/reference_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/frame/denoiser.h"
#include "experiments/cli/option_text.h"
#include "experiments/runner/registries/registries.h"
#include "experiments/runner/tables/column_groups.h"

namespace restlab {

namespace {

using Json = nlohmann::ordered_json;

// Escapes what Markdown would read as markup inside of a table.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|' || c == '*' || c == '<') escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string code(const std::string& text) { return "`" + text + "`"; }

// Number as a person writes it: 20, 0.1, 1e+06.
std::string valueOf(const Json& value) {
  if (value.is_number_float()) return fmt::format("{:.9g}", value.get<double>());
  return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string valuesOf(const Json& parameter) {
  if (parameter.contains("range")) {
    return fmt::format("{:.9g} to {:.9g}", parameter["range"][0].get<double>(),
                       parameter["range"][1].get<double>());
  }
  std::string all;
  for (const Json& choice : parameter.value("choices", Json::array()))
    all += (all.empty() ? "" : ", ") + choice.get<std::string>();
  if (all.empty() && parameter.contains("type")) return parameter["type"].get<std::string>();
  return all.empty() ? "true, false" : all;
}

std::string parameterTable(const Json& parameters) {
  if (parameters.empty()) return "";
  std::string text =
      "\n| parameter | default | values | meaning | source |\n|---|---|---|---|---|\n";
  for (const Json& parameter : parameters) {
    text += fmt::format("| {} | {} | {} | {} | {} |\n", code(parameter["name"].get<std::string>()),
                        cell(valueOf(parameter["default"])), cell(valuesOf(parameter)),
                        cell(parameter["help"].get<std::string>()),
                        cell(parameter.value("source", "")));
  }
  return text;
}

std::string layerTable(const Json& layers) {
  if (layers.empty()) return "";
  std::string text = "\n| layer | unit | meaning |\n|---|---|---|\n";
  for (const Json& layer : layers) {
    const std::string with = layer.value("only_with", "");
    text +=
        fmt::format("| {} | {} | {}{} |\n", code(layer["name"].get<std::string>()),
                    cell(layer["unit"].get<std::string>()), cell(layer["help"].get<std::string>()),
                    with.empty() ? "" : "; with the parameter " + code(with));
  }
  return text;
}

std::string partText(const Json& part) {
  std::string text = fmt::format("\n### {}\n\n{}.\n", part["name"].get<std::string>(),
                                 cell(part["summary"].get<std::string>()));
  if (part.contains("why")) {
    text += fmt::format(
        "\nIn a still view {}, in a moving one {}: {}.\n", part["bias_still"].get<std::string>(),
        part["bias_moving"].get<std::string>(), cell(part["why"].get<std::string>()));
  }
  const Json modes = part.value("modes", Json::array());
  if (!modes.empty()) text += "\n| mode | bias | why |\n|---|---|---|\n";
  for (const Json& mode : modes) {
    text += fmt::format("| {} | {} | {} |\n", code(mode["name"].get<std::string>()),
                        mode["bias"].get<std::string>(), cell(mode["why"].get<std::string>()));
  }
  return text + parameterTable(part["parameters"]) +
         layerTable(part.value("layers", Json::array()));
}

std::string partsText(const std::string& title, const Json& parts) {
  std::string text = "\n## " + title + "\n";
  for (const Json& part : parts) text += partText(part);
  return text;
}

std::string closureText(const Json& closure) {
  const std::string source = closure["source"], where = closure.value("breaks_where", "");
  std::string text = fmt::format("\n### {}\n\n{}{}.\n", closure["name"].get<std::string>(),
                                 cell(closure["summary"].get<std::string>()),
                                 source.empty() ? "" : " (" + cell(source) + ")");
  if (!closure["breaks"].empty())
    text += fmt::format("\nBreaks {} {}.\n",
                        fmt::join(closure["breaks"].get<std::vector<std::string>>(), " and "),
                        where.empty() ? "for some parameters" : "where " + code(where));
  if (closure["parameters"].empty()) return text;
  text += "\n| parameter | default | values | meaning |\n|---|---|---|---|\n";
  for (const Json& parameter : closure["parameters"]) {
    const std::string type = parameter["type"] == "colour" ? "colour, " : "";
    text += fmt::format("| {} | {} | {}{} | {} |\n", code(parameter["name"].get<std::string>()),
                        cell(valueOf(parameter["default"])), type, cell(valuesOf(parameter)),
                        cell(parameter["help"].get<std::string>()));
  }
  return text;
}

// Denoisers that every build has: those on the host are of libraries that may be missing.
Json denoisersOfEveryBuild() {
  Json all = Json::array();
  for (const Json& denoiser : denoisersJson()) {
    if (denoiser["available"].get<bool>() &&
        !findDenoiser(denoiser["name"].get<std::string>()).onHost)
      all.push_back(denoiser);
  }
  return all;
}

// Names of an option, and its row of a table.
struct OptionRow {
  std::string names, row;
};

OptionRow rowOf(const CLI::Option& option) {
  const std::string names = namesOf(option);
  return {code(names), fmt::format("| {} | {} | {} |\n", code(names), cell(kindOf(option)),
                                   cell(option.get_description()))};
}

constexpr const char* kOptionHeading = "\n| option | value | meaning |\n|---|---|---|\n";
constexpr size_t kFewVerbs = 3;  // options of so many are listed once

// Rows of options that several verbs have, with the number of these verbs.
std::map<std::string, size_t> sharedRows(const std::vector<const CLI::App*>& verbs) {
  std::map<std::string, size_t> rows;
  for (const CLI::App* verb : verbs)
    for (const CLI::Option* option : verb->get_options())
      if (!isCommon(*option)) ++rows[rowOf(*option).row];
  std::erase_if(rows, [](const auto& row) { return row.second < kFewVerbs; });
  return rows;
}

std::string verbsText(const std::vector<const CLI::App*>& verbs) {
  const std::map<std::string, size_t> shared = sharedRows(verbs);
  std::string text;
  std::vector<std::string> listed;
  for (const CLI::App* verb : verbs) {
    std::string rows, names;
    for (const CLI::Option* option : verb->get_options()) {
      if (isCommon(*option)) continue;
      const OptionRow own = rowOf(*option);
      if (!shared.contains(own.row)) {
        rows += own.row;
        continue;
      }
      names += (names.empty() ? "" : ", ") + own.names;
      if (std::find(listed.begin(), listed.end(), own.row) == listed.end())
        listed.push_back(own.row);
    }
    text += fmt::format("\n### {}\n\n{}.\n", verb->get_name(), cell(verb->get_description()));
    if (!rows.empty()) text += kOptionHeading + rows;
    if (!names.empty()) text += "\nAlso [common ones](#common-options): " + names + ".\n";
  }
  text += std::string("\n### Common options\n") + kOptionHeading;
  for (const std::string& row : listed) text += row;
  return text;
}

// Names the baseline, the average and the first backend in a column's help.
std::string named(std::string text) {
  const std::pair<const char*, const char*> names[] = {
      {"{0}", "the baseline"}, {"{1}", "the average"}, {"{2}", "the first backend"}};
  for (const auto& [mark, name] : names) {
    for (size_t at = text.find(mark); at != std::string::npos; at = text.find(mark))
      text.replace(at, 3, name);
  }
  return text;
}

std::string columnsText(const std::string& title, const Columns& columns) {
  std::string text = fmt::format("\n### {}\n\n| column | unit | meaning |\n|---|---|---|\n", title);
  for (const Column& column : columns) {
    if (!column.inCsv) continue;
    const std::string name = code(column.key) + (column.ends == Ends::all ? " and its ends" : "");
    text += fmt::format("| {} | {} | {} |\n", name, cell(column.unit), cell(named(column.help)));
  }
  return text;
}

}  // namespace

std::string referencePage(const CLI::App& app) {
  std::string text =
      "# Reference\n\n`restlab list all` writes this page; a test compares them. "
      "[manual.md](manual.md) "
      "says how things work together.\n\n"
      "- [Verbs](#verbs), [settings of light transport](#settings-of-light-transport)\n"
      "- [Integrators](#integrators), [caches](#caches), [denoisers](#denoisers), "
      "[closures](#closures), [shapes](#shapes)\n"
      "- [Columns of summary.csv](#columns-of-summarycsv), [metrics](#metrics)\n\n"
      "## Verbs\n\nEvery verb has `--help`, `-q` (errors and warnings only) and `-v` (details).\n";
  text += verbsText(app.get_subcommands({}));
  text +=
      "\n## Settings of light transport\n\nKeys of `[settings]` and `[[scene]]`, controls of the "
      "viewer, and options of the verbs that list them.\n" +
      parameterTable(transportSettingsJson());
  text += partsText("Integrators", integratorsJson());
  text += partsText("Caches", cachesJson());
  text += partsText("Denoisers", denoisersOfEveryBuild());
  text += "\nWhere its library is installed, `restlab list denoisers` has `oidn` as well.\n";
  text += "\n## Closures\n\nKinds of materials, for `kind` in a [scene file](scenes.md).\n";
  for (const Json& closure : closuresJson()) text += closureText(closure);
  text +=
      "\n## Shapes\n\nBeside triangles, for `kind` of a `[[shape]]` in a [scene "
      "file](scenes.md).\n";
  for (const Json& shape : shapesJson()) text += closureText(shape);
  text +=
      "\n## Columns of summary.csv\n\n`KEY and its ends`: also `KEY_ci_lo` and `KEY_ci_hi`, the "
      "95 % interval.\n";
  text += columnsText("The row", identityColumns());
  text += columnsText("Frames", frameColumns());
  text += columnsText("Conditions", conditionColumns());
  text += columnsText("Accumulated frames", accumulatedColumns());
  text += columnsText("Change over time", temporalColumns());
  text += columnsText("Numerical health", healthColumns());
  text += "\n## Metrics\n\n";
  for (const Json& metric : metricsJson()) {
    text += fmt::format("- {}: {}\n", code(metric["name"].get<std::string>()),
                        metric["summary"].get<std::string>());
  }
  return text;
}

}  // namespace restlab
