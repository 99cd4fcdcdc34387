// Bsdfs: plugins that scatter light themselves.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/scene/mitsuba/bsdf.h"
#include "core/scene/mitsuba/optical_constants.h"

namespace restlab::mitsuba {
namespace {

constexpr double kMostIndex = 4.0;

// Fresnel reflectance of unpolarised light at a surface of relative index eta.
double dielectricFresnel(double cosine, double eta) {
  const double sine2 = (1.0 - cosine * cosine) / (eta * eta);
  if (sine2 >= 1.0) return 1.0;
  const double refracted = std::sqrt(1.0 - sine2);
  const double parallel = (eta * cosine - refracted) / (eta * cosine + refracted);
  const double across = (cosine - eta * refracted) / (cosine + eta * refracted);
  return 0.5 * (parallel * parallel + across * across);
}

// Its mean over the hemisphere, weighted by the cosine.
double meanFresnel(double eta) {
  constexpr int kSteps = 512;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double squared = (i + 0.5) / kSteps;  // of the cosine
    sum += dielectricFresnel(std::sqrt(squared), eta);
  }
  return sum / kSteps;
}

// The index whose reflectance at normal incidence is that of both faces of a sheet, 2 R / (1 + R).
double indexOfSheet(double eta) {
  const double one = dielectricFresnel(1.0, eta);
  const double root = std::sqrt(2.0 * one / (1.0 + one));
  return std::min((1.0 + root) / (1.0 - root), kMostIndex);
}

}  // namespace

double Bsdfs::index(Parameters& p, const std::string& name, const std::string& fallback) {
  const Element* element = p.find(name);
  if (element != nullptr && element->tag != "string") return p.number(name, 1.0, 1.0, 10.0);
  const std::string given = p.text(name, fallback);
  const double found = indexOfRefraction(given);
  if (found == 0.0)
    p.fail(name, fmt::format("'{}' is '{}'; a number or one of {} expected{}", name, given,
                             fmt::join(indexNames(), ", "), didYouMean(given, indexNames())));
  return found;
}

double Bsdfs::relativeIndex(Parameters& p, const char* inside, const char* outside) {
  const double eta = index(p, "int_ior", inside) / index(p, "ext_ior", outside);
  if (!(eta >= 1.0 && eta <= kMostIndex))
    p.fail("int_ior", fmt::format("'int_ior' over 'ext_ior' is {:g}; 1 to {:g} expected (turn the "
                                  "surface over, and trade both)",
                                  eta, kMostIndex));
  return eta;
}

std::string Bsdfs::distribution(Parameters& p) {
  p.ignore({"sample_visible"});
  const std::string name = p.choice("distribution", "beckmann", {"beckmann", "ggx", "phong", "as"});
  if (name != "phong" && name != "as") return name;
  note(p, fmt::format("distribution '{}' is drawn as beckmann of the same alpha", name));
  return "beckmann";
}

// alpha, or alpha_u and alpha_v along the tangents.
void Bsdfs::setAlpha(Parameters& p, Appearance& a, double fallback) {
  if (!p.has("alpha_u") && !p.has("alpha_v")) {
    a.set("alpha", textures_.number(p, "alpha", fallback, 0.0, 1.0));
    return;
  }
  const double u = textures_.constant(p, "alpha_u", fallback, 0.0, 1.0),
               v = textures_.constant(p, "alpha_v", fallback, 0.0, 1.0);
  const double mean = std::sqrt(u * v);
  a.set("alpha", mean);
  if (!(mean > 0.0) || u == v) return;
  // The closure's aspect is alpha_v / alpha_u = 1 - 0.9 anisotropic.
  const double anisotropic = (1.0 - v / u) / 0.9;
  a.set("anisotropic", std::clamp(anisotropic, 0.0, 1.0));
  if (!(anisotropic >= 0.0 && anisotropic <= 1.0) || u / std::sqrt(v / u) > 1e9)
    context_.report.warn(
        "anisotropy", p.place(),
        fmt::format("alpha_u {:g} and alpha_v {:g} are drawn as {:g} and {:g}: "
                    "alpha_v is 0.1 to 1 times alpha_u here",
                    u, v, mean / std::sqrt(1.0 - 0.9 * std::clamp(anisotropic, 0.0, 1.0)),
                    mean * std::sqrt(1.0 - 0.9 * std::clamp(anisotropic, 0.0, 1.0))));
}

