#include "tests/unit/closure_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/base/config.h"
#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/scene_file/scene_file.h"
#include "tests/unit/dialect_context.h"

namespace restlab::unit {
namespace {

using Kind = ClosureParameter::Kind;

// A table with the angles of each kind.
std::shared_ptr<const ClosureTable> tableOf(TableAngles angles, const glm::uvec3& sizes) {
  auto table = std::make_shared<ClosureTable>(tabulate(tabulatedBrdf, angles, sizes));
  table->name = angles == TableAngles::half ? "half" : "directions";
  return table;
}

Scattering scatteringOf(const std::string& text, Scene& scene) {
  SceneFileInputs inputs("", scene);
  inputs.offer(tableOf(TableAngles::half, {30u, 30u, 30u}));
  inputs.offer(tableOf(TableAngles::directions, {24u, 24u, 24u}));
  const auto read = [&](const std::string& material) {
    return readScattering(ConfigTable::parseText(material, "test"), inputs);
  };
  for (const char* part :
       {"name = \"metal\"\nkind = \"conductor\"\nalpha = 0.2\n",
        "name = \"matte\"\nkind = \"diffuse\"\n", "name = \"smooth\"\nkind = \"plastic\"\n",
        "name = \"hole\"\nkind = \"black\"\n"})
    inputs.offer(read(part));
  return read("name = \"tested\"\n" + text);
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

// A diffuse part beside a lobe about the half vector (normalised Blinn-Phong).
glm::dvec3 tabulatedBrdf(const glm::dvec3& wo, const glm::dvec3& wi) {
  const double power = 40.0, cosH = glm::normalize(wo + wi).z;
  const double lobe = (power + 8.0) / (8.0 * M_PI) * std::pow(cosH, power);
  return glm::dvec3(0.5, 0.3, 0.2) / M_PI + 0.3 * lobe;
}

ClosureCase closureCaseOf(const std::string& text) {
  builtin::SceneBuilder builder("one triangle");
  builder.add(builtin::quad("quad", {-1, -1, 0}, {2, 0, 0}, {0, 2, 0}),
              builder.addMaterial("material", builtin::lambert(glm::vec3(0.5f))));
  Scene scene = builder.finish();
  const Scattering scattering = scatteringOf(text, scene);  // may add materials
  scatterAs(scattering, scene.materials[0]);
  ClosureCase c;
  c.scene = CompiledScene::build(std::move(scene));
  Dialect<> d(c.scene);
  const rl::Hit hit{0, 0, {0.25f, 0.25f}, 1.0f};
  c.bsdf = d->surfaceLoad(hit, {0.0f, 0.0f, -1.0f}).bsdf;
  return c;
}

std::string defaultText(const ClosureInfo& info) {
  std::string text = "kind = \"" + info.name + "\"\n";
  if (info.name == "table") text += "file = \"half\"\n";
  if (info.name == "mixture") text += "first = \"metal\"\nsecond = \"matte\"\n";
  return text;
}

rl::Bsdf closureOf(const std::string& text) { return closureCaseOf(text).bsdf; }

namespace {

// A text for each value of one parameter at a time.
std::vector<std::string> textsOf(const ClosureInfo& info) {
  const std::string kind = defaultText(info);
  std::vector<std::string> texts = {kind};
  for (const ClosureParameter& p : info.parameters) {
    if (p.kind == Kind::table || p.kind == Kind::material) continue;
    if (p.name == "third_share" || p.name == "fourth_share")
      continue;  // of parts that are not there
    if (p.kind == Kind::choice) {
      for (size_t i = 1; i < p.choices.size(); ++i)
        texts.push_back(fmt::format("{}{} = \"{}\"\n", kind, p.name, p.choices[i]));
      continue;
    }
    std::vector<double> values = {p.lo, p.hi};
    if (p.kind == Kind::number) values.push_back(0.5 * (p.lo + p.hi));
    if (p.hi > 1000.0) values = {p.lo, 300.0, 3000.0};  // exponents span decades
    // A convex mixture leaves the other colour nothing.
    const std::vector<std::string>& parts = info.convexParts;
    std::string other;
    if (parts.size() == 2 && (p.name == parts[0] || p.name == parts[1]))
      other = parts[p.name == parts[0] ? 1 : 0];
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
    if (info.name == "table") texts.push_back("kind = \"table\"\nfile = \"directions\"\n");
    if (info.name == "mixture")
      texts.push_back(
          "kind = \"mixture\"\nfirst = \"hole\"\nsecond = \"metal\"\nthird = \"smooth\"\n"
          "fourth = \"matte\"\nsecond_share = 0.3\nthird_share = 0.2\nfourth_share = 0.3\n");
    if (info.name == "cook_torrance")
      texts.push_back(texts.front() +
                      "share = 1.0\nf0 = 1.0\nalpha = 1.0\nd = \"blinn\"\ng = \"smith\"\n");
    for (const std::string& text : texts) {
      std::string name = text;
      std::replace(name.begin(), name.end(), '\n', ' ');
      ClosureCase c = closureCaseOf(text);
      c.kind = info.name;
      c.name = name;
      c.breaksEnergy = declares(info, "energy", text);
      c.breaksReciprocity = declares(info, "reciprocity", text);
      c.isCombined = cases.size() - first >= single;
      cases.push_back(std::move(c));
    }
  }
  return cases;
}

}  // namespace restlab::unit
