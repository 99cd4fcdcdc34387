#include "experiments/cli/man_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <string>

#include "core/image/io/atomic_file.h"
#include "experiments/cli/option_text.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/files.h"

namespace restlab {

namespace {

// Escapes what troff would read as a request.
std::string troff(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\\') {
      escaped += "\\e";
    } else if (c == '-') {
      escaped += "\\-";
    } else {
      // A line that begins with '.' or ''' is a request.
      const bool begins = escaped.empty() || escaped.back() == '\n';
      if (begins && (c == '.' || c == '\'')) escaped += "\\&";
      escaped += c;
    }
  }
  return escaped;
}

std::string bold(const std::string& text) { return "\\fB" + troff(text) + "\\fR"; }

// Lines of the footer: exit codes, and where more is written.
std::string footerText(const std::string& footer) {
  std::istringstream lines(footer);
  std::string text;
  for (std::string line; std::getline(lines, line);) text += troff(line) + "\n";
  return text;
}

std::string optionText(const CLI::Option& option) {
  std::string names;
  for (const std::string& name : dashedNames(option))
    names += (names.empty() ? "" : ", ") + bold(name);
  if (names.empty()) names = bold(option.get_name(true));
  const std::string kind = kindOf(option);
  if (!kind.empty()) names += " \\fI" + troff(kind) + "\\fR";
  return ".TP\n" + names + "\n" + troff(option.get_description()) + "\n";
}

std::string pageName(const CLI::App& verb) { return "restlab-" + verb.get_name(); }

// `name`: "restlab", or that of a verb's page.
std::string manHeading(const std::string& name, const std::string& summary) {
  std::string title = name;
  std::transform(title.begin(), title.end(), title.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return fmt::format(".TH {} 1 \"\" \"restlab {}\" \"restlab\"\n.SH NAME\n{} \\- {}\n",
                     troff(title), buildInfo().version, troff(name), troff(summary));
}

std::string verbPage(const CLI::App& app, const CLI::App& verb) {
  std::string positionals, options;
  for (const CLI::Option* option : verb.get_options()) {
    if (!dashedNames(*option).empty()) continue;
    const std::string name = troff(option->get_name(true));
    positionals += option->get_required() ? " \\fI" + name + "\\fR" : " [\\fI" + name + "\\fR]";
  }
  for (const CLI::Option* option : verb.get_options()) options += optionText(*option);
  return manHeading(pageName(verb), verb.get_description()) + ".SH SYNOPSIS\n" +
         bold("restlab " + verb.get_name()) + " [\\fIoptions\\fR]" + positionals +
         "\n.SH OPTIONS\n" + options + ".SH EXIT STATUS\n" + footerText(app.get_footer()) +
         ".SH SEE ALSO\n.BR restlab (1)\n";
}

std::string mainPage(const CLI::App& app) {
  std::string verbs;
  for (const CLI::App* verb : app.get_subcommands({}))
    verbs +=
        ".TP\n\\fB" + troff(pageName(*verb)) + "\\fR(1)\n" + troff(verb->get_description()) + "\n";
  // The description begins with the name.
  const std::string summary = app.get_description().substr(std::string("restlab ").size());
  return manHeading("restlab", summary) +
         ".SH SYNOPSIS\n.B restlab\n\\fIverb\\fR [\\fIoptions\\fR]\n.SH VERBS\n" + verbs +
         ".SH EXIT STATUS\n" + footerText(app.get_footer()) +
         ".SH FILES\n.TP\n.I share/restlab\nSuites and their scenes, which verbs find by name.\n" +
         ".TP\n.I share/doc/restlab\nThe documents: begin with README.md.\n";
}

}  // namespace

void writeManPages(const CLI::App& app, const std::filesystem::path& folder) {
  makeWritableDirectory(folder);
  writeTextFile(folder / "restlab.1", mainPage(app));
  for (const CLI::App* verb : app.get_subcommands({}))
    writeTextFile(folder / (pageName(*verb) + ".1"), verbPage(app, *verb));
}

}  // namespace restlab
