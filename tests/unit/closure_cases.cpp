#include "tests/unit/closure_cases.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/config.h"
#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/scene_file/scene_file.h"
#include "tests/unit/dialect_context.h"

namespace restlab::unit {
namespace {

using Kind = ClosureParameter::Kind;

Scattering scatteringOf(const std::string& text) {
  Scene none;
  SceneFileTextures textures("", none);
  return readScattering(ConfigTable::parseText("name = \"tested\"\n" + text, "test"), textures);
}

bool declares(const ClosureInfo& info, const std::string& law, const std::string& text) {
  const bool isBroken =
      std::find(info.brokenLaws.begin(), info.brokenLaws.end(), law) != info.brokenLaws.end();
  if (!isBroken) return false;
  if (info.brokenWhere.empty()) return true;
  // A choice that the text does not name has its first value.
  const bool isNamed = text.find(info.brokenWhere + " = ") != std::string::npos;
  const bool isDefault =
      std::any_of(info.parameters.begin(), info.parameters.end(), [&](const ClosureParameter& p) {
        return p.name == info.brokenWhere && p.choices.front() == info.brokenIf;
      });
  return isNamed ? text.find(info.brokenWhere + " = \"" + info.brokenIf) != std::string::npos
                 : isDefault;
}

}  // namespace

rl::Bsdf closureOf(const std::string& text) {
  builtin::SceneBuilder builder("one triangle");
  builder.add(builtin::quad("quad", {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}),
              builder.addMaterial("material", builtin::lambert(glm::vec3(0.5f))));
  Scene scene = builder.finish();
  scatterAs(scatteringOf(text), scene.materials[0]);
  Dialect<> d(CompiledScene::build(std::move(scene)));
  const rl::Hit hit{0, 0, {0.25f, 0.25f}, 1.0f};
  return d->surfaceLoad(hit, {0.0f, 0.0f, -1.0f}).bsdf;
}

namespace {

// A text for each value of one parameter at a time.
std::vector<std::string> textsOf(const ClosureInfo& info) {
  const std::string kind = "kind = \"" + info.name + "\"\n";
  std::vector<std::string> texts = {kind};
  for (const ClosureParameter& p : info.parameters) {
    if (p.kind == Kind::choice) {
      for (size_t i = 1; i < p.choices.size(); ++i)
        texts.push_back(fmt::format("{}{} = \"{}\"\n", kind, p.name, p.choices[i]));
      continue;
    }
    std::vector<double> values = {p.lo, p.hi};
    if (p.kind == Kind::number) values.push_back(0.5 * (p.lo + p.hi));
    if (p.hi > 1000.0) values = {p.lo, 300.0, 3000.0};  // exponents span decades
    // A convex mixture leaves the other colour nothing.
    const std::string other = p.name == info.convexOne     ? info.convexOther
                              : p.name == info.convexOther ? info.convexOne
                                                           : "";
    for (const double value : values) {
      texts.push_back(fmt::format("{}{} = {:.4f}\n", kind, p.name, value));
      if (!other.empty()) texts.back() += fmt::format("{} = {:.4f}\n", other, 1.0 - value);
    }
  }
  return texts;
}

// Combinations of what facets have, which one parameter at a time would miss.
std::vector<std::string> facetTexts() {
  std::vector<std::string> texts;
  for (const char* alpha : {"0.002", "0.05", "0.4", "1.0"}) {
    for (const char* anisotropic : {"0.0", "0.9"}) {
      for (const char* d : {"ggx", "beckmann", "blinn"}) {
        for (const char* g : {"correlated", "smith", "v_cavities"})
          texts.push_back(fmt::format(
              "kind = \"conductor\"\nmetal = \"Ag\"\nalpha = {}\nanisotropic = {}\ndistribution = "
              "\"{}\"\nmasking = \"{}\"\n",
              alpha, anisotropic, d, g));
      }
    }
  }
  return texts;
}

}  // namespace

std::vector<ClosureCase> closureCases() {
  std::vector<ClosureCase> cases;
  for (const ClosureInfo& info : closureRegistry()) {
    std::vector<std::string> texts = textsOf(info);
    const size_t first = cases.size(), single = texts.size();
    if (info.name == "conductor") {
      for (const std::string& text : facetTexts()) texts.push_back(text);
    }
    if (info.name == "cook_torrance")
      texts.push_back(texts.front() +
                      "share = 1.0\nf0 = 1.0\nalpha = 1.0\nd = \"blinn\"\ng = \"smith\"\n");
    for (const std::string& text : texts) {
      std::string name = text;
      std::replace(name.begin(), name.end(), '\n', ' ');
      cases.push_back({info.name, name, closureOf(text), declares(info, "energy", text),
                       declares(info, "reciprocity", text), cases.size() - first >= single});
    }
  }
  return cases;
}

}  // namespace restlab::unit