Appearance Bsdfs::diffuse(Parameters& p) {
  Appearance a;
  a.set("kind", std::string("diffuse"));
  a.set("color", textures_.color(p, "reflectance", glm::dvec3(0.5), Quantity::reflectance));
  a.isOneSided = true;
  return a;
}

Appearance Bsdfs::roughDiffuse(Parameters& p) {
  Appearance a;
  a.set("kind", std::string("oren_nayar"));
  a.set("color", textures_.color(p, "reflectance", glm::dvec3(0.5), Quantity::reflectance));
  a.set("sigma", textures_.constant(p, "alpha", 0.2, 0.0, 1.0) / std::sqrt(2.0));
  a.set("model", std::string("full"));
  if (p.boolean("use_fast_approx", false))
    note(p, "the full model of Oren and Nayar is drawn, not its short form");
  a.isOneSided = true;
  return a;
}

Appearance Bsdfs::conductor(Parameters& p, bool isRough) {
  Appearance a;
  const std::string fallback = context_.document.isLegacy() ? "Cu" : "none";
  const std::string material = p.text("material", fallback);
  const bool hasIndex = p.has("eta") || p.has("k");
  const bool isMirror = !hasIndex && material == "none";
  if (isMirror && !isRough) {
    a.set("kind", std::string("mirror"));
    a.set("color",
          textures_.color(p, "specular_reflectance", glm::dvec3(1.0), Quantity::reflectance));
    a.isOneSided = true;
    return a;
  }
  a.set("kind", std::string("conductor"));
  a.set("color",
        textures_.color(p, "specular_reflectance", glm::dvec3(1.0), Quantity::reflectance));
  if (hasIndex) {
    const double outside = index(p, "ext_eta", "vacuum");
    const glm::dvec3 eta = p.color("eta", glm::dvec3(0.0), Quantity::index) / outside,
                     k = p.color("k", glm::dvec3(1.0), Quantity::index) / outside;
    a.set("eta", glm::min(eta, 20.0));
    a.set("k", glm::min(k, 20.0));
    if (glm::max(eta, k) != glm::min(glm::max(eta, k), 20.0)) p.fail("eta", "eta or k is above 20");
  } else if (isMirror) {
    a.set("eta", 0.0);  // reflects all light at every angle
    a.set("k", 1.0);
  } else {
    const std::string metal = metalOf(material);
    if (metal.empty())
      p.fail("material", fmt::format("material '{}' is unknown; none, {} or eta and k expected",
                                     material, fmt::join(metalNames(), ", ")));
    a.set("metal", metal);
    p.ignore({"ext_eta"});
    note(p, fmt::format("'{}' has its indices at 630, 550 and 450 nm, not a spectrum", material));
  }
  if (isRough) {
    setAlpha(p, a, 0.1);
    a.set("distribution", distribution(p));
    a.set("masking", std::string("smith"));
  } else {
    a.set("alpha", 0.0);
  }
  a.isOneSided = true;
  return a;
}

