// A program of its own that holds a Session: renders frames of a scene and writes the last one.
#include <cstdio>
#include <cstdlib>

#include "core/base/error.h"
#include "core/frame/session.h"
#include "core/scene/compiled/compiled_scene.h"

using namespace restlab;

int main(int argc, char** argv) try {
  if (argc != 4) failUsage("usage: example SCENE FRAMES FILE.exr");
  SessionConfig config;
  config.integrator = "restir_gi";
  config.width = config.height = 64;
  config.parameters["spatial_neighbours"] = int64_t{2};

  Session session(CompiledScene::build(loadScene(argv[1])), config);
  const int frames = std::atoi(argv[2]);
  for (int i = 0; i < frames; ++i) {
    const FrameStats stats = session.frame();
    std::printf("frame %d: %.1f ms, %llu rays\n", i + 1, stats.timeMs,
                static_cast<unsigned long long>(stats.raysPath + stats.raysShadow));
  }
  LayeredImage file;
  file.layers[""] = session.radiance();
  file.layers["albedo"] = session.aov("albedo");
  writeExr(argv[3], file);
  return 0;
} catch (const Error& error) {
  std::fprintf(stderr, "error: %s\n", error.what());
  return static_cast<int>(error.code());
}
