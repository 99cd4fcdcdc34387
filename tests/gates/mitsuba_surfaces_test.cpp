// BSDFs and textures of Mitsuba under light that is the same everywhere, or comes from one
// direction.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/image/io/png.h"
#include "tests/gates/known_pixels.h"

namespace restlab::gates {
namespace {

constexpr double kPiOfSurfaces = std::numbers::pi;

std::string rgb(const std::string& name, const std::string& value) {
  return "<rgb name=\"" + name + "\" value=\"" + value + "\"/>";
}

// Share of light that a surface reflects, of an index that may be complex (Fresnel 1823).
double fresnel(double cosine, std::complex<double> eta) {
  const std::complex<double> refracted = std::sqrt(eta * eta - 1.0 + cosine * cosine);
  const std::complex<double> across = (cosine - refracted) / (cosine + refracted),
                             parallel = (eta * eta * cosine - refracted) /
                                        (eta * eta * cosine + refracted);
  return 0.5 * (std::norm(across) + std::norm(parallel));
}

// A metal floor under a sky of radiance 2.
TEST(MitsubaTruths, AMetalUnderASky) {
  KnownScene scene{.name = "conductor", .xml = {}, .rounding = 1e-5};
  scene.xml = sensorXml("0,2,4", "0,0,0", "0,1,0", 50.0, scene) +
              "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"500\"/>"
              "<rotate x=\"1\" angle=\"-90\"/></transform><bsdf type=\"conductor\">" +
              rgb("eta", "0.2 1.1 1.5") + rgb("k", "3.9 2.5 1.9") +
              rgb("specular_reflectance", "0.9 0.8 0.7") +
              "</bsdf></shape><emitter type=\"constant\">" + rgb("radiance", "2") + "</emitter>";
  const TheirCamera camera = lookingAt({0, 2, 4}, {0, 0, 0}, {0, 1, 0}, 50.0, scene);
  const auto truth = [&](double factorOfK) {
    return meanOver(camera, [=](const glm::dvec3&, const glm::dvec3& dir) {
      const auto r = [&](double eta, double k) {
        return 2.0 * fresnel(-dir.y, {eta, factorOfK * k});
      };
      return glm::dvec3(0.9 * r(0.2, 3.9), 0.8 * r(1.1, 2.5), 0.7 * r(1.5, 1.9));
    });
  };
  expectPixels(scene, truth(1.0), {{"k + 2 %", truth(1.02)}});
}

// Glass between the camera and a wide lamp: of each face's reflectance r, (1 - r) / (1 + r) passes
// after all reflections in the glass.
void expectGlass(const std::string& name, const std::string& glass, double fov, double aside) {
  KnownScene scene{.name = name, .xml = {}, .width = 12, .height = 8, .bounces = 24, .frames = 64};
  scene.xml = sensorXml("0,0,5", fmt::format("{},0,0", aside), "0,1,0", fov, scene) + glass +
              "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"200\"/>"
              "<translate z=\"-3\"/></transform><bsdf type=\"diffuse\">" +
              rgb("reflectance", "0") + "</bsdf><emitter type=\"area\">" +
              rgb("radiance", "3 2 1") + "</emitter></shape>";
  const TheirCamera camera = lookingAt({0, 0, 5}, {aside, 0, 0}, {0, 1, 0}, fov, scene);
  const auto truth = [&](double eta) {
    return meanOver(camera, [=](const glm::dvec3&, const glm::dvec3& dir) {
      const double r = fresnel(-dir.z, eta);
      return glm::dvec3(3, 2, 1) * ((1.0 - r) / (1.0 + r));
    });
  };
  const auto oneFace = meanOver(camera, [](const glm::dvec3&, const glm::dvec3& dir) {
    return glm::dvec3(3, 2, 1) * (1.0 - fresnel(-dir.z, 1.5));
  });
  expectPixels(scene, truth(1.5), {{"index + 5 %", truth(1.575)}, {"one face", oneFace}});
}

TEST(MitsubaTruths, ASlabOfGlassBeforeALamp) {
  expectGlass("dielectric slab",
              "<shape type=\"cube\"><transform name=\"to_world\"><scale x=\"100\" y=\"100\" "
              "z=\"0.5\"/></transform><bsdf type=\"dielectric\"><float name=\"int_ior\" "
              "value=\"1.5\"/><float name=\"ext_ior\" value=\"1\"/></bsdf></shape>",
              70.0, 2.0);
}

// The reader has both faces' reflectance at normal incidence alone, and says so.
TEST(MitsubaTruths, ASheetOfGlassBeforeALamp) {
  expectGlass("thindielectric",
              "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"100\"/>"
              "</transform><bsdf type=\"thindielectric\"><float name=\"int_ior\" value=\"1.5\"/>"
              "<float name=\"ext_ior\" value=\"1\"/></bsdf></shape>",
              20.0, 0.0);
}

// A film of 24 x 16 pixels of a metre, seen along -Z, under light of 1 W/m^2 from the camera's
// side.
std::string parallelView(const std::string& shapes) {
  return "<sensor type=\"orthographic\"><transform name=\"to_world\"><scale value=\"12\"/>"
         "<lookat origin=\"0,0,5\" target=\"0,0,0\" up=\"0,1,0\"/></transform><film "
         "type=\"hdrfilm\"><integer name=\"width\" value=\"24\"/><integer name=\"height\" "
         "value=\"16\"/></film></sensor><emitter type=\"directional\">" +
         rgb("irradiance", "1") + "<vector name=\"direction\" x=\"0.6\" y=\"0\" z=\"-0.8\"/>" +
         "</emitter>" + shapes;
}
constexpr double kLight = 0.8 / kPiOfSurfaces;  // radiance of white Lambert there

std::string diffuse(const std::string& reflectance) {
  return "<bsdf type=\"diffuse\">" + rgb("reflectance", reflectance) + "</bsdf>";
}

// Three strips of 8 pixels: a blend of two colours, a mask before a lamp, and the back of a sheet
// with two sides. Pixels beside their edges are not judged.
TEST(MitsubaTruths, BlendsMasksAndTwoSides) {
  const auto strip = [](int index, const std::string& turn, const std::string& inside) {
    return fmt::format(
        "<shape type=\"rectangle\"><transform name=\"to_world\"><scale x=\"4\" y=\"20\"/>{}"
        "<translate x=\"{}\"/></transform>{}</shape>",
        turn, 8 * index - 8, inside);
  };
  const KnownScene scene{
      .name = "blendbsdf, mask, twosided",
      .xml = parallelView(
          strip(0, "",
                "<bsdf type=\"blendbsdf\"><float name=\"weight\" value=\"0.3\"/>" +
                    diffuse("0.8 0.1 0.5") + diffuse("0.2 0.6 0.5") + "</bsdf>") +
          strip(1, "",
                "<bsdf type=\"mask\"><float name=\"opacity\" value=\"0.4\"/>" +
                    diffuse("0.8 0.1 0.5") + "</bsdf>") +
          strip(2, "<rotate y=\"1\" angle=\"180\"/>",
                "<bsdf type=\"twosided\">" + diffuse("0.8 0.1 0.5") + "</bsdf>") +
          "<shape type=\"rectangle\"><transform name=\"to_world\"><scale x=\"4\" y=\"8\"/>"
          "<translate z=\"-1\"/></transform>" +
          diffuse("0") + "<emitter type=\"area\">" + rgb("radiance", "0.1 0.2 0.3") +
          "</emitter></shape>"),
      .frames = 32};
  const auto truth = [](double weight, double opacity, double factor) {
    return [=](uint32_t x, uint32_t) {
      if (x % 8 == 0 || x % 8 == 7) return glm::dvec3(std::nan(""));
      const glm::dvec3 first(0.8, 0.1, 0.5), second(0.2, 0.6, 0.5);
      if (x < 8) return kLight * glm::mix(first, second, weight);
      if (x < 16) return glm::mix(glm::dvec3(0.1, 0.2, 0.3), kLight * first, opacity);
      return factor * kLight * first;
    };
  };
  expectPixels(scene, truth(0.3, 0.4, 1.0),
               {{"weight of the first", truth(0.7, 0.4, 1.0)},
                {"opacity + 0.02", truth(0.3, 0.42, 1.0)},
                {"two sides + 2 %", truth(0.3, 0.4, 1.02)}});
}

// Squares of 4 pixels: scaled, turned by 90 degrees about the origin of the texture, then moved.
TEST(MitsubaTruths, ACheckerboardIsScaledTurnedAndMoved) {
  const KnownScene scene{
      .name = "checkerboard",
      .xml = parallelView(
          "<shape type=\"rectangle\"><transform name=\"to_world\"><scale x=\"12\" y=\"8\"/>"
          "</transform><bsdf type=\"diffuse\"><texture type=\"checkerboard\" "
          "name=\"reflectance\">" +
          rgb("color0", "0.8 0.2 0.4") + rgb("color1", "0.1 0.5 0.3") +
          "<transform name=\"to_uv\"><scale x=\"3\" y=\"2\"/><rotate z=\"1\" angle=\"90\"/>"
          "<translate x=\"0.25\" y=\"0\"/></transform></texture></bsdf></shape>"),
      .rounding = 3e-4};  // textures have bytes
  const auto truth = [](bool isTurned, double offset, double factor) {
    return [=](uint32_t x, uint32_t y) {
      const double u = 3.0 * (x + 0.5) / 24.0, v = 2.0 * (15.5 - y) / 16.0;
      const double s = (isTurned ? -v : u) + offset, t = isTurned ? u : v;
      const bool isFirst = (s - std::floor(s) > 0.5) == (t - std::floor(t) > 0.5);
      return factor * kLight * (isFirst ? glm::dvec3(0.8, 0.2, 0.4) : glm::dvec3(0.1, 0.5, 0.3));
    };
  };
  expectPixels(scene, truth(true, 0.25, 1.0),
               {{"not turned", truth(false, 0.25, 1.0)},
                {"not moved", truth(true, 0.0, 1.0)},
                {"light + 2 %", truth(true, 0.25, 1.02)}});
}

// Heights that rise along u, on 24 metres: a slope of a half, which turns Lambert's cosine from
// 0.8. At the ends of the ramp the texture is clamped.
TEST(MitsubaTruths, ABumpMapTurnsTheNormal) {
  std::vector<uint8_t> ramp;
  for (int i = 0; i < 256; ++i) ramp.insert(ramp.end(), 3, uint8_t(i));
  for (const bool isMirrored : {false, true}) {
    KnownScene scene{.name = isMirrored ? "bump map, mirrored" : "bump map",
                     .xml = parallelView(fmt::format(
                         "<shape type=\"rectangle\"><transform name=\"to_world\"><scale "
                         "x=\"{}\" y=\"8\"/></transform><bsdf type=\"bumpmap\"><texture "
                         "type=\"bitmap\"><string name=\"filename\" value=\"ramp.png\"/><boolean "
                         "name=\"raw\" value=\"true\"/><string name=\"wrap_mode\" "
                         "value=\"clamp\"/></texture><float name=\"scale\" value=\"12\"/>{}"
                         "</bsdf></shape>",
                         isMirrored ? -12 : 12, diffuse("0.5"))),
                     .rounding = 1e-2};  // normals have bytes
    scene.files = {{"ramp.png", encodePng("ramp.png", 256, 1, ramp.data(), {}, 3)}};
    const auto truth = [=](double slope) {
      return [=](uint32_t x, uint32_t) {
        if (x == 0 || x == 23) return glm::dvec3(std::nan(""));
        const double s = isMirrored ? -slope : slope;
        const double cosine = (0.6 * s + 0.8) / std::sqrt(1.0 + s * s);
        return glm::dvec3(0.5 * cosine / kPiOfSurfaces);
      };
    };
    expectPixels(scene, truth(0.5 * 256.0 / 255.0),
                 {{"flat", truth(0.0)}, {"falls along u", truth(-0.5)}});
  }
}

// Lamps of every kind under mirrored transforms shine outwards, and flat ones along +Z.
TEST(MitsubaTruths, MirroredLampsShineOnTheirFront) {
  std::string shapes;
  const std::array<const char*, 6> mirrors{
      "<scale x=\"-1\" y=\"1\" z=\"1\"/>",  "<scale x=\"1\" y=\"-1\" z=\"1\"/>",
      "<scale x=\"-1\" y=\"-1\" z=\"1\"/>", "<scale x=\"1\" y=\"1\" z=\"-1\"/>",
      "<scale x=\"-1\" y=\"1\" z=\"-1\"/>", "<scale x=\"-1\" y=\"-1\" z=\"-1\"/>"};
  const std::array<const char*, 4> kinds{"rectangle", "disk", "sphere", "cube"};
  for (size_t i = 0; i < mirrors.size(); ++i)
    for (size_t j = 0; j < kinds.size(); ++j)
      shapes += fmt::format(
          "<shape type=\"{}\"><transform name=\"to_world\">{}<scale value=\"1.9\"/><translate "
          "x=\"{}\" y=\"{}\"/></transform>{}<emitter type=\"area\">{}</emitter></shape>",
          kinds[j], mirrors[i], -10.0 + 4.0 * double(i), 6.0 - 4.0 * double(j), diffuse("0"),
          rgb("radiance", "1 2 3"));
  const KnownScene scene{.name = "mirrored lamps", .xml = parallelView(shapes)};
  const auto truth = [](bool shinesBack, double factor) {
    return [=](uint32_t x, uint32_t y) {
      const bool isMiddle = (x % 4 == 1 || x % 4 == 2) && (y % 4 == 1 || y % 4 == 2);
      if (!isMiddle) return glm::dvec3(std::nan(""));
      // A flat lamp whose Z is mirrored shines away from the camera.
      const bool isDark = y < 8 && x >= 12;
      return isDark && !shinesBack ? glm::dvec3(0.0) : factor * glm::dvec3(1, 2, 3);
    };
  };
  expectPixels(scene, truth(false, 1.0),
               {{"both sides", truth(true, 1.0)}, {"radiance + 2 %", truth(false, 1.02)}});
}

}  // namespace
}  // namespace restlab::gates