Appearance Bsdfs::dielectric(Parameters& p, const std::string& type) {
  Appearance a;
  const bool isThin = type == "thindielectric", isRough = type == "roughdielectric";
  a.set("kind", std::string(isThin ? "thin_dielectric" : "dielectric"));
  const double eta = relativeIndex(p, "bk7", "air");
  a.set("ior", isThin ? indexOfSheet(eta) : eta);
  a.set("color",
        textures_.color(p, "specular_transmittance", glm::dvec3(1.0), Quantity::reflectance));
  const glm::dvec3 reflectance =
      p.color("specular_reflectance", glm::dvec3(1.0), Quantity::reflectance);
  if (reflectance != glm::dvec3(1.0))
    context_.report.warn("reflectance of glass", p.place(),
                         "'specular_reflectance' is not read: glass reflects by Fresnel's term");
  if (isThin)
    note(p, "both faces of the sheet are drawn as one, with their reflectance at normal incidence");
  if (isRough) {
    if (distribution(p) != "ggx") note(p, "beckmann's facets are drawn as GGX of the same alpha");
    if (p.has("alpha_u") || p.has("alpha_v")) {
      const double u = textures_.constant(p, "alpha_u", 0.1, 0.0, 1.0),
                   v = textures_.constant(p, "alpha_v", 0.1, 0.0, 1.0);
      a.set("alpha", std::sqrt(u * v));
      if (u != v)
        context_.report.warn("anisotropy", p.place(),
                             "rough glass is drawn with the geometric mean of alpha_u and alpha_v");
    } else {
      a.set("alpha", textures_.constant(p, "alpha", 0.1, 0.0, 1.0));
    }
  }
  return a;
}

Appearance Bsdfs::plastic(Parameters& p, bool isRough) {
  Appearance a;
  a.set("kind", std::string("plastic"));
  const double eta = relativeIndex(p, "polypropylene", "air");
  TexturedColor base =
      textures_.color(p, "diffuse_reflectance", glm::dvec3(0.5), Quantity::reflectance);
  const glm::dvec3 reflectance =
      p.color("specular_reflectance", glm::dvec3(1.0), Quantity::reflectance);
  if (reflectance != glm::dvec3(1.0))
    context_.report.warn(
        "reflectance of plastic", p.place(),
        "'specular_reflectance' is not read: the layer reflects by Fresnel's term");
  if (p.boolean("nonlinear", false)) {
    // Light that the layer sends back takes the colour of the base again, at every turn.
    const double back = 1.0 - (1.0 - meanFresnel(eta)) / (eta * eta);
    if (base.use) {
      context_.report.warn("nonlinear plastic", p.place(),
                           "'nonlinear' is not read of a texture: colours are less saturated");
    } else {
      base.factor = base.factor * (1.0 - back) / (1.0 - base.factor * back);
    }
  }
  note(p, "its layer reflects by Schlick's approximation of Fresnel's term");
  a.set("color", base);
  a.set("ior", eta);
  if (isRough) {
    if (distribution(p) != "ggx") note(p, "beckmann's facets are drawn as GGX of the same alpha");
    a.set("alpha", textures_.constant(p, "alpha", 0.1, 0.0, 1.0));
  }
  a.isOneSided = true;
  return a;
}

Appearance Bsdfs::phong(Parameters& p) {
  Appearance a;
  a.set("kind", std::string("phong"));
  a.set("model", std::string("modified"));
  TexturedColor base = textures_.color(p, "diffuse_reflectance", glm::dvec3(0.5),
                                       Quantity::reflectance),
                lobe = textures_.color(p, "specular_reflectance", glm::dvec3(0.2),
                                       Quantity::reflectance);
  const glm::dvec3 sum = base.factor + lobe.factor;
  const double most = std::max({sum.x, sum.y, sum.z});
  if (most > 1.0) {
    base.factor /= most;
    lobe.factor /= most;
    context_.report.warn(
        "energy of phong", p.place(),
        fmt::format("both reflectances add to {:g}; they are drawn over that", most));
  }
  a.set("diffuse", base);
  a.set("specular", lobe);
  a.set("power", textures_.number(p, "exponent", 30.0, 0.0, 1e5));
  a.isOneSided = true;
  return a;
}

