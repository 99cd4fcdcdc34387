// restlab.Session: a session, its scene and its camera, for one thread at a time.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <unistd.h>

#include <atomic>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/frame/session.h"
#include "experiments/python/reference.h"
#include "experiments/python/settings.h"
#include "experiments/runner/base/health_sum.h"

namespace restlab::python {

// Every member throws Error (badUsage) while another thread is in one, and in a forked process.
class ScriptSession {
 public:
  // Throws Error as settingsOf(), prepareScene() and Session do.
  ScriptSession(const pybind11::handle& scene, const pybind11::kwargs& keywords);
  ~ScriptSession();
  ScriptSession(const ScriptSession&) = delete;
  ScriptSession& operator=(const ScriptSession&) = delete;

  FrameStats frame();
  std::vector<FrameStats> frames(uint32_t count);
  // Image of the last frame, without a copy. Throws Error (badUsage) before the first one.
  pybind11::array radiance();
  pybind11::array aov(const std::string& name);
  std::vector<std::string> aovNames();
  pybind11::list layers();

  pybind11::dict parameters();
  // Returns whether the history starts anew.
  bool setParameters(const pybind11::kwargs& parameters);
  pybind11::dict settings();
  std::map<std::string, std::string> metadata();

  std::vector<std::string> cameras();
  pybind11::dict camera();
  // Sets a camera of the scene by name or index, if one is given, and changes what the keywords
  // say.
  void setCamera(const pybind11::object& nameOrIndex, const pybind11::kwargs& keywords);

  void reset(const std::optional<uint32_t>& seed, uint32_t firstFrame);
  void resize(uint32_t width, uint32_t height);
  pybind11::dict probe(uint32_t x, uint32_t y);
  // The reference of this picture, with its camera. The session is free meanwhile.
  std::shared_ptr<const Reference> reference(const ReferenceWish& wish);

  // Frames of this history, and their sums.
  uint64_t frameCount();
  double timeMs();
  HealthSum health();

  std::string device();
  std::string words();  // for repr()

 private:
  class Use;
  // Settings and camera of the last frame.
  struct Shown {
    SessionConfig config;
    SceneCamera camera;
  };
  // Runs `work` on the session without the interpreter's lock. A frame that was stopped leaves no
  // whole history: the next call starts a new one.
  template <class Work>
  auto run(const Work& work);
  void requireFrame(const char* what) const;
  void count(std::span<const FrameStats> all);
  void beginHistory();
  void breakHistory();
  void applyCamera();

  const pid_t process_ = getpid();
  PreparedScene prepared_;
  SceneCamera camera_;
  std::unique_ptr<Session> session_;
  std::atomic<bool> isUsed_ = false;
  bool isBroken_ = false;  // a frame was stopped
  uint64_t frames_ = 0, firstFrame_ = 0;
  std::optional<Shown> shown_;  // none before the first frame of a history
  double timeMs_ = 0.0;
  HealthSum health_;
};

}  // namespace restlab::python
