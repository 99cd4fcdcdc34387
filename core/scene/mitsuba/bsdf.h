// BSDFs as materials of the scene: each plugin of Mitsuba as a kind of scene files
// (docs/materials.md). What is not the same is a note or a warning.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/scene/mitsuba/bump.h"
#include "core/scene/mitsuba/textures.h"
#include "core/scene/scene_file/scene_file.h"

namespace restlab::mitsuba {

// How a surface looks, before it is a material.
struct Appearance {
  std::string toml;  // "kind = ..." and its parameters, as in [[material]]
  std::vector<std::pair<std::string, uint32_t>> uses;  // textures of its parameters
  double opacity = 1.0;
  std::optional<uint32_t> coverage;   // texture that multiplies the opacity
  std::optional<uint32_t> normalMap;  // texture
  std::optional<uint32_t> heights;    // texture of a bump map
  double heightScale = 1.0;           // metres
  bool isNull = false;                // light passes as if nothing were there
  bool isOneSided = false;            // Mitsuba draws its back black

  void set(const std::string& key, double value);
  void set(const std::string& key, const glm::dvec3& value);
  void set(const std::string& key, const std::string& value);
  void set(const std::string& key, const TexturedColor& value);
  void set(const std::string& key, const TexturedNumber& value);
};

class Bsdfs {
 public:
  Bsdfs(const Context& context, Textures& textures, const std::filesystem::path& folder);

  struct Surface {
    uint32_t material = 0;
    bool isNull = false;
    bool hasTangents = false;  // it looks at tangents
    bool hasHeights = false;   // withHeights() makes its material for a shape
  };
  // Material of a shape; `bsdf` nullptr: Mitsuba's default, `emission`: of a lamp.
  Surface surfaceOf(const Element* bsdf, const std::optional<TexturedColor>& emission,
                    const std::string& shape);
  // The material with the normals of its bump map on a surface of that scale.
  uint32_t withHeights(uint32_t material, const UvScale& scale, const std::string& place);

 private:
  Appearance read(const Element& element, int depth);
  Appearance readKind(const Element& element, Parameters& p, int depth);
  Appearance diffuse(Parameters& p);
  Appearance roughDiffuse(Parameters& p);
  Appearance conductor(Parameters& p, bool isRough);
  Appearance dielectric(Parameters& p, const std::string& type);
  Appearance plastic(Parameters& p, bool isRough);
  Appearance phong(Parameters& p);
  Appearance principled(Parameters& p);
  Appearance glassPrincipled(Parameters& p, double transmission);
  Appearance transmitter(Parameters& p);
  Appearance blend(Parameters& p, int depth);
  Appearance mixture(Parameters& p, int depth);
  Appearance mask(Parameters& p, int depth);
  Appearance twoSided(Parameters& p, int depth);
  Appearance normalMap(Parameters& p, int depth);
  Appearance bumpMap(Parameters& p, int depth);
  Appearance unknown(const Element& element, const std::string& text);

  const Element& inner(Parameters& p, size_t index, size_t count);
  std::string part(const Element& element, int depth);
  double relativeIndex(Parameters& p, const char* inside, const char* outside);
  double index(Parameters& p, const std::string& name, const std::string& fallback);
  void setAlpha(Parameters& p, Appearance& a, double fallback);
  std::string distribution(Parameters& p);
  Scattering scatteringOf(const Appearance& a, const std::string& name, const std::string& place);
  void note(const Parameters& p, const std::string& text);

  const Context& context_;
  Textures& textures_;
  SceneFileInputs inputs_;
  std::map<const Element*, Appearance> known_;
  std::map<const Element*, Surface> surfaces_;  // without emission
  struct Heights {
    uint32_t use = 0;
    double scale = 1.0;
  };
  std::map<uint32_t, Heights> heights_;  // by material
  std::map<std::tuple<uint32_t, double, double, double>, uint32_t> withHeights_;
  size_t parts_ = 0;
};

}  // namespace restlab::mitsuba
