// restlab info: prints the contents of a scene, the kernel features it needs, and the memory that
// each integrator needs.
#include <map>
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/scene/shapes/shape_info.h"
#include "core/scene/material_notes.h"
#include "core/base/error.h"
#include "core/scene/camera_path/camera_path.h"
#include "experiments/cli/info_materials.h"
#include "experiments/cli/options.h"
#include "experiments/cli/verbs.h"
#include "experiments/runner/base/print.h"

namespace restlab {

namespace {

using Json = nlohmann::ordered_json;

struct InfoOptions {
  SceneRequest request;
  TransportTexts transport;
  bool json = false;
};

const char* lightKind(uint32_t kind) {
  switch (kind) {
    case rl::RL_LIGHT_POINT:
      return "point";
    case rl::RL_LIGHT_SPOT:
      return "spot";
    case rl::RL_LIGHT_DIRECTIONAL:
      return "directional";
    default:
      return "light";
  }
}

// Lists all cameras, or the requested one.
Json camerasJson(const Scene& scene, std::optional<size_t> only) {
  Json cameras = Json::array();
  for (size_t index = 0; index < scene.cameras.size(); ++index) {
    if (only && *only != index) continue;
    const SceneCamera& camera = scene.cameras[index];
    const bool perspective = camera.kind == rl::RL_CAMERA_PERSPECTIVE;
    Json json = {{"index", index},
                 {"name", camera.name},
                 {"kind", perspective ? "perspective" : "orthographic"}};
    if (perspective) {
      json["yfov_radians"] = camera.yfov;
    } else {
      json["half_extent_m"] = {camera.xmag, camera.ymag};
    }
    json["aspect"] = camera.aspect;
    if (camera.shift != glm::dvec2(0.0)) json["shift"] = {camera.shift.x, camera.shift.y};
    if (camera.film.x > 0) json["film_pixels"] = {camera.film.x, camera.film.y};
    // Position, forward and up axis for other programs. Axes as in CompiledScene::camera,
    // normalised: a node may scale or shear.
    const glm::dmat3 axes(camera.cameraToWorld);
    const glm::dvec3 back = glm::normalize(axes[2]);
    const glm::dvec3 up = glm::normalize(glm::cross(back, axes[0]));
    const auto triple = [](const glm::dvec3& v) { return Json{v.x, v.y, v.z}; };
    json["position_m"] = triple(glm::dvec3(camera.cameraToWorld[3]));
    json["forward"] = triple(-back);
    json["up"] = triple(up);
    if (camera.isMirrored) json["mirrored"] = true;
    if (camera.znear > 0.0) json["near_m"] = camera.znear;
    json["warnings"] = cameraWarnings(scene, camera);
    cameras.push_back(json);
  }
  return cameras;
}

Json supportJson(const PreparedScene& prepared, bool multiscatter) {
  Json all = Json::array();
  for (const IntegratorInfo* info : integratorRegistry()) {
    SessionConfig config;
    config.integrator = info->name;
    config.camera = prepared.camera;
    config.multiscatter = multiscatter;
    config.width = config.height = 16;  // sizes below are per pixel
    config.threads = 1;
    config.renders = false;
    try {
      const Session session(prepared.scene, config);
      Json buffers = Json::object();
      for (const auto& [name, bytes] : session.bufferBytesPerPixel()) buffers[name] = bytes;
      all.push_back(
          {{"name", info->name},
           {"features_used", featureNames(session.featuresUsed())},
           {"features_left_out", featureNames(rl::RL_FEATURE_ALL & ~session.featuresUsed())},
           {"bytes_per_pixel", session.bytesPerPixel()},
           {"buffers", buffers}});
    } catch (const Error& error) {
      // A method may not take every scene.
      if (error.code() != ExitCode::badInput && error.code() != ExitCode::badUsage) throw;
      all.push_back({{"name", info->name}, {"refuses", error.what()}});
    }
  }
  return all;
}

Json sceneJson(const PreparedScene& prepared, const InfoOptions& options) {
  TransportSettings transport;
  applyTransport(options.transport, transport);
  const bool multiscatter = transport.multiscatter;
  std::optional<size_t> only;
  if (!options.request.camera.empty()) only = prepared.camera;
  const CompiledScene& compiled = *prepared.scene;
  const Scene& scene = compiled.source();
  const auto bounds = worldBounds(scene);
  Json json = {{"scene", scene.name},
               {"source", scene.source.empty() ? "built-in" : scene.source.string()},
               {"content_hash", hexHash(prepared.contentHash)},
               {"triangles", compiled.triangleCount()},
               {"instanced_triangles", compiled.instancedTriangleCount()},
               {"emissive_triangles", compiled.emissiveTriangleCount()},
               {"meshes", scene.geometries.size()},
               {"instances", scene.instances.size()},
               {"materials", scene.materials.size()},
               {"textures", scene.images.size()},
               {"cameras", camerasJson(scene, only)}};
  Json lights = Json::array();
  for (const PunctualLight& light : scene.lights) {
    lights.push_back({{"name", light.name},
                      {"kind", lightKind(light.kind)},
                      {"intensity", {light.intensity.x, light.intensity.y, light.intensity.z}}});
  }
  json["lights"] = lights;
  json["max_bounces"] = scene.maxBounces ? Json(*scene.maxBounces) : Json();
  json["closures"] = closuresOfScene(scene);
  json["variants"] = scene.variants;
  json["variant"] = scene.variant ? Json(*scene.variant) : Json();
  const auto triple = [](const glm::vec3& v) { return Json{v.x, v.y, v.z}; };
  json["ambient"] = triple(scene.ambient);
  json["background"] = scene.background ? triple(*scene.background) : Json();
  // Names for `objects` of a mask, whose numbers begin at 1.
  Json objects = Json::array();
  for (const MeshInstance& instance : scene.instances) objects.push_back(instance.name);
  json["objects"] = objects;
  if (scene.environment) {
    json["environment"] = {{"source", prepared.environmentName},
                           {"width", scene.environment->width},
                           {"height", scene.environment->height},
                           {"rotation_radians", scene.environment->rotation},
                           {"scale", scene.environment->scale}};
  } else {
    json["environment"] = nullptr;
  }
  json["bounds_m"] = {{bounds[0].x, bounds[0].y, bounds[0].z},
                      {bounds[1].x, bounds[1].y, bounds[1].z}};
  json["skipped_primitives"] = scene.skippedPrimitives;
  json["bytes"] = compiled.bytes();
  json["embree_bytes"] = compiled.embreeBytes();
  json["load_time_ms"] = prepared.loadTimeMs;
  json["features_needed"] = featureNames(compiled.features(multiscatter));
  json["integrators"] = supportJson(prepared, multiscatter);
  json["warnings"] = compiled.warnings();
  json["notes"] = scene.notes;
  for (const std::string& note : materialNotes(scene)) json["notes"].push_back(note);
  return json;
}

// How many instances of each kind of shape there are; nothing where all is made of triangles.
void printShapes(const Scene& scene) {
  std::map<std::string, size_t> counts;
  size_t undrawn = 0;
  for (const MeshInstance& instance : scene.instances) {
    const auto& shape = scene.geometries[instance.geometry].shape;
    if (shape == nullptr) continue;
    ++counts[shape->info->name];
    const bool emits = scene.materials[instance.material].data.emission != glm::vec3(0.0f);
    if (emits && !shape->info->hasDraws) ++undrawn;
  }
  if (counts.empty()) return;
  std::vector<std::string> kinds;
  for (const auto& [name, count] : counts) kinds.push_back(fmt::format("{} {}", count, name));
  print("shapes       {}{}\n", fmt::format("{}", fmt::join(kinds, ", ")),
        undrawn == 0 ? ""
                     : fmt::format("; {} emit and have no light samples: scattered rays find them",
                                   undrawn));
}

void printScene(const PreparedScene& prepared, const Json& json) {
  const Scene& scene = prepared.scene->source();
  const auto bounds = worldBounds(scene);
  print("scene        {} ({})\n", scene.name, json["source"].get<std::string>());
  print("triangles    {} stored, {} as seen by rays, {} emissive\n",
        prepared.scene->triangleCount(), prepared.scene->instancedTriangleCount(),
        prepared.scene->emissiveTriangleCount());
  printShapes(scene);
  print("objects      {} meshes, {} instances, {} materials, {} textures\n",
        scene.geometries.size(), scene.instances.size(), scene.materials.size(),
        scene.images.size());
  for (const std::string& variant : scene.variants)
    print("variant      '{}'{}\n", oneLine(variant), variant == scene.variant ? ", drawn" : "");
  for (const Json& camera : json["cameras"]) {
    const auto point = [&](const char* key) {
      const auto p = camera[key].get<std::array<double, 3>>();
      return fmt::format("({:.5g}, {:.5g}, {:.5g})", p[0], p[1], p[2]);
    };
    print("camera       {} '{}' {}, at {} m, looks along {}, up {}{}{}\n",
          camera["index"].get<size_t>(), oneLine(camera["name"].get<std::string>()),
          camera["kind"].get<std::string>(), point("position_m"), point("forward"), point("up"),
          camera.contains("yfov_radians")
              ? fmt::format(", {:.4g} degrees high",
                            glm::degrees(camera["yfov_radians"].get<double>()))
              : "",
          camera.contains("mirrored") ? ", mirrored left to right" : "");
    if (camera.contains("film_pixels"))
      print("{:<12} a film of {}x{} pixels\n", "", camera["film_pixels"][0].get<uint32_t>(),
            camera["film_pixels"][1].get<uint32_t>());
    for (const Json& warning : camera["warnings"])
      print("{:<12} {}\n", "", warning.get<std::string>());
  }
  if (scene.maxBounces) print("max_bounces  {} unless given\n", *scene.maxBounces);
  for (const PunctualLight& light : scene.lights) {
    print("light        '{}' {} ({:g}, {:g}, {:g})\n", oneLine(light.name), lightKind(light.kind),
          light.intensity.x, light.intensity.y, light.intensity.z);
  }
  const auto printRadiance = [](const char* what, const glm::vec3& v) {
    print("{:<12} ({:g}, {:g}, {:g}) W sr^-1 m^-2\n", what, v.x, v.y, v.z);
  };
  if (scene.ambient != glm::vec3(0.0f)) printRadiance("ambient", scene.ambient);
  if (scene.background) printRadiance("background", *scene.background);
  for (const Json& closure : json["closures"])
    print("material     {}\n", oneLine(closureLine(closure)));
  if (scene.environment) {
    print("environment  {} {}x{}, rotation {:g} rad, scale {:g}\n", prepared.environmentName,
          scene.environment->width, scene.environment->height, scene.environment->rotation,
          scene.environment->scale);
  } else {
    print("environment  none\n");
  }
  print("bounds       ({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g}) m\n", bounds[0].x, bounds[0].y,
        bounds[0].z, bounds[1].x, bounds[1].y, bounds[1].z);
  constexpr double kMiB = 1024.0 * 1024.0;
  print("memory       {:.1f} MiB of buffers, {:.1f} MiB of Embree, loaded in {:.0f} ms\n",
        double(prepared.scene->bytes()) / kMiB, double(prepared.scene->embreeBytes()) / kMiB,
        prepared.loadTimeMs);
  print("features     needed    {}\n", json["features_needed"].get<std::string>());
  for (const Json& integrator : json["integrators"]) {
    if (integrator.contains("refuses")) {
      print("{:<12} refuses   {}\n", integrator["name"].get<std::string>(),
            integrator["refuses"].get<std::string>());
      continue;
    }
    print("{:<12} compiled  {}\n", integrator["name"].get<std::string>(),
          integrator["features_used"].get<std::string>());
    print("{:<12} left out  {}\n", "", integrator["features_left_out"].get<std::string>());
    std::string buffers;
    for (const auto& [name, bytes] : integrator["buffers"].items()) {
      buffers += fmt::format("{}{} {}", buffers.empty() ? "" : ", ", name, bytes.get<size_t>());
    }
    print("{:<12} bytes per pixel {} ({})\n", "", integrator["bytes_per_pixel"].get<size_t>(),
          buffers);
  }
}

void info(const InfoOptions& options) {
  const PreparedScene prepared = prepareScene(options.request);
  printWarnings(prepared);
  const Json json = sceneJson(prepared, options);
  if (options.json) {
    printJsonText(json.dump(2, ' ', false, Json::error_handler_t::replace));
  } else {
    printScene(prepared, json);
  }
}

}  // namespace

Action addInfoVerb(CLI::App& app) {
  auto options = std::make_shared<InfoOptions>();
  CLI::App* verb = app.add_subcommand("info", "what a scene holds and needs");
  verb->add_option("scene", options->request.scene,
                   "a glTF, Mitsuba or scene file or a built-in scene")
      ->required();
  addSceneSettings(*verb, options->request.scene);
  verb->add_option("--camera", options->request.camera,
                   "name or index of the camera to show (default: all of them)");
  verb->add_option("--environment", options->request.environment,
                   "latitude-longitude .hdr or .exr");
  addTransport(*verb, options->transport,
               [](const ParameterInfo& setting) { return setting.name == "multiscatter"; });
  verb->add_flag("--json", options->json, "JSON on stdout");
  return [options](Outcome&) { info(*options); };
}

}  // namespace restlab
