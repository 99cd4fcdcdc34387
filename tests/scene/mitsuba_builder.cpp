#include "tests/scene/mitsuba_builder.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/scene/mitsuba/mitsuba.h"

namespace restlab::test {
namespace {

std::string wrapped(const std::string& body, const std::string& version) {
  return "<scene version=\"" + version + "\">\n" + body + "\n</scene>\n";
}

}  // namespace

Scene MitsubaFolder::load(const std::string& body, const std::string& settings,
                          const std::string& version) {
  write("x.xml", wrapped(body, version));
  return loadScene((path() / "x.xml").string() + (settings.empty() ? "" : "?" + settings));
}

std::string MitsubaFolder::error(const std::string& body, const std::string& settings,
                                 const std::string& version) {
  write("x.xml", wrapped(body, version));
  try {
    loadMitsuba(path() / "x.xml", settings);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::badInput);
    std::string line = error.what();
    EXPECT_EQ(line.find('\n'), std::string::npos);
    const std::string folder = path().string() + "/";
    for (size_t at; (at = line.find(folder)) != std::string::npos;) line.erase(at, folder.size());
    return line;
  }
  return "no error";
}

std::string MitsubaFolder::errorOfText(const std::string& text) {
  write("y.xml", text);
  try {
    loadMitsuba(path() / "y.xml");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::badInput);
    return std::string(error.what()).substr((path().string() + "/").size());
  }
  return "no error";
}

std::string rectangleWith(const std::string& bsdf) {
  return "<shape type=\"rectangle\">" + bsdf + "</shape>";
}

bool notes(const Scene& scene, const std::string& text) {
  return std::any_of(scene.notes.begin(), scene.notes.end(),
                     [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

}  // namespace restlab::test
