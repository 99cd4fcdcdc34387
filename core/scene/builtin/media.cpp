// A camera inside an absorbing body, in front of two more bodies in that body that overlap, under a
// white sky. Every index of refraction is 1 and the camera is orthographic: paths go straight, and
// each pixel is a product of Beer-Lambert transmittances (experiments/truths/media.cpp).
#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/builtin/scenes.h"

namespace restlab::builtin {
namespace {

rl::Material tinted(const glm::vec3& sigma) {
  rl::Material m = glass(0.0f, sigma);
  m.ior = 1.0f;
  return m;
}

MeshGeometry slab(const char* name, double halfWidth, double nearZ, double farZ) {
  return box(name, {-halfWidth, -halfWidth, farZ}, {halfWidth, halfWidth, nearZ});
}

}  // namespace

Scene makeMedia(const MediaShape& shape) {
  SceneBuilder builder("media");
  builder.add(slab("around", 6.0, 2.0, -4.0),
              builder.addMaterial("around", tinted({0.1f, 0.2f, 0.4f})));
  builder.add(slab("near", 4.0, -1.0, -2.0),
              builder.addMaterial("near", tinted({0.9f, 0.3f, 0.1f})));
  const uint32_t far = builder.addMaterial("far", tinted({0.2f, 1.2f, 0.6f}));
  builder.add(slab("far", 4.0, -2.0 + shape.overlap, -3.0), far);
  EnvironmentMap sky;
  sky.source = "built-in";
  sky.width = 2;
  sky.height = 1;
  sky.radiance.assign(2, glm::vec3(1.0f));
  builder.setEnvironment(sky);
  Scene scene = builder.finish();
  scene.materials[far].priority = shape.priority;
  SceneCamera camera;
  camera.name = "inside";
  camera.kind = rl::RL_CAMERA_ORTHOGRAPHIC;
  camera.xmag = camera.ymag = 1.0;
  scene.cameras = {camera};
  scene.contentHash = hashOf(scene);
  return scene;
}

}  // namespace restlab::builtin
