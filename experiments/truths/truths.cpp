#include "experiments/truths/truths.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "core/scene/compiled/compiled_scene.h"
#include "experiments/truths/film.h"
#include "experiments/truths/floor.h"
#include "experiments/truths/furnace.h"
#include "experiments/truths/media.h"
#include "experiments/truths/quad_light.h"

namespace restlab::analytic {
namespace {

using Pixels = std::vector<glm::dvec3>;

Pixels constantImage(const ExactView& view, double radiance) {
  return Pixels(size_t(view.width) * view.height, glm::dvec3(radiance));
}

// Returns whether the eye is inside the room, which light of other rooms does not reach.
bool isInRoom(const Scene& furnace, const ExactView& view) {
  const glm::dvec3 eye(cameraOf(furnace, view).cameraToWorld[3]);
  const MeshGeometry& room = furnace.geometries.at(instanceNamed(furnace, "room").geometry);
  glm::dvec3 low(room.positions.front()), high(low);
  for (const glm::vec3& p : room.positions) {
    low = glm::min(low, glm::dvec3(p));
    high = glm::max(high, glm::dvec3(p));
  }
  return glm::all(glm::greaterThan(eye, low)) && glm::all(glm::lessThan(eye, high));
}

std::string whyNotFurnace(const Scene& scene, const ExactView& view) {
  return isInRoom(scene, view) ? "" : "from a camera outside the room";
}

// All surfaces of the room emit the same, switched or not.
Pixels furnaceImage(const Scene& scene, const ExactView& view) {
  const SceneMaterial& m = scene.materials.at(0);
  const double emission = double(m.data.emission.x) * double(m.lightFactor);
  return constantImage(
      view, furnaceRadiance(emission, double(m.data.baseColor.x), view.scatteringEvents));
}

std::string whyNotSphereFurnace(const Scene& scene, const ExactView& view) {
  if (view.scatteringEvents == 0) return "at 0 scattering events";
  const rl::Material& material = scene.materials.at(0).data;
  const bool isRough = material.metallic > 0.0f && hasRoughReflection(scene);
  if (isRough && !view.multiscatter) return "of rough metal without multiscatter = true";
  return "";
}

Pixels sphereFurnaceImage(const Scene& scene, const ExactView& view) {
  return constantImage(view, double(scene.environment->lightFactor));
}

std::string whyNotShapeFurnace(const Scene& scene, const ExactView& view) {
  if (scene.environment->lightFactor != scene.materials.at(0).lightFactor)
    return "of lights of which some are switched";
  // The light behind the n-th event is at most 2^-(n + 1).
  return view.scatteringEvents < 16 ? "at less than 16 scattering events" : "";
}

Pixels shapeFurnaceImage(const Scene& scene, const ExactView& view) {
  return constantImage(view, double(scene.environment->lightFactor));
}

struct Truth {
  const char* scene;
  std::string (*whyNot)(const Scene&, const ExactView&);
  Pixels (*image)(const Scene&, const ExactView&);
};

constexpr std::array<Truth, 6> kTruths{{{"furnace", whyNotFurnace, furnaceImage},
                                        {"sphere-furnace", whyNotSphereFurnace, sphereFurnaceImage},
                                        {"shape-furnace", whyNotShapeFurnace, shapeFurnaceImage},
                                        {"floor", whyNotFloor, floorImage},
                                        {"media", whyNotMedia, mediaImage},
                                        {"quad-light", whyNotQuadLight, quadLightImage}}};

const Truth* truthOf(const Scene& scene) {
  if (!scene.source.empty()) return nullptr;
  const std::string base = scene.name.substr(0, scene.name.find('?'));
  for (const Truth& truth : kTruths) {
    if (base == truth.scene) return &truth;
  }
  return nullptr;
}

}  // namespace

const std::vector<std::string>& exactSceneNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Truth& truth : kTruths) all.push_back(truth.scene);
    return all;
  }();
  return names;
}

std::string whyNotExact(const Scene& scene, const ExactView& view) {
  if (const Truth* truth = truthOf(scene)) return truth->whyNot(scene, view);
  std::string known;
  for (const std::string& name : exactSceneNames()) known += (known.empty() ? "" : ", ") + name;
  return "(scenes that have one: " + known + ")";
}

std::vector<glm::dvec3> exactImage(const Scene& scene, const ExactView& view) {
  const std::string why = whyNotExact(scene, view);
  if (!why.empty()) throw std::invalid_argument("no exact image of '" + scene.name + "' " + why);
  return truthOf(scene)->image(scene, view);
}

}  // namespace restlab::analytic
