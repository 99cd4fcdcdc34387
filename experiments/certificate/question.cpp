#include "experiments/certificate/question.h"

#include <algorithm>

namespace restlab::certificate {

std::vector<CountedView> countedViews(const Question& question) {
  std::vector<CountedView> views;
  for (uint32_t frame = question.warmup; frame < question.warmup + question.frames; ++frame) {
    const PreparedScene* prepared = &sceneAt(question.lights, question.prepared, frame);
    std::optional<SceneCamera> camera;
    if (question.motion) camera = cameraAt(*question.motion, frame);
    const bool isNew = views.empty() || views.back().prepared->scene != prepared->scene ||
                       (camera && cameraWords(*camera) != cameraWords(*views.back().camera));
    if (isNew) views.push_back({prepared, camera, frame, 0});
    ++views.back().frames;
  }
  return views;
}

bool lightChanges(const Question& question) {
  return std::any_of(question.lights.begin(), question.lights.end(), [&](const LightPhase& phase) {
    return phase.firstFrame > 0 && phase.firstFrame < question.warmup + question.frames;
  });
}

void enterFrame(const Question& question, uint32_t frame, Session& session) {
  if (!question.lights.empty())
    session.setScene(sceneAt(question.lights, question.prepared, frame).scene);
  if (question.motion) session.setCamera(cameraAt(*question.motion, frame));
}

}  // namespace restlab::certificate
