// Composes small Mitsuba scenes in a temporary directory.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/scene.h"
#include "tests/scene/gltf_builder.h"

namespace restlab::test {

class MitsubaFolder {
 public:
  // Writes "<scene version=VERSION>BODY</scene>", the tag on the first line, and loads it with what
  // stands behind its '?'.
  Scene load(const std::string& body, const std::string& settings = "",
             const std::string& version = "3.0.0");
  // The line of the Error thrown without the folder's name; "no error" if none was. Expects that it
  // is one of bad input.
  std::string error(const std::string& body, const std::string& settings = "",
                    const std::string& version = "3.0.0");
  // Loads a file as it is written.
  std::string errorOfText(const std::string& text);

  void write(const std::string& name, const std::string& content) {
    directory_.write(name, content);
  }
  void write(const std::string& name, const std::vector<uint8_t>& bytes) {
    directory_.write(name, std::string(bytes.begin(), bytes.end()));
  }
  const std::filesystem::path& path() const { return directory_.path(); }

 private:
  TempDirectory directory_;
};

// "<shape ...>" of a rectangle with a BSDF inside.
std::string rectangleWith(const std::string& bsdf);
// Returns whether a note contains `text`.
bool notes(const Scene& scene, const std::string& text);

}  // namespace restlab::test
