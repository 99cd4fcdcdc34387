// restlab graph: the passes of a method's frame, and the buffers between them.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <glm/ext/matrix_transform.hpp>

#include "core/frame/frame_graph.h"
#include "core/frame/method.h"
#include "core/image/io/atomic_file.h"
#include "core/scene/compiled/compiled_scene.h"
#include "core/scene/scene.h"
#include "experiments/cli/options.h"
#include "experiments/cli/verbs.h"
#include "experiments/report/graph_svg.h"
#include "experiments/report/text.h"
#include "experiments/runner/base/log.h"
#include "experiments/runner/base/print.h"
#include "experiments/runner/tables/markdown_table.h"

namespace restlab {

namespace {

using Json = nlohmann::ordered_json;

struct GraphOptions {
  SceneOptions scene;
  MethodOptions method;
  std::string output;
  bool json = false;
};

// Two frames of a history: one after a small turn of the camera, and the still one after it.
struct MeasuredFrames {
  FrameGraph moving, still;
  std::vector<GraphPass> passes;  // work for the scene, of the first frame, and those of `moving`
  std::map<std::string, double> raysMoving, raysStill;  // per pixel, by pass
  std::map<std::string, size_t> bytesPerPixel;          // by buffer
  size_t bytes = 0;
};

std::map<std::string, double> raysPerPixel(const FrameStats& stats, double pixels) {
  std::map<std::string, double> rays;
  for (const PassTiming& pass : stats.passes)
    rays[pass.name] = double(pass.raysPath + pass.raysShadow) / pixels;
  return rays;
}

MeasuredFrames measure(const PreparedScene& prepared, const SessionConfig& config) {
  constexpr int kWarmupFrames = 4;
  constexpr double kTurnRadians = 0.005;
  Session session(prepared.scene, config);
  MeasuredFrames frames;
  const double pixels = double(config.width) * config.height;
  const FrameStats first = session.frame();
  for (const GraphPass& pass : session.graph().passes())
    if (pass.isOnce) frames.passes.push_back(pass);
  for (int frame = 1; frame < kWarmupFrames; ++frame) session.frame();
  SceneCamera camera = prepared.scene->source().cameras[config.camera];
  const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), kTurnRadians, glm::dvec3(0.0, 1.0, 0.0));
  camera.cameraToWorld = glm::dmat4(camera.cameraToWorld) * turn;
  session.setCamera(camera);
  frames.raysMoving = raysPerPixel(session.frame(), pixels);
  frames.moving = session.graph();
  const std::map<std::string, double> raysFirst = raysPerPixel(first, pixels);
  for (const GraphPass& pass : frames.passes)
    frames.raysMoving[pass.name] = raysFirst.at(pass.name);
  for (const GraphPass& pass : frames.moving.passes())
    if (!pass.isOnce) frames.passes.push_back(pass);
  frames.raysStill = raysPerPixel(session.frame(), pixels);
  frames.still = session.graph();
  for (const auto& [name, bytes] : session.bufferBytesPerPixel())
    frames.bytesPerPixel[name] = bytes;
  frames.bytes = session.bytesPerPixel();
  return frames;
}

// Name of a buffer as the frame has it: of two that trade places, "NAME" is this frame's.
std::string nameOf(const FrameGraph& graph, Buffer buffer) {
  const std::string& name = graph.buffers()[buffer.index].name;
  if (graph.find(name) == buffer) return name;
  const std::string end = "_previous";
  return name.ends_with(end) ? name.substr(0, name.size() - end.size()) : name + end;
}

std::vector<std::string> namesOf(const FrameGraph& graph, const std::vector<Buffer>& buffers,
                                 const MeasuredFrames& frames) {
  std::vector<std::string> names;
  for (const Buffer buffer : buffers) {
    const std::string name = nameOf(graph, buffer);
    if (frames.bytesPerPixel.contains(name)) names.push_back(name);
  }
  return names;
}

bool runsInStillView(const MeasuredFrames& frames, const std::string& pass) {
  const std::vector<GraphPass>& passes = frames.still.passes();
  return std::any_of(passes.begin(), passes.end(),
                     [&](const GraphPass& other) { return other.name == pass; });
}

