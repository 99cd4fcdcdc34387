#include "experiments/runner/reference/truth.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/scene/builtin/name.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/files.h"
#include "experiments/runner/reference/reference_halves.h"
#include "experiments/runner/suite/image_settings.h"
#include "experiments/runner/suite/picture.h"
#include "experiments/truths/truths.h"

namespace restlab {

namespace {

// Metadata key; absent if a reference was rendered from the scene itself.
constexpr const char* kTruth = "truth";
constexpr const char* kClosedForm = "in closed form";

analytic::ExactView viewOf(const PreparedScene& plain, const ReferenceConfig& config) {
  return {.camera = plain.camera,
          .moved = config.camera,
          .width = config.width,
          .height = config.height,
          .scatteringEvents = config.maxBounces,
          .multiscatter = config.multiscatter};
}

void multiply(Image& image, double factor) {
  for (glm::vec3& pixel : image.pixels) pixel = glm::vec3(glm::dvec3(pixel) * factor);
}

}  // namespace

SceneRequest withoutRelations(SceneRequest request) {
  if (isBuiltinScene(request.scene)) request.scene = withoutRelations(request.scene);
  return request;
}

double radianceFactor(const std::string& scene) {
  if (!isBuiltinScene(scene)) return 1.0;
  return parseBuiltinName(scene).value(kRadianceParameter).value();
}

bool isElsewhere(const std::string& scene) {
  if (!isBuiltinScene(scene)) return false;
  const BuiltinName name = parseBuiltinName(scene);
  return name.value(kScaleParameter) != 1.0 || name.value(kMoveParameter) != 0.0;
}

std::string whyNoTruth(Truth truth, const SceneRequest& request, const PreparedScene& plain,
                       const ReferenceConfig& config) {
  if (truth == Truth::rendered) return "";
  const char* word = truth == Truth::exact ? "exact" : "same";
  const std::string name = fmt::format("'truth' is \"{}\", but", word);
  if (!isBuiltinScene(request.scene))
    return fmt::format("{} {} is no built-in scene", name, request.scene);
  if (truth == Truth::same) return "";
  if (!request.environment.empty() || request.environmentRotation || request.environmentScale)
    return fmt::format("{} the environment is not the scene's own", name);
  if (config.components != rl::RL_COMPONENT_ALL)
    return fmt::format("{} exact images are of the component all", name);
  if (config.pixelFilter != rl::RL_FILTER_BOX)
    return fmt::format("{} exact images are of the filter box", name);
  const std::string why = analytic::whyNotExact(plain.scene->source(), viewOf(plain, config));
  return why.empty() ? ""
                     : fmt::format("{} {} has no exact image {}", name,
                                   withoutRelations(request.scene), why);
}

PreparedScene plainOf(const Suite& suite, const SuiteScene& scene, const PreparedScene& prepared,
                      ReferenceConfig& config) {
  const SceneRequest request = withoutRelations(scene.request);
  PreparedScene plain = request.scene == scene.request.scene
                            ? prepared
                            : atPlace(scene.place, [&] { return prepareScene(request); });
  if (suite.hasMovingCamera()) {
    if (isElsewhere(scene.request.scene)) {
      failUsage(
          fmt::format("{}: 'truth' of a camera that moves is of a scene without 'scale' and "
                      "'move': paths are in its metres",
                      scene.truthPlace));
    }
    if (suite.temporal) {
      failUsage(fmt::format("{}: 'truth' is of one frame, but 'temporal' needs a second reference",
                            scene.truthPlace));
    }
    config.camera = cameraAt(*motionOf(suite, scene, plain), suite.warmupFrames);
  }
  plain = sceneAt(lightPhases(suite, plain), plain, suite.warmupFrames);
  const std::string why = whyNoTruth(scene.truth, scene.request, plain, config);
  if (!why.empty()) failUsage(fmt::format("{}: {}", scene.truthPlace, why));
  return plain;
}

Reference exactReference(const SceneRequest& request, const PreparedScene& plain,
                         const ReferenceConfig& config) {
  const std::vector<glm::dvec3> exact =
      analytic::exactImage(plain.scene->source(), viewOf(plain, config));
  const double factor = radianceFactor(request.scene);
  Reference reference;
  reference.mean = Image(config.width, config.height);
  for (size_t i = 0; i < exact.size(); ++i) reference.mean.pixels[i] = glm::vec3(exact[i] * factor);
  reference.half0 = reference.half1 = reference.mean;
  reference.metadata = describe(plain, referenceSession(plain, config));
  reference.metadata.merge(provenanceWords());
  reference.metadata["kind"] = "reference";
  reference.metadata["spp"] = "0";
  reference.metadata["relmse_estimate"] = reference.metadata["relmse_since_half"] = "0";
  reference.metadata["render_time_s"] = "0";
  reference.metadata[kTruth] = kClosedForm;
  return reference;
}

double exactError(const Reference& reference) {
  const auto truth = reference.metadata.find(kTruth);
  if (truth == reference.metadata.end() || truth->second != kClosedForm) return 0.0;
  float brightest = 0.0f;
  for (const glm::vec3& p : reference.mean.pixels) brightest = std::max({brightest, p.x, p.y, p.z});
  return analytic::kExactError * double(brightest);
}

Reference multiplied(Reference reference, double factor) {
  for (Image* image : {&reference.mean, &*reference.half0, &*reference.half1})
    multiply(*image, factor);
  if (reference.variance) multiply(*reference.variance, factor * factor);
  reference.metadata[kTruth] =
      fmt::format("of {}, times {:.9g}", reference.metadata["scene"], factor);
  return reference;
}

std::string plainLabel(const SceneRequest& request, const std::string& path,
                       const PreparedScene& plain, const ReferenceConfig& config) {
  std::string settings;
  for (const auto& [name, text] : transportTexts(config, true)) settings += "-" + text;
  return safeFileName(fmt::format("{}-{}-{}-{}-{}x{}{}{}", withoutRelations(request.scene),
                                  componentName(config.components), plain.cameraName, path,
                                  config.width, config.height, settings, kPlainReference));
}

std::string originOf(const Reference& reference) {
  const auto truth = reference.metadata.find(kTruth);
  const std::string samples =
      fmt::format("{} spp (relMSE {:.2g})", reference.spp, reference.relmse);
  if (truth == reference.metadata.end()) return samples;
  return reference.spp == 0 ? truth->second : fmt::format("{}, {}", truth->second, samples);
}

}  // namespace restlab
