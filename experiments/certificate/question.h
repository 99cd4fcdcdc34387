// Subject of a certificate: a scene, a method, and the frames that count.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/frame/session.h"
#include "core/scene/camera_path/camera_path.h"
#include "experiments/runner/reference/reference.h"
#include "experiments/runner/suite/light_events.h"
#include "experiments/runner/suite/prepare.h"

namespace restlab::certificate {

// A run has its own history and is the mean of the frames warmup .. warmup + frames - 1. Every
// frame of an unbiased method has the right mean, so the mean of frames is as good an observation
// as a single one, and less noisy, also where each frame has another view. Consecutive frames are
// correlated and are no separate observations (docs/laboratory.md).
struct Question {
  SceneRequest request;  // that `prepared` was made from
  PreparedScene prepared;
  SessionConfig config;  // complete; its seed is the base of all seeds
  uint32_t warmup = 0, frames = 1;
  std::string name;                    // of the scene, in tables and file names; "": its own name
  std::optional<CameraMotion> motion;  // absent: every frame has the scene's camera
  std::vector<LightPhase> lights;      // empty: lights as loaded in every frame
  // Says what changes, as part of names and of what identifies a run: "orbit", "lamp x0 from frame
  // 8"; "" if nothing does.
  std::string change;
  std::string against = "path";    // integrator that renders the reference
  std::optional<Reference> exact;  // if the image is known without rendering

  bool changes() const { return motion.has_value() || !lights.empty(); }
};

// A view and light that some of the counted frames have.
struct CountedView {
  const PreparedScene* prepared = nullptr;  // inside the question
  std::optional<SceneCamera> camera;        // absent: the scene's
  uint32_t firstFrame = 0, frames = 0;
};

// Returns the views of the counted frames, in their order; frames that follow one another with the
// same view and light share one.
std::vector<CountedView> countedViews(const Question& question);

// Returns whether a light is switched between the first frame and the last counted one.
bool lightChanges(const Question& question);

// Sets view and light of a frame.
void enterFrame(const Question& question, uint32_t frame, Session& session);

}  // namespace restlab::certificate
