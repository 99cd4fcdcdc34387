// SIGINT, SIGTERM and SIGHUP: the current frame is stopped (core/backend/stop.h), finished results
// are kept, exit code 130.
#pragma once

namespace restlab {

// The first signal stops the frame; a second one ends the process at once.
void installInterruptHandler();
bool interruptRequested();
// Throws Error (ExitCode::interrupted) after a signal.
void throwIfInterrupted(const char* what);

}  // namespace restlab
