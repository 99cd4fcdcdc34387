// loadMitsuba(): runs the parts of the reader in order.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <new>
#include <optional>

#include "core/base/error.h"
#include "core/scene/mitsuba/emitters.h"
#include "core/scene/mitsuba/mitsuba.h"
#include "core/scene/mitsuba/sensor.h"
#include "core/scene/mitsuba/shapes.h"

namespace restlab {
namespace fs = std::filesystem;
namespace mitsuba {
namespace {

constexpr int64_t kMostBounces = 1024;
constexpr const char* kAllowUnknown = "allow_unknown";

// Settings behind the '?' of a name.
struct Settings {
  Definitions definitions;
  bool allowsUnknown = false;
};

Settings settingsOf(const std::string& text, const fs::path& file) {
  Settings settings;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('&', begin), text.size());
    const std::string one = text.substr(begin, end - begin);
    begin = end + 1;
    const size_t equals = one.find('=');
    const std::string place = file.string() + "?" + one;
    if (equals == std::string::npos || equals == 0)
      failInput(place + ": must be NAME=VALUE, the value of a $NAME");
    const std::string name = one.substr(0, equals), value = one.substr(equals + 1);
    if (name == kAllowUnknown) {
      if (value != "0" && value != "1") failInput(place + ": 0 or 1 expected");
      settings.allowsUnknown = value == "1";
    } else if (!settings.definitions.emplace(name, value).second) {
      failInput(place + ": is defined twice");
    }
  }
  return settings;
}

// Scattering events of its paths; nullopt: no limit, or an integrator of another kind.
std::optional<uint32_t> bouncesOf(const Element& element, const Context& context, int depth = 0) {
  Parameters p(element, context);
  if (element.type == "direct") return 1;
  if (const int64_t segments = p.integer("max_depth", -1, -1, 1 << 30); segments >= 0)
    return uint32_t(std::clamp<int64_t>(segments - 1, 0, kMostBounces));
  const std::vector<const Element*> inner = p.plugins("integrator");
  if (inner.empty() || depth > 8) return {};
  return bouncesOf(*inner[0], context, depth + 1);
}

void readIntegrator(const Element& element, const Context& context) {
  Parameters p(element, context);
  context.scene.maxBounces = bouncesOf(element, context);
  std::string text =
      fmt::format("integrator '{}' is not read: --integrator chooses the method", element.type);
  text += context.scene.maxBounces
              ? fmt::format("; its paths have {} bounces, unless --max-bounces says otherwise",
                            *context.scene.maxBounces)
              : "; its paths have no max_depth, those here have --max-bounces";
  context.report.note("integrator", element.place, text);
  if (p.boolean("hide_emitters", false))
    context.report.warn("hidden emitters", element.place,
                        "hide_emitters is not read: the camera sees lamps and surroundings");
}

bool isBlind(const std::string& tag) {
  return tag == "bsdf" || tag == "texture" || tag == "spectrum" || tag == "alias" || tag == "rgb" ||
         tag == "transform" || tag == "sampler" || tag == "film" || tag == "rfilter" ||
         tag == "float" || tag == "integer" || tag == "string" || tag == "boolean";
}

void readChild(const Element& child, const Context& context, Shapes& shapes) {
  if (child.tag == "shape") return shapes.add(child);
  if (child.tag == "emitter" || child.tag == "luminaire") return addEmitter(child, context);
  if (child.tag == "sensor" || child.tag == "camera") return addSensor(child, context);
  if (child.tag == "integrator") return readIntegrator(child, context);
  if (child.tag == "ref" || isBlind(child.tag)) return;  // read where something refers to it
  const std::string text = fmt::format(
      "<{}> is unknown here; shape, emitter, sensor, bsdf, texture, integrator, include, "
      "default, alias or path expected",
      child.tag);
  if (!context.allowsUnknown) context.report.fail(child.place, text);
  context.report.warn("unknown element", child.place, text + "; it is left out");
}

void addDefaultCamera(Scene& scene, const fs::path& file, Report& report) {
  if (!scene.cameras.empty()) return;
  scene.cameras.push_back(framingCamera(scene));
  report.note("no sensor", file.string(), "has no sensor; the camera shows the whole scene");
}

Scene read(const fs::path& file, const std::string& text, Report& report) {
  const Settings settings = settingsOf(text, file);
  Scene scene;
  scene.name = file.stem().string() + (text.empty() ? "" : "?" + text);
  scene.source = file;
  Files files(file.parent_path(), report);
  const Document document(file, settings.definitions, files, report);
  const Context context{document, files, report, scene, settings.allowsUnknown};
  Textures textures(context);
  Bsdfs bsdfs(context, textures, file.parent_path());
  Shapes shapes(context, textures, bsdfs);
  const Element* integrator = nullptr;
  for (const Element& child : document.scene().children) {
    if (child.tag == "integrator") {
      if (integrator != nullptr)
        report.fail(child.place, fmt::format("a second <integrator>, the first is at {}; one of "
                                             "them expected",
                                             integrator->place));
      integrator = &child;
    }
    readChild(child, context, shapes);
  }
  addDefaultCamera(scene, file, report);
  if (scene.instances.empty()) report.warn("empty scene", file.string(), "holds no shape");
  for (const SceneMaterial& material : scene.materials)
    if (!std::isfinite(material.data.emission.x + material.data.emission.y +
                       material.data.emission.z))
      report.fail(file.string(), fmt::format("the radiance of '{}' is too large", material.name));
  files.hash(text);
  scene.contentHash = files.contentHash();
  return scene;
}

}  // namespace
}  // namespace mitsuba

std::optional<uint32_t> bouncesOfMitsuba(const fs::path& file, const std::string& settings) {
  using namespace mitsuba;
  Report report;
  Scene scene;
  Files files(file.parent_path(), report);
  const Document document(file, settingsOf(settings, file).definitions, files, report);
  const Context context{document, files, report, scene};
  for (const Element& child : document.scene().children)
    if (child.tag == "integrator") return bouncesOf(child, context);
  return {};
}

bool isMitsubaFile(const fs::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension == ".xml";
}

bool isMitsubaScene(const fs::path& file) {
  if (!isMitsubaFile(file)) return false;
  std::ifstream stream(file, std::ios::binary);
  std::string start(4096, '\0');
  stream.read(start.data(), std::streamsize(start.size()));
  return start.find("<scene") != std::string::npos;
}

Scene loadMitsuba(const fs::path& file, const std::string& settings) {
  mitsuba::Report report;
  try {
    Scene scene = mitsuba::read(file, settings, report);
    scene.warnings = report.warnings();
    scene.notes = report.notes();
    return scene;
  } catch (const std::bad_alloc&) {
    throw Error(ExitCode::deviceUnavailable, file.string() + ": not enough memory for this scene");
  }
}

}  // namespace restlab