Appearance Bsdfs::principled(Parameters& p) {
  const double transmission = textures_.constant(p, "spec_trans", 0.0, 0.0, 1.0);
  p.ignore({"diffuse_reflectance_sampling_rate", "main_specular_sampling_rate",
            "clearcoat_sampling_rate"});
  if (p.has("eta") && p.has("specular")) p.fail("eta", "'eta' beside 'specular': one of them");
  if (transmission > 0.0) return glassPrincipled(p, transmission);
  Appearance a;
  a.set("kind", std::string("disney"));
  a.set("baseColor", textures_.color(p, "base_color", glm::dvec3(0.5), Quantity::reflectance));
  const double eta = p.number("eta", 1.5, 1.0, kMostIndex);
  double specular = p.number("specular", 0.5, 0.0, 12.5);
  if (p.has("eta")) specular = dielectricFresnel(1.0, eta) / 0.08;
  if (specular > 1.0)
    context_.report.warn("specular", p.place(),
                         fmt::format("a reflectance of {:.3g} at normal incidence is drawn as 0.08",
                                     0.08 * specular));
  a.set("specular", std::min(specular, 1.0));
  const auto take = [&](const char* key, const char* name, double fallback) {
    a.set(key, textures_.number(p, name, fallback, 0.0, 1.0));
  };
  take("roughness", "roughness", 0.5);
  take("anisotropic", "anisotropic", 0.0);
  take("metallic", "metallic", 0.0);
  take("specularTint", "spec_tint", 0.0);
  take("sheen", "sheen", 0.0);
  take("sheenTint", "sheen_tint", 0.0);
  take("subsurface", "flatness", 0.0);
  take("clearcoat", "clearcoat", 0.0);
  take("clearcoatGloss", "clearcoat_gloss", 0.0);
  note(p, "is drawn as Disney's model of 2012");
  a.isOneSided = true;
  return a;
}

// With light that passes: the lobes of glTF, which have most of its parameters.
Appearance Bsdfs::glassPrincipled(Parameters& p, double transmission) {
  Appearance a;
  a.set("kind", std::string("gltf"));
  a.set("color", textures_.color(p, "base_color", glm::dvec3(0.5), Quantity::reflectance));
  const double root = std::sqrt(0.08 * p.number("specular", 0.5, 0.0, 12.5));
  const double fallback = std::clamp(2.0 / (1.0 - std::min(root, 0.9)) - 1.0, 1.0, kMostIndex);
  a.set("ior", p.number("eta", fallback, 1.0, kMostIndex));
  a.set("transmission", transmission);
  const auto take = [&](const char* key, const char* name, double most) {
    a.set(key, most * textures_.constant(p, name, key == std::string("roughness") ? 0.5 : 0.0, 0.0,
                                         1.0));
  };
  take("roughness", "roughness", 1.0);
  take("metallic", "metallic", 1.0);
  take("anisotropy", "anisotropic", 1.0);
  take("clearcoat", "clearcoat", 0.25);
  const double gloss = textures_.constant(p, "clearcoat_gloss", 0.0, 0.0, 1.0);
  a.set("clearcoat_roughness", std::sqrt(0.1 - 0.099 * gloss));
  p.ignore({"spec_tint", "sheen", "sheen_tint", "flatness"});
  note(p,
       "with spec_trans it is drawn by the lobes of glTF, without spec_tint, sheen and flatness");
  return a;
}

// Version 0.6: Lambert's law to the other side.
Appearance Bsdfs::transmitter(Parameters& p) {
  Appearance a;
  a.set("kind", std::string("gltf"));
  a.set("color", glm::dvec3(1.0));
  a.set("specular", 0.0);
  a.set("diffuse_transmission", 1.0);
  const TexturedColor color =
      textures_.color(p, "transmittance", glm::dvec3(0.5), Quantity::reflectance);
  if (color.use)
    context_.report.warn("texture of transmittance", p.place(),
                         "'transmittance' takes no texture here; its largest value is drawn");
  a.set("diffuse_transmission_color", color.factor);
  return a;
}

}  // namespace restlab::mitsuba
