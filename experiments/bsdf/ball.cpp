#include <algorithm>

#include "core/frame/session.h"
#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/compiled/compiled_scene.h"
#include "experiments/bsdf/polar.h"

namespace restlab {
namespace {

using builtin::lambert;

Scene ballScene(const SceneMaterial& material, const Scene& images) {
  builtin::SceneBuilder builder("ball");
  // Parts of mixtures, by their index.
  for (const SceneMaterial& part : images.materials) builder.addMaterial(part.name, part.data);
  const uint32_t ball = builder.addMaterial("ball", material.data);
  builder.add(builtin::sphere("ball", {0.0, 1.0, 0.0}, 1.0, 5), ball);
  builder.add(builtin::quad("floor", {-6.0, 0.0, 6.0}, {12.0, 0.0, 0.0}, {0.0, 0.0, -12.0}),
              builder.addMaterial("floor", lambert(glm::vec3(0.4f))));
  builder.add(builtin::quad("window", {-4.0, 1.0, -1.5}, {0.0, 3.0, 0.0}, {0.0, 0.0, 3.0}),
              builder.addMaterial("window", builtin::lamp(glm::vec3(5.0f, 4.8f, 4.4f))));
  builder.add(builtin::quad("lamp", {1.6, 4.0, 1.4}, {0.5, 0.0, 0.0}, {0.0, 0.0, 0.5}),
              builder.addMaterial("lamp", builtin::lamp(glm::vec3(60.0f))));
  EnvironmentMap sky;
  sky.source = "sky";
  sky.width = 2;
  sky.height = 1;
  sky.radiance = {glm::vec3(0.25f, 0.3f, 0.4f), glm::vec3(0.25f, 0.3f, 0.4f)};
  builder.setEnvironment(sky);
  builder.addCamera("camera", {0.0, 1.7, 4.6}, {0.0, 0.95, 0.0}, 34.0);
  Scene scene = builder.finish();
  scene.images = images.images;
  scene.textureUses = images.textureUses;
  scene.tables = images.tables;
  std::copy(images.materials.begin(), images.materials.end(), scene.materials.begin());
  scene.materials[ball] = material;
  return scene;
}

}  // namespace

Image renderBall(const SceneMaterial& material, const Scene& images, uint32_t size, uint32_t spp) {
  SessionConfig config;
  config.integrator = "path";
  config.width = config.height = size;
  Session session(CompiledScene::build(ballScene(material, images)), config);
  Image sum(size, size);
  for (uint32_t frame = 0; frame < spp; ++frame) {
    session.frame();
    const Image& image = session.radiance();
    for (size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += image.pixels[i];
  }
  for (auto& pixel : sum.pixels) pixel *= 1.0f / float(spp);
  return sum;
}

}  // namespace restlab
