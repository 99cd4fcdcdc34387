// Textures: bitmaps and checkerboards as uses of 8-bit images.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "core/scene/mitsuba/parameters.h"

namespace restlab::mitsuba {

// A factor and, where a texture varies it, the use that multiplies it.
struct TexturedColor {
  glm::dvec3 factor{1.0};
  std::optional<uint32_t> use;  // index into Scene::textureUses
};
struct TexturedNumber {
  double factor = 1.0;
  std::optional<uint32_t> use;  // its red channel
};

class Textures {
 public:
  explicit Textures(const Context& context) : context_(context) {}

  // The parameter as a colour or a texture.
  TexturedColor color(Parameters& parameters, const std::string& name, const glm::dvec3& fallback,
                      Quantity quantity);
  TexturedNumber number(Parameters& parameters, const std::string& name, double fallback, double lo,
                        double hi);
  // Where only one value can be drawn: the mean of a texture, with a warning.
  double constant(Parameters& parameters, const std::string& name, double fallback, double lo,
                  double hi);
  // A texture that must be there.
  TexturedColor texture(const Element& element);

  // A use whose alpha is the red channel of one use and whose colour is that of another, if given.
  uint32_t withCoverage(uint32_t coverage, const std::optional<uint32_t>& color,
                        const std::string& place);

 private:
  TexturedColor bitmap(const Element& element);
  TexturedColor checkerboard(const Element& element);
  TexturedColor scaled(const Element& element);
  uint32_t imageOf(const std::filesystem::path& file, const Element& element, bool& isLinear,
                   double& scale);
  TextureUse useOf(Parameters& parameters);
  uint32_t add(const TextureUse& use);

  const Context& context_;
  struct Loaded {
    uint32_t image = 0;
    bool isFloat = false;
    double scale = 1.0;
  };
  std::map<std::filesystem::path, Loaded> loaded_;
};

}  // namespace restlab::mitsuba
