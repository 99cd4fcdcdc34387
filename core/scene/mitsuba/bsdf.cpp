// Bsdfs: which plugin is read how, and those that hold other BSDFs.
#include "core/scene/mitsuba/bsdf.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/scene/gltf/material.h"

namespace restlab::mitsuba {
namespace {

constexpr int kMostNesting = 16;  // BSDFs in each other

const std::vector<std::string> kPlugins = {"diffuse",
                                           "roughdiffuse",
                                           "conductor",
                                           "roughconductor",
                                           "dielectric",
                                           "roughdielectric",
                                           "thindielectric",
                                           "plastic",
                                           "roughplastic",
                                           "phong",
                                           "principled",
                                           "difftrans",
                                           "blendbsdf",
                                           "mixturebsdf",
                                           "mask",
                                           "twosided",
                                           "normalmap",
                                           "bumpmap",
                                           "null"};

// Errors of a configuration are here those of a scene.
template <class Step>
auto inputAt(const std::string& place, const Step& step) {
  try {
    return step();
  } catch (const Error& error) {
    throw Error(ExitCode::badInput, place + ": " + error.what());
  }
}

}  // namespace

void Appearance::set(const std::string& key, double value) {
  toml += fmt::format("{} = {}\n", key, value);
}
void Appearance::set(const std::string& key, const glm::dvec3& value) {
  toml += fmt::format("{} = [{}, {}, {}]\n", key, value.x, value.y, value.z);
}
void Appearance::set(const std::string& key, const std::string& value) {
  toml += fmt::format("{} = \"{}\"\n", key, value);
}
void Appearance::set(const std::string& key, const TexturedColor& value) {
  set(key, value.factor);
  if (value.use) uses.emplace_back(key, *value.use);
}
void Appearance::set(const std::string& key, const TexturedNumber& value) {
  set(key, value.factor);
  if (value.use) uses.emplace_back(key, *value.use);
}

Bsdfs::Bsdfs(const Context& context, Textures& textures, const std::filesystem::path& folder)
    : context_(context), textures_(textures), inputs_(folder, context.scene) {}

void Bsdfs::note(const Parameters& p, const std::string& text) {
  const std::string& type = p.element().type;
  context_.report.note("bsdf " + type, p.place(), fmt::format("bsdf '{}': {}", type, text));
}

Appearance Bsdfs::unknown(const Element& element, const std::string& text) {
  if (!context_.allowsUnknown)
    context_.report.fail(element.place, text + " (--allow-unknown draws it as mid grey)");
  context_.report.warn("unknown bsdf", element.place, text + "; it is drawn as mid grey");
  Appearance grey;
  grey.set("kind", std::string("diffuse"));
  grey.set("color", 0.5);
  return grey;
}

Appearance Bsdfs::read(const Element& element, int depth) {
  if (const auto known = known_.find(&element); known != known_.end()) return known->second;
  if (depth > kMostNesting)
    context_.report.fail(element.place,
                         fmt::format("more than {} BSDFs hold each other", kMostNesting));
  if (element.tag != "bsdf")
    context_.report.fail(element.place, fmt::format("<{}> is no <bsdf>", element.tag));
  Parameters p(element, context_);
  Appearance appearance = readKind(element, p, depth);
  if (appearance.toml.empty()) {  // no plugin that is known
    appearance = unknown(
        element, element.type == "measured"
                     ? std::string("bsdf 'measured' is not read: its tables are of another format; "
                                   "a [[material]] of kind 'table' takes MERL's and EXR files")
                     : fmt::format("bsdf '{}' is unknown; one of {} expected", element.type,
                                   fmt::join(kPlugins, ", ")));
  } else {
    p.finish();
  }
  return known_[&element] = appearance;
}

Appearance Bsdfs::readKind(const Element& element, Parameters& p, int depth) {
  const std::string& type = element.type;
  if (type == "diffuse") return diffuse(p);
  if (type == "roughdiffuse") return roughDiffuse(p);
  if (type == "conductor" || type == "roughconductor") return conductor(p, type != "conductor");
  if (type == "dielectric" || type == "roughdielectric" || type == "thindielectric")
    return dielectric(p, type);
  if (type == "plastic" || type == "roughplastic") return plastic(p, type != "plastic");
  if (type == "phong") return phong(p);
  if (type == "principled") return principled(p);
  if (type == "difftrans") return transmitter(p);
  if (type == "blendbsdf") return blend(p, depth);
  if (type == "mixturebsdf") return mixture(p, depth);
  if (type == "mask") return mask(p, depth);
  if (type == "twosided") return twoSided(p, depth);
  if (type == "normalmap") return normalMap(p, depth);
  if (type == "bumpmap") return bumpMap(p, depth);
  Appearance a;
  if (type != "null") return a;
  a.set("kind", std::string("black"));
  a.isNull = true;
  return a;
}

const Element& Bsdfs::inner(Parameters& p, size_t index, size_t count) {
  const std::vector<const Element*> found = p.plugins("bsdf");
  if (found.size() != count)
    p.fail("", fmt::format("bsdf '{}' holds {} BSDFs; {} expected", p.element().type, found.size(),
                           count));
  return *found[index];
}

// Name of a part of a mixture; "" if the mixture does not take it.
std::string Bsdfs::part(const Element& element, int depth) {
  const Appearance a = read(element, depth + 1);
  const std::string name = fmt::format("{} {}", element.type, ++parts_);
  const Scattering s = scatteringOf(a, name, element.place);
  const bool isTaken = !a.isNull && !a.coverage && a.opacity == 1.0 && !a.normalMap &&
                       !(s.lobes.transmission > 0.0f) && s.kind->name != "mixture" &&
                       (s.flags & rl::RL_MATERIAL_LAYERS) == 0;
  if (!isTaken) return "";
  inputs_.offer(s);
  return name;
}

Appearance Bsdfs::blend(Parameters& p, int depth) {
  const Element &first = inner(p, 0, 2), &second = inner(p, 1, 2);
  const TexturedNumber weight = textures_.number(p, "weight", 0.5, 0.0, 1.0);
  const std::string a = part(first, depth), b = part(second, depth);
  if (a.empty() || b.empty())
    return unknown(p.element(),
                   "bsdf 'blendbsdf' takes BSDFs that reflect alone, without masks, "
                   "maps and mixtures");
  Appearance mixed;
  mixed.set("kind", std::string("mixture"));
  mixed.set("first", a);
  mixed.set("second", b);
  mixed.set("second_share", weight);
  mixed.isOneSided = read(first, depth + 1).isOneSided || read(second, depth + 1).isOneSided;
  if (read(first, depth + 1).heights || read(second, depth + 1).heights)
    context_.report.warn("bump map in a blend", p.place(),
                         "bsdf 'blendbsdf': the bump maps of its BSDFs are left out");
  return mixed;
}

// Version 0.6: a sum of BSDFs by weights.
Appearance Bsdfs::mixture(Parameters& p, int depth) {
  const std::vector<const Element*> parts = p.plugins("bsdf");
  std::vector<double> weights = parseNumbers(p.text("weights", ""), p.place(), context_.report);
  if (weights.size() != parts.size() || parts.empty())
    p.fail("weights", fmt::format("{} weights of {} BSDFs; one of each expected", weights.size(),
                                  parts.size()));
  double sum = 0.0, others = 0.0;
  for (size_t i = 0; i < weights.size(); ++i) {
    if (!(weights[i] >= 0.0)) p.fail("weights", "a weight below 0");
    sum += weights[i];
    if (i > 0) others += weights[i];
  }
  if (sum > 1.0 + 1e-6)
    p.fail("weights", fmt::format("the weights add to {:g}; at most 1 expected", sum));
  Appearance mixed;
  mixed.set("kind", std::string("mixture"));
  const char* names[] = {"first", "second", "third", "fourth"};
  for (size_t i = 0; i < parts.size() && parts.size() >= 2 && parts.size() <= 4; ++i) {
    const std::string name = part(*parts[i], depth);
    if (name.empty()) break;
    mixed.set(names[i], name);
    const double rest = 1.0 - std::min(others, 1.0);
    const double share = i > 0 ? weights[i] : rest > 0.0 ? std::min(weights[0] / rest, 1.0) : 0.0;
    mixed.set(std::string(names[i]) + "_share", share);
    mixed.isOneSided = mixed.isOneSided || read(*parts[i], depth + 1).isOneSided;
    if (i + 1 == parts.size()) return mixed;
  }
  return unknown(p.element(),
                 "bsdf 'mixturebsdf' takes two to four BSDFs that reflect alone, without "
                 "masks, maps and mixtures");
}

Appearance Bsdfs::mask(Parameters& p, int depth) {
  Appearance a = read(inner(p, 0, 1), depth + 1);
  const TexturedNumber opacity = textures_.number(p, "opacity", 0.5, 0.0, 1.0);
  if (a.coverage && opacity.use)
    return unknown(p.element(), "bsdf 'mask' holds another mask with a texture");
  a.opacity *= opacity.factor;
  if (opacity.use) a.coverage = opacity.use;
  return a;
}

Appearance Bsdfs::twoSided(Parameters& p, int depth) {
  const std::vector<const Element*> sides = p.plugins("bsdf");
  if (sides.size() != 1 && sides.size() != 2)
    p.fail("", fmt::format("bsdf 'twosided' holds {} BSDFs; 1 or 2 expected", sides.size()));
  if (sides.size() == 2)
    context_.report.warn(
        "two sides", p.place(),
        "bsdf 'twosided': the first BSDF is drawn on both sides; the second one is "
        "left out");
  Appearance a = read(*sides[0], depth + 1);
  a.isOneSided = false;
  return a;
}

Appearance Bsdfs::normalMap(Parameters& p, int depth) {
  Appearance a = read(inner(p, 0, 1), depth + 1);
  const std::vector<const Element*> maps = p.plugins("texture");
  if (maps.size() != 1)
    p.fail("", fmt::format("bsdf 'normalmap' holds {} textures; 1 expected", maps.size()));
  p.ignore({"flip_invalid_normals", "use_shadowing_function"});
  a.normalMap = textures_.texture(*maps[0]).use;
  return a;
}

Appearance Bsdfs::bumpMap(Parameters& p, int depth) {
  Appearance a = read(inner(p, 0, 1), depth + 1);
  const std::vector<const Element*> maps = p.plugins("texture");
  if (maps.size() != 1)
    p.fail("", fmt::format("bsdf 'bumpmap' holds {} textures; 1 expected", maps.size()));
  const double scale = p.number("scale", 1.0, -1e6, 1e6);
  if (a.normalMap || a.heights) {
    context_.report.warn("bump map", p.place(),
                         "bsdf 'bumpmap' holds another map of normals or heights, which is drawn");
    return a;
  }
  const TexturedColor texture = textures_.texture(*maps[0]);
  a.heights = texture.use;
  a.heightScale = scale * texture.factor.x;
  note(p, "heights are drawn as a map of normals of 8 bits, of the shape's mean scale");
  return a;
}

uint32_t Bsdfs::withHeights(uint32_t material, const UvScale& scale, const std::string& place) {
  const Heights heights = heights_.at(material);
  const auto [entry, isNew] =
      withHeights_.try_emplace({material, scale.metres.x, scale.metres.y, scale.side});
  if (!isNew) return entry->second;
  Scene& scene = context_.scene;
  TextureUse use = scene.textureUses[heights.use];
  const TextureImage& image = scene.images[use.image];
  context_.report.takeMemory(place, 4ull * image.width * image.height);
  if (scale.spread > 2.0)
    context_.report.warn(
        "bump map", place,
        fmt::format("a bump map on texture coordinates that are up to {:.3g} times "
                    "as large elsewhere: slopes are those of the mean",
                    scale.spread));
  scene.images.push_back(normalsOf(use, image, heights.scale, scale));
  use.image = uint32_t(scene.images.size() - 1);
  use.srgb = false;
  scene.textureUses.push_back(use);
  SceneMaterial bumped = scene.materials[material];
  bumped.data.textures[rl::RL_TEX_NORMAL] = uint32_t(scene.textureUses.size() - 1);
  scene.materials.push_back(std::move(bumped));
  return entry->second = uint32_t(scene.materials.size() - 1);
}

Scattering Bsdfs::scatteringOf(const Appearance& a, const std::string& name,
                               const std::string& place) {
  std::string escaped;
  for (const char c : name) escaped += c == '"' || c == '\\' ? '_' : c;
  Scattering s = inputAt(place, [&] {
    return readScattering(
        ConfigTable::parseText(fmt::format("name = \"{}\"\n", oneLine(escaped)) + a.toml,
                               "material"),
        inputs_);
  });
  for (const auto& [key, use] : a.uses) {
    for (size_t i = 0; i < s.kind->parameters.size(); ++i) {
      if (s.kind->parameters[i].name != key) continue;
      if (s.kind->closure != nullptr) {
        s.closure.at(i).texture = use;
      } else if (key == "color") {
        s.lobes.textures[rl::RL_TEX_BASE_COLOR] = use;
      }
    }
  }
  return s;
}

Bsdfs::Surface Bsdfs::surfaceOf(const Element* bsdf, const std::optional<TexturedColor>& emission,
                                const std::string& shape) {
  if (!emission) {
    if (const auto known = surfaces_.find(bsdf); known != surfaces_.end()) return known->second;
  }
  Appearance a;
  if (bsdf != nullptr) {
    a = read(*bsdf, 0);
  } else {
    a.set("kind", std::string("diffuse"));
    a.set("color", 0.5);
    a.isOneSided = true;
  }
  const std::string place = bsdf != nullptr ? bsdf->place : shape;
  if (a.isOneSided)
    context_.report.note(
        "one side", place,
        fmt::format("bsdf '{}' without 'twosided' scatters light on both sides; Mitsuba draws its "
                    "back black",
                    bsdf != nullptr ? bsdf->type : "diffuse"));
  if (a.isNull && emission)
    context_.report.warn("null lamp", place, "a lamp with bsdf 'null' lets no light pass here");
  SceneMaterial material;
  const std::string given = bsdf != nullptr && !bsdf->id.empty() ? bsdf->id : shape;
  material.name = oneLine(given);
  material.data = gltf::makeDefaultMaterial();
  if (a.coverage || a.opacity < 1.0) material.data.flags |= rl::RL_MATERIAL_ALPHA_BLEND;
  material.data.alpha = float(a.opacity);
  if (a.normalMap) material.data.textures[rl::RL_TEX_NORMAL] = *a.normalMap;
  const Scattering s = scatteringOf(a, material.name, place);
  if (a.coverage) {
    std::optional<uint32_t> color;
    if (s.kind->closure == nullptr && s.lobes.textures[rl::RL_TEX_BASE_COLOR] != rl::RL_INVALID)
      color = s.lobes.textures[rl::RL_TEX_BASE_COLOR];
    material.data.textures[rl::RL_TEX_BASE_COLOR] =
        textures_.withCoverage(*a.coverage, color, place);
  }
  if (emission) {
    material.data.emission = emission->factor;
    if (emission->use) material.data.textures[rl::RL_TEX_EMISSIVE] = *emission->use;
  }
  scatterAs(s, material);
  context_.scene.materials.push_back(std::move(material));
  const SceneMaterial& added = context_.scene.materials.back();
  Surface surface;
  surface.material = uint32_t(context_.scene.materials.size() - 1);
  surface.isNull = a.isNull;
  if (a.heights) heights_[surface.material] = {*a.heights, a.heightScale};
  surface.hasHeights = a.heights.has_value();
  surface.hasTangents = surface.hasHeights || a.normalMap.has_value() ||
                        (added.data.flags & rl::RL_MATERIAL_ANISOTROPIC) != 0;
  if (!emission) surfaces_[bsdf] = surface;
  return surface;
}

}  // namespace restlab::mitsuba
