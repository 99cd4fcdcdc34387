// A suite that runs in a twentieth of a second: `path` and unbiased `restir_gi`, three runs of five
// frames of 24x16 pixels. Tests append what they need; the next line is the 17th.
#pragma once

namespace restlab::cli_test {

inline constexpr const char* kSmallSuite = R"(name = "small"
scenes = ["cornell-box"]
[settings]
width = 24
height = 16
max_bounces = 3
warmup_frames = 3
frames = 2
runs = 3
[reference]
spp = 32
[[method]]
name = "path"
[[method]]
name = "gi"
integrator = "restir_gi"
)";

}  // namespace restlab::cli_test
