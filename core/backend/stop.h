// Ends frames of every session of this process in their middle: SIGINT must not wait for a frame
// that takes minutes. One session's frames are ended by Backend::stopWhere().
#pragma once

#include "core/base/error.h"

namespace restlab {

// Skips tiles and workgroups that have not begun, from now on. Safe in a signal handler.
void stopFrames() noexcept;
// Lets frames run again, in a program that goes on after a signal. No frame may be under way.
void resumeFrames() noexcept;
bool framesStopped() noexcept;

// Thrown by a stopped frame: its image and its session's buffers hold no whole frame.
class FrameStopped : public Error {
 public:
  FrameStopped()
      : Error(ExitCode::interrupted, "interrupted: the image is not finished and was not written") {
  }
};

}  // namespace restlab
