#include "experiments/python/session.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/frame/method.h"
#include "experiments/python/arrays.h"
#include "experiments/python/call.h"
#include "experiments/python/camera.h"
#include "experiments/python/values.h"
#include "experiments/runner/base/build_info.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/suite/backend_choice.h"
#include "experiments/runner/suite/image_settings.h"
#include "experiments/view/probe_values.h"

namespace restlab::python {

namespace py = pybind11;

// RAII: marks the session as used by one call.
class ScriptSession::Use {
 public:
  explicit Use(ScriptSession& session) : session_(session) {
    if (session_.process_ != getpid())
      failUsage("Session: was opened before this process was forked; open another one here");
    if (session_.isUsed_.exchange(true)) {
      failUsage(
          "Session: is used by another thread at this moment; a session serves one thread at a "
          "time, and each thread may open its own");
    }
  }
  ~Use() { session_.isUsed_ = false; }
  Use(const Use&) = delete;
  Use& operator=(const Use&) = delete;

 private:
  ScriptSession& session_;
};

template <class Work>
auto ScriptSession::run(const Work& work) {
  try {
    return rendering([&] {
      if (isBroken_) {
        session_->resize(session_->config().width, session_->config().height);
        applyCamera();
        isBroken_ = false;
      }
      return work();
    });
  } catch (const Error& error) {
    if (error.code() == ExitCode::interrupted) breakHistory();
    throw;
  } catch (const py::error_already_set&) {  // also where the frame ended before it was stopped
    breakHistory();
    throw;
  }
}

void ScriptSession::breakHistory() {
  isBroken_ = true;
  beginHistory();
}

ScriptSession::ScriptSession(const py::handle& scene, const py::kwargs& keywords) {
  Settings settings = settingsOf(scene, keywords);
  rendering([&] {
    prepared_ = prepare(settings);
    session_ = std::make_unique<Session>(prepared_.scene, settings.config);
    logStartup(*session_);
  });
  camera_ = prepared_.scene->source().cameras.at(prepared_.camera);
}

ScriptSession::~ScriptSession() {
  // Threads of a device are not in a forked process, and would be waited for.
  if (process_ != getpid()) static_cast<void>(session_.release());
}

void ScriptSession::beginHistory() {
  frames_ = 0;
  firstFrame_ = 0;
  shown_.reset();
  timeMs_ = 0.0;
  health_ = {};
}

void ScriptSession::applyCamera() { session_->setCamera(camera_); }

void ScriptSession::count(std::span<const FrameStats> all) {
  if (all.empty()) return;
  frames_ += all.size();
  for (const FrameStats& stats : all) {
    timeMs_ += stats.timeMs;
    health_.add(stats);
  }
  shown_ = {session_->config(), camera_};
}

FrameStats ScriptSession::frame() {
  const Use use(*this);
  const FrameStats stats = run([&] { return session_->frame(); });
  count({&stats, 1});
  return stats;
}

std::vector<FrameStats> ScriptSession::frames(uint32_t number) {
  const Use use(*this);
  const std::vector<FrameStats> all = run([&] { return session_->frames(number); });
  count(all);
  return all;
}

void ScriptSession::requireFrame(const char* what) const {
  if (frames_ == 0)
    failUsage(fmt::format("{}: this history has no frame yet; call frame() first", what));
}

py::array ScriptSession::radiance() {
  const Use use(*this);
  requireFrame("radiance");
  return arrayOf(withoutPython([&] { return session_->sharedRadiance(); }));
}

py::array ScriptSession::aov(const std::string& name) {
  const Use use(*this);
  requireFrame("aov");
  if (name == "radiance") return arrayOf(withoutPython([&] { return session_->sharedRadiance(); }));
  return arrayOf(run([&] { return session_->aov(name); }));
}

std::vector<std::string> ScriptSession::aovNames() {
  const Use use(*this);
  return findMethod(session_->config()).aovNames();
}

py::list ScriptSession::layers() {
  const Use use(*this);
  py::list all;
  for (const LayerInfo* layer : findMethod(session_->config()).layers()) {
    py::dict words;
    words["name"] = strOf(layer->name);
    words["unit"] = strOf(layer->unit);
    words["help"] = strOf(layer->summary);
    all.append(words);
  }
  return all;
}

py::dict ScriptSession::parameters() {
  const Use use(*this);
  py::dict all;
  for (const auto& [name, value] : session_->config().parameters)
    all[strOf(name)] = objectOf(value);
  return all;
}

bool ScriptSession::setParameters(const py::kwargs& given) {
  const Use use(*this);
  const ParameterMap parameters = parametersOf(given);
  return run([&] {
    try {
      const bool isNew = session_->setParameters(parameters);
      if (isNew) beginHistory();
      return isNew;
    } catch (const Error& error) {
      // The old buffers were freed before the new ones did not fit.
      if (error.code() == ExitCode::deviceUnavailable) beginHistory();
      throw;
    }
  });
}

py::dict ScriptSession::settings() {
  const Use use(*this);
  py::dict all = settingsDict(session_->config());
  all["scene"] = strOf(prepared_.scene->source().name);
  return all;
}

std::map<std::string, std::string> ScriptSession::metadata() {
  const Use use(*this);
  const Shown shown = shown_.value_or(Shown{session_->config(), camera_});
  std::map<std::string, std::string> words = describe(prepared_, shown.config);
  const SceneCamera& own = prepared_.scene->source().cameras.at(prepared_.camera);
  if (cameraWords(own) != cameraWords(shown.camera)) describeCamera(shown.camera, words);
  words["device"] = session_->device();
  words["ray_tracing"] = session_->rayTracing();
  words.merge(provenanceWords());
  words["kind"] = "image";
  words["seed"] = std::to_string(shown.config.seed);
  if (frames_ > 0) words["frame"] = std::to_string(firstFrame_ + frames_ - 1);
  words["health"] = health_.text();
  return words;
}

std::vector<std::string> ScriptSession::cameras() {
  std::vector<std::string> names;
  for (const SceneCamera& camera : prepared_.scene->source().cameras) names.push_back(camera.name);
  return names;
}

py::dict ScriptSession::camera() {
  const Use use(*this);
  return cameraDict(camera_);
}

void ScriptSession::setCamera(const py::object& nameOrIndex, const py::kwargs& keywords) {
  const Use use(*this);
  const Scene& scene = prepared_.scene->source();
  SceneCamera camera = camera_;
  if (!nameOrIndex.is_none()) {
    camera = scene.cameras.at(findCamera(scene, nameOrIndexOf(nameOrIndex, "set_camera")));
  }
  camera_ = cameraWith(camera, keywords);
  run([&] { applyCamera(); });
}

void ScriptSession::reset(const std::optional<uint32_t>& seed, uint32_t firstFrame) {
  const Use use(*this);
  run([&] {
    session_->reset(seed.value_or(session_->config().seed), firstFrame);
    beginHistory();
    firstFrame_ = firstFrame;
  });
}

void ScriptSession::resize(uint32_t width, uint32_t height) {
  const Use use(*this);
  if (width < 1 || width > kMaxSide || height < 1 || height > kMaxSide)
    failUsage(fmt::format("resize {}x{}: both sides must be 1 to {}", width, height, kMaxSide));
  run([&] {
    beginHistory();  // also where the new size does not fit
    session_->resize(width, height);
    applyCamera();
  });
}

py::dict ScriptSession::probe(uint32_t x, uint32_t y) {
  const Use use(*this);
  requireFrame("probe");
  nlohmann::ordered_json json = {{"x", x}, {"y", y}};
  run([&] {
    json["values"] = probedValuesJson(*session_, x, y);
    json["path"] = probedPathJson(*session_, x, y);
    json["donors"] = probedDonorsJson(*session_, x, y);
  });
  return objectOf(json);
}

std::shared_ptr<const Reference> ScriptSession::reference(const ReferenceWish& wish) {
  ReferenceConfig config;
  {
    const Use use(*this);
    config = referenceConfigOf(session_->config());
    config.camera = camera_;
  }
  return obtain(prepared_, config, wish);
}

uint64_t ScriptSession::frameCount() {
  const Use use(*this);
  return frames_;
}

double ScriptSession::timeMs() {
  const Use use(*this);
  return timeMs_;
}

HealthSum ScriptSession::health() {
  const Use use(*this);
  return health_;
}

std::string ScriptSession::device() {
  const Use use(*this);
  return session_->device();
}

std::string ScriptSession::words() {
  const Use use(*this);
  const SessionConfig& config = session_->config();
  return fmt::format("<restlab.Session {}: {}{}{}{}, {}x{}, frame {}>",
                     prepared_.scene->source().name, config.integrator,
                     config.mode.empty() ? "" : " " + config.mode,
                     config.cache.empty() ? "" : " " + config.cache,
                     config.denoiser == "none" ? "" : " + " + config.denoiser, config.width,
                     config.height, frames_);
}

}  // namespace restlab::python
