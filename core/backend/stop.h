// Ends frames of every session of this process in their middle: SIGINT must not wait for a frame
// that takes minutes. One session's frames are ended by Backend::stopWhere().
#pragma once

#include "core/error.h"

namespace restlab {

// Tiles and workgroups that have not begun are left out from now on, for good. Safe in a signal
// handler.
void stopFrames() noexcept;
bool framesStopped() noexcept;

// What a frame throws that was stopped: its image and its session's buffers hold no whole frame.
class FrameStopped : public Error {
 public:
  FrameStopped()
      : Error(ExitCode::interrupted, "interrupted: the image is not finished and was not written") {
  }
};

}  // namespace restlab