double raysOf(const std::map<std::string, double>& rays, const std::string& pass) {
  const auto found = rays.find(pass);
  return found == rays.end() ? 0.0 : found->second;
}

Json graphJson(const MeasuredFrames& frames) {
  Json passes = Json::array(), buffers = Json::array();
  for (const GraphPass& pass : frames.passes) {
    passes.push_back({{"name", pass.name},
                      {"part", pass.part},
                      {"kernel", pass.kernel},
                      {"elements", pass.entries},
                      {"once_for_the_scene", pass.isOnce},
                      {"in_still_view", runsInStillView(frames, pass.name)},
                      {"rays_per_pixel_moving", raysOf(frames.raysMoving, pass.name)},
                      {"rays_per_pixel_still", raysOf(frames.raysStill, pass.name)},
                      {"reads", namesOf(frames.moving, pass.read, frames)},
                      {"writes", namesOf(frames.moving, pass.written, frames)}});
    if (pass.entries == 0) passes.back()["elements"] = "pixels";
    if (!pass.vertexKernel.empty()) {
      passes.back()["elements"] = "triangles";
      passes.back()["vertex_kernel"] = pass.vertexKernel;
    }
  }
  for (const GraphBuffer& buffer : frames.moving.buffers()) {
    if (!frames.bytesPerPixel.contains(buffer.name)) continue;
    buffers.push_back({{"name", buffer.name},
                       {"part", buffer.part},
                       {"elements", buffer.count},
                       {"bytes_per_element", buffer.elementBytes},
                       {"bytes_per_pixel", frames.bytesPerPixel.at(buffer.name)}});
    const Buffer lender = frames.moving.lenderOf(frames.moving.find(buffer.name));
    if (lender) buffers.back()["in"] = nameOf(frames.moving, lender);
  }
  return {{"passes", passes}, {"buffers", buffers}, {"bytes_per_pixel", frames.bytes}};
}

// Bytes per pixel of a buffer; or whose memory it uses.
std::string bytesText(const MeasuredFrames& frames, const GraphBuffer& buffer) {
  const FrameGraph& graph = frames.moving;
  const Buffer lender = graph.lenderOf(graph.find(buffer.name));
  return lender ? "in " + nameOf(graph, lender)
                : std::to_string(frames.bytesPerPixel.at(buffer.name));
}

