// Images of other renderers for the same scenes. They are not part of the project: found under
// RESTLAB_SCENES, else under ../shared/scenes beside it; without them the tests skip.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <string>

namespace restlab::gates {

// Returns the folder of a gate, which need not exist.
std::filesystem::path gateFolder(const std::string& gate);

}  // namespace restlab::gates

// Skips the test with a visible line if the gate is absent.
#define RESTLAB_NEED_GATE(gate)                                                                  \
  if (!std::filesystem::exists(::restlab::gates::gateFolder(gate))) {                            \
    std::printf("skipped: gate %s is absent (RESTLAB_SCENES names the scenes' folder)\n", gate); \
    GTEST_SKIP() << "gate " << (gate) << " is absent";                                           \
  }