std::string listed(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string raysText(double rays) { return rays > 0.0 ? shortNumber(rays) : ""; }

std::string whenText(const MeasuredFrames& frames, const GraphPass& pass) {
  if (pass.isOnce) return "once a scene";
  return runsInStillView(frames, pass.name) ? "runs" : "left out";
}

void printGraph(const MeasuredFrames& frames) {
  MarkdownTable passes(
      {"pass", "still view", "rays/px moving", "rays/px still", "reads", "writes"});
  for (const GraphPass& pass : frames.passes) {
    passes.add({pass.name, whenText(frames, pass), raysText(raysOf(frames.raysMoving, pass.name)),
                raysText(raysOf(frames.raysStill, pass.name)),
                listed(namesOf(frames.moving, pass.read, frames)),
                listed(namesOf(frames.moving, pass.written, frames))});
  }
  MarkdownTable buffers({"buffer", "of", "elements", "bytes each", "bytes/px"});
  for (const GraphBuffer& buffer : frames.moving.buffers()) {
    if (!frames.bytesPerPixel.contains(buffer.name)) continue;
    buffers.add({buffer.name, buffer.part, groupedDigits(buffer.count),
                 std::to_string(buffer.elementBytes), bytesText(frames, buffer)});
  }
  print("{}\n{}\n{} bytes per pixel in all\n", passes.text(), buffers.text(), frames.bytes);
}

GraphDrawing drawingOf(const MeasuredFrames& frames, const std::string& title) {
  GraphDrawing drawing;
  drawing.title = title;
  drawing.footnote =
      "Filled: writes; hollow: reads. Dashed frame: only where the view is new, or once a scene. "
      "Arrow: for the next frame. Beside a pass: rays per pixel (moving, still); "
      "beside a buffer: bytes per pixel (0: in the memory of another one).";
  std::map<std::string, size_t> lanes;
  for (const GraphPass& pass : frames.passes) {
    GraphDrawing::Pass& drawn = drawing.passes.emplace_back();
    drawn.name = pass.name;
    drawn.runsInStillView = runsInStillView(frames, pass.name);
    const double moving = raysOf(frames.raysMoving, pass.name);
    const double still = raysOf(frames.raysStill, pass.name);
    if (moving > 0.0 || still > 0.0)
      drawn.note = fmt::format("{}, {}", shortNumber(moving), shortNumber(still));
    const auto mark = [&](const std::vector<Buffer>& buffers, GraphDrawing::Use use) {
      for (const std::string& name : namesOf(frames.moving, buffers, frames)) {
        const auto [lane, isNew] = lanes.try_emplace(name, lanes.size());
        if (isNew) drawing.buffers.push_back({name, std::to_string(frames.bytesPerPixel.at(name))});
        drawn.uses.resize(std::max(drawn.uses.size(), lanes.size()), GraphDrawing::Use::none);
        GraphDrawing::Use& at = drawn.uses[lane->second];
        at = at == GraphDrawing::Use::none ? use : GraphDrawing::Use::both;
      }
    };
    mark(pass.read, GraphDrawing::Use::read);
    mark(pass.written, GraphDrawing::Use::written);
  }
  for (GraphDrawing::Pass& pass : drawing.passes)
    pass.uses.resize(lanes.size(), GraphDrawing::Use::none);
  for (const auto& [name, lane] : lanes) {
    GraphDrawing::DrawnBuffer& buffer = drawing.buffers[lane];
    bool isUsed = false, isWritten = false;
    for (const GraphDrawing::Pass& pass : drawing.passes) {
      const GraphDrawing::Use use = pass.uses[lane];
      if (use == GraphDrawing::Use::none) continue;
      if (!isUsed) buffer.isFromLastFrame = use != GraphDrawing::Use::written;
      isUsed = true;
      isWritten = isWritten || use != GraphDrawing::Use::read;
    }
    buffer.isForNextFrame =
        isWritten && (buffer.isFromLastFrame || lanes.contains(name + "_previous"));
  }
  return drawing;
}

void graph(GraphOptions& options) {
  if (!options.output.empty())
    checkOutputs({{"-o", options.output, ".svg"}}, options.scene.request);
  SessionConfig config = makeConfig(options.scene, options.method);
  const PreparedScene prepared = prepareScene(options.scene.request);
  printWarnings(prepared);
  completeConfig(prepared, options.scene, config);
  const MeasuredFrames frames = measure(prepared, config);
  if (options.json) {
    printJsonText(graphJson(frames).dump(2, ' ', false, Json::error_handler_t::replace));
  } else {
    printGraph(frames);
  }
  if (findMethod(config).denoiser->onHost)
    logInfo(fmt::format("denoiser {} runs on the host after these passes", config.denoiser));
  if (options.output.empty()) return;
  const Method method = findMethod(config);
  std::string title = config.integrator;
  if (method.cache != nullptr) title += ", cache " + method.cache->name;
  if (config.denoiser != "none") title += ", denoiser " + config.denoiser;
  writeTextFile(
      options.output,
      graphSvg(drawingOf(frames, fmt::format("{}: {}, {} bytes per pixel", title,
                                             prepared.scene->source().name, frames.bytes))));
}

}  // namespace

Action addGraphVerb(CLI::App& app) {
  auto options = std::make_shared<GraphOptions>();
  options->scene.request.scene = "cornell-box";
  options->scene.width = 160;
  options->scene.height = 160;
  CLI::App* verb = app.add_subcommand("graph", "the passes of a method's frame and their buffers");
  verb->add_option("method", options->method.choice.integrator, "an integrator")->required();
  verb->add_option("--scene", options->scene.request.scene,
                   "a glTF, Mitsuba or scene file or a built-in scene (default cornell-box)");
  addSceneSettings(*verb, options->scene.request.scene);
  verb->add_option("--camera", options->scene.request.camera, "name or index (default: the first)");
  verb->add_option("-o,--output", options->output, "an .svg file");
  verb->add_flag("--json", options->json, "JSON on stdout");
  addMethodOptions(*verb, options->method);
  verb->remove_option(verb->get_option("--integrator"));
  return [options](Outcome&) { graph(*options); };
}

}  // namespace restlab
