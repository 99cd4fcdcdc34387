// Registers `radiosity`: the mesh of a scene, the passes that solve for it once, and a ray a pixel.
#include "integrators/radiosity/radiosity.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <string>

#include "core/base/error.h"
#include "core/frame/frame_graph.h"
#include "core/frame/integrator.h"
#include "core/frame/schema.h"
#include "core/scene/compiled/compiled_scene.h"
#include "integrators/radiosity/element_mesh.h"

namespace restlab {

namespace {

constexpr uint32_t kGaussSeidel = 1;
constexpr double kMiB = 1048576.0;
// Loops over all elements must end before some drivers end them.
constexpr size_t kMostPolygonElements = 60000;
constexpr uint64_t kMostTurns = 65536;  // of the loop of a frame
constexpr size_t kMostElements = size_t{1} << 22u;

struct RadiositySettings {
  uint32_t solver = 0;
  uint32_t factors = 0;
  double elementSize = 0.0;
  uint32_t elements = 8192;
  uint32_t factorRays = 256;
  uint32_t lightSamples = 64;
  uint32_t iterations = 32;
  double tolerance = 1e-4;
  uint32_t blocks = 16;
  uint32_t shots = 64;
  uint32_t iterationsPerFrame = 0;
  uint32_t memoryMiB = 2048;
};

const Schema<RadiositySettings>& schema() {
  using S = RadiositySettings;
  using P = Parameter<S>;
  static const Schema<S> all = {
      P(&S::solver, "solver", Choices{"jacobi", "gauss_seidel", "southwell"},
        "jacobi: an iteration is a scattering event, and max_bounces ends it; the others know no "
        "max_bounces; southwell: progressive, keeps no factors",
        "Goral et al. 1984; Cohen et al. 1988"),
      P(&S::factors, "factors", Choices{"rays", "polygon"},
        "rays: cosine-weighted from each vertex; polygon: Lambert's formula times visibility by "
        "four rays",
        "rays took the least time for an error (docs/radiosity.md)"),
      P(&S::elementSize, "element_size", Range{0.0, 1e9},
        "metres: no edge of an element is longer; 0: by the number of elements",
        "the scene's area"),
      P(&S::elements, "elements", Range{1.0, double(kMostElements)},
        "about this many, where element_size is 0", "half a metre in a room of 11 m"),
      P(&S::factorRays, "factor_rays", Range{16.0, 60000.0},
        "of each side of a vertex, rounded up to a square", "as noisy as elements are coarse"),
      P(&S::lightSamples, "light_samples", Range{16.0, 65536.0},
        "of each side of a vertex, rounded up to a multiple of 16", "as factor_rays"),
      P(&S::iterations, "iterations", Range{0.0, 4096.0},
        "at most; 0: the light of the sources alone", "tolerance ends them before"),
      P(&S::tolerance, "tolerance", Range{0.0, 1.0},
        "light that an iteration changes or leaves, over that of the sources, below which the "
        "solution is done",
        "below the error of elements"),
      P(&S::blocks, "blocks", Range{2.0, 1024.0},
        "sets of unknowns of gauss_seidel, one after another", "block Gauss-Seidel"),
      P(&S::shots, "shots", Range{1.0, 128.0},
        "sides of elements that an iteration of southwell sends; 1: Southwell's own method",
        "by blocks, so that devices have work"),
      P(&S::iterationsPerFrame, "iterations_per_frame", Range{0.0, 4096.0},
        "0: all in the first frame; else the solution grows from frame to frame",
        "viewers show it grow"),
      P(&S::memoryMiB, "memory_mib", Range{1.0, 16000.0}, "MiB that factors may take",
        "half of a small machine")};
  return all;
}

uint32_t squareSide(uint32_t rays) {
  return static_cast<uint32_t>(std::ceil(std::sqrt(double(rays)) - 1e-9));
}

size_t ceilDivide(size_t a, size_t b) { return (a + b - 1) / b; }

bool keepsFactors(const RadiositySettings& s) { return s.solver != rl::RL_RADIOSITY_SOUTHWELL; }

// Bytes of the factors of a mesh.
double factorBytes(const RadiositySettings& s, double elements, double vertices) {
  if (!keepsFactors(s)) return 0.0;
  if (s.factors == rl::RL_RADIOSITY_POLYGON) return 2.0 * vertices * elements * 4.0;
  return 2.0 * vertices * double(squareSide(s.factorRays)) * squareSide(s.factorRays) * 8.0;
}

// Refuses a mesh that does not fit, with a size that does.
[[noreturn]] void failTooLarge(const RadiositySettings& s, const CompiledScene& scene, double size,
                               size_t elements, double mib) {
  const bool isPolygon = keepsFactors(s) && s.factors == rl::RL_RADIOSITY_POLYGON;
  const size_t most = isPolygon ? kMostPolygonElements : kMostElements;
  const double tooMany = std::max(double(elements) / double(most), mib / double(s.memoryMiB));
  if (countElements(scene, std::numeric_limits<double>::max()) > most) {
    failUsage(
        fmt::format("radiosity: scene {} has {} triangles, each of them an element: at most "
                    "{} would do",
                    scene.source().name, elements, most));
  }
  // Factors by polygons grow with the square of the number of elements.
  const double larger = size * (isPolygon ? std::pow(tooMany, 0.25) : std::sqrt(tooMany)) * 1.05;
  failUsage(fmt::format(
      "radiosity.element_size = {:.4g}: {} elements in scene {} take {:.0f} MiB of factors "
      "(memory_mib = {}, at most {} elements): element_size = {:.2g}{} may do",
      size, elements, scene.source().name, mib, s.memoryMiB, most, larger,
      keepsFactors(s) && elements <= kMostElements ? " or solver = southwell, which keeps none,"
                                                   : ""));
}

std::shared_ptr<const ElementMesh> makeMesh(const RadiositySettings& s,
                                            const CompiledScene& scene) {
  requireTriangles(scene);
  const double size = s.elementSize > 0.0 ? s.elementSize : elementSizeOf(scene, s.elements);
  const bool isPolygon = keepsFactors(s) && s.factors == rl::RL_RADIOSITY_POLYGON;
  const auto mibOf = [&](size_t elements, double vertices) {
    return factorBytes(s, double(elements), vertices) / kMiB;
  };
  // A mesh has about half as many vertices as elements.
  const size_t elements = countElements(scene, size);
  if (elements > (isPolygon ? kMostPolygonElements : kMostElements))
    failTooLarge(s, scene, size, elements, mibOf(elements, 0.5 * double(elements)));
  std::shared_ptr<const ElementMesh> mesh = makeElementMesh(scene, size);
  if (mesh->elementCount == 0)
    failInput(fmt::format("radiosity: scene {} has no triangles", scene.source().name));
  // Light samples are kept, too.
  const double samples = double(mesh->vertexCount) * 2.0 * sizeof(glm::vec3) *
                         double(ceilDivide(s.lightSamples, rl::RL_RADIOSITY_CHUNK));
  const double mib = mibOf(elements, double(mesh->vertexCount)) + samples / kMiB;
  if (mib > s.memoryMiB) failTooLarge(s, scene, size, elements, mib);
  return mesh;
}

// The mesh of a scene, made once for the parameters that it depends on.
std::shared_ptr<const ElementMesh> meshOf(const RadiositySettings& s, const CompiledScene& scene) {
  const std::string key = fmt::format("radiosity {:.17g} {} {} {} {} {}", s.elementSize, s.elements,
                                      s.solver, s.factors, s.factorRays, s.memoryMiB);
  const auto made =
      scene.derived(key, [&] { return std::static_pointer_cast<const void>(makeMesh(s, scene)); });
  return std::static_pointer_cast<const ElementMesh>(made);
}

// A table of the mesh, which holds the mesh as long as a graph holds the table.
std::shared_ptr<const std::vector<uint32_t>> tableOf(const std::shared_ptr<const ElementMesh>& mesh,
                                                     const std::vector<uint32_t>& words) {
  return {mesh, &words};
}

void recordRadiosity(FrameGraph& g, const FrameInfo& f) {
  if (f.scene == nullptr) failUsage("radiosity: a frame needs a scene");
  const RadiositySettings s = schema().read(f.parameters);
  const std::shared_ptr<const ElementMesh> mesh = meshOf(s, *f.scene);
  const bool isSouthwell = s.solver == rl::RL_RADIOSITY_SOUTHWELL;
  const bool isPolygon = s.factors == rl::RL_RADIOSITY_POLYGON && !isSouthwell;
  const size_t unknowns = 2 * mesh->vertexCount, elements = mesh->elementCount;
  const uint32_t side = squareSide(s.factorRays);
  const size_t rays = size_t{side} * side;
  const uint32_t lightChunks = uint32_t(ceilDivide(s.lightSamples, rl::RL_RADIOSITY_CHUNK));
  const uint32_t sets = s.solver == kGaussSeidel ? s.blocks : 1;
  const size_t perSet = ceilDivide(unknowns, sets);
  const uint32_t shots = uint32_t(std::min<size_t>(s.shots, 2 * elements));
  const uint32_t groups =
      isSouthwell ? shots : uint32_t(ceilDivide(perSet, rl::RL_RADIOSITY_GROUP));
  if (isSouthwell && ceilDivide(2 * elements, shots) > kMostPolygonElements) {
    failUsage(fmt::format("radiosity.shots = {}: {} sides of elements ask for {} at least", s.shots,
                          2 * elements, ceilDivide(2 * elements, kMostPolygonElements)));
  }
  const uint32_t perFrame = s.iterationsPerFrame > 0 ? s.iterationsPerFrame : s.iterations;
  if (uint64_t{perFrame} * sets > kMostTurns) {
    failUsage(
        fmt::format("radiosity: {} iterations of {} blocks in a frame: at most {} in all; "
                    "iterations_per_frame would spread them",
                    perFrame, sets, kMostTurns));
  }
  const rl::RadiosityParams params = {.unknowns = uint32_t(unknowns),
                                      .elements = uint32_t(elements),
                                      .raysPerSide = side,
                                      .lightChunks = lightChunks,
                                      .usesPolygons = isPolygon ? 1u : 0u,
                                      .solver = s.solver,
                                      .sets = sets,
                                      .groups = groups,
                                      .shots = shots,
                                      .iterations = s.iterations,
                                      .tolerance = float(s.tolerance)};

  const size_t vec3 = sizeof(glm::vec3);
  const Buffer instances = g.table("element_instances", tableOf(mesh, mesh->instances), 4);
  const Buffer triangles = g.table("element_triangles", tableOf(mesh, mesh->triangles), 8);
  const Buffer table =
      g.table("elements", tableOf(mesh, mesh->elements), 16 * rl::RL_RADIOSITY_ELEMENT_UVEC4S);
  const Buffer vertices = g.table("element_vertices", tableOf(mesh, mesh->vertices),
                                  16 * rl::RL_RADIOSITY_VERTEX_UVEC4S);
  const Buffer albedo = g.onceBuffer("element_albedo", elements, vec3);
  const Buffer hits =
      g.onceBuffer("factor_rays", isSouthwell || isPolygon ? 0 : unknowns * rays, 8);
  const Buffer factors = g.onceBuffer("factors", isPolygon ? unknowns * elements : 0, 4);
  const Buffer direct = g.onceBuffer("light_samples", unknowns * lightChunks, vec3);
  const Buffer source = g.buffer("source_irradiance", unknowns, vec3);
  const Buffer irradiance = g.buffer("irradiance", unknowns, vec3);
  const Buffer pending = g.buffer("next_irradiance", isSouthwell ? 0 : unknowns, vec3);
  const Buffer change = g.buffer("change", unknowns, 4);
  const Buffer shot = g.buffer("shot_irradiance", isSouthwell ? 2 * elements : 0, vec3);
  const Buffer chosen = g.buffer("shots", isSouthwell ? shots : 0, 16);
  const Buffer parts = g.buffer("sums", groups, 8);
  const Buffer state = g.buffer("state", rl::RL_RADIOSITY_STATE_WORDS, 4);
  const Buffer residuals = g.buffer("residuals", std::max(s.iterations, 1u), 4);
  const Buffer radiance = g.buffer("radiance", f.pixels, vec3);
  const Buffer seen = g.buffer("seen_elements", f.pixels, 4);

  const Kernels k = g.kernels<rl::RadiosityBuffers>(
      params, {instances, triangles, table, vertices, albedo, hits, factors, direct, source,
               irradiance, pending, change, shot, chosen, parts, state, residuals, radiance, seen});
  const bool isNew = f.sceneAge == 0;
  // Solving again after a lamp was switched is work of the frame.
  const bool isForScene = f.sceneAge == f.lightAge;
  if (isNew) {
    k.pass("elements", "radiosity_elements").over(elements).reads({table}).writes({albedo}).once();
    if (isPolygon) {
      k.pass("factors", "radiosity_polygons")
          .over(unknowns * ceilDivide(elements, rl::RL_RADIOSITY_CHUNK))
          .reads({table, vertices})
          .writes({factors})
          .once();
    } else if (!isSouthwell) {
      k.pass("factors", "radiosity_rays")
          .over(unknowns * ceilDivide(rays, rl::RL_RADIOSITY_CHUNK))
          .reads({instances, triangles, vertices})
          .writes({hits})
          .once();
    }
  }
  if (f.lightAge == 0) {
    k.pass("direct", "radiosity_direct")
        .over(unknowns * lightChunks)
        .reads({vertices})
        .writes({direct})
        .once(isNew);
    k.pass("begin", "radiosity_begin")
        .over(std::max(unknowns, 2 * elements))
        .reads({direct})
        .writes({source, irradiance, change, shot, state})
        .once(isNew);
  }
  const uint64_t done = uint64_t{f.lightAge} * perFrame;
  if (done < s.iterations) {
    const uint32_t turns = uint32_t(std::min<uint64_t>(perFrame, s.iterations - done)) * sets;
    g.loop(turns, [&] {
      if (isSouthwell) {
        k.pass("pick", "radiosity_pick")
            .over(shots)
            .reads({table, albedo, irradiance, state})
            .writes({chosen, parts})
            .updates({shot})
            .once(isForScene);
        k.pass("shoot", "radiosity_shoot")
            .over(unknowns)
            .reads({table, vertices, chosen, state})
            .updates({irradiance, change})
            .once(isForScene);
      } else {
        k.pass("gather", "radiosity_gather")
            .over(perSet)
            .reads({table, albedo, hits, factors, source, irradiance, state})
            .writes({pending})
            .once(isForScene);
        k.pass("commit", "radiosity_commit")
            .over(groups)
            .reads({vertices, source, pending, state})
            .writes({parts})
            .updates({irradiance, change})
            .once(isForScene);
      }
      k.pass("advance", "radiosity_advance")
          .over(1)
          .reads({parts})
          .updates({state, residuals})
          .once(isForScene);
    });
  }
  k.pass("shade", "radiosity_shade")
      .reads({instances, triangles, table, source, irradiance})
      .writes({radiance, seen});
  g.shared.radiance = radiance;
}

std::string whyUnused(const std::string& name, const ParameterMap& parameters) {
  const RadiositySettings s = schema().read(parameters);
  const bool isSouthwell = s.solver == rl::RL_RADIOSITY_SOUTHWELL;
  if (name == "elements" && s.elementSize > 0.0) return "element_size is set";
  if (isSouthwell && (name == "factors" || name == "factor_rays" || name == "memory_mib"))
    return "solver = southwell keeps no factors";
  if (name == "factor_rays" && s.factors == rl::RL_RADIOSITY_POLYGON) return "factors = polygon";
  if (name == "blocks" && s.solver != kGaussSeidel) return "solver is not gauss_seidel";
  if (name == "russian_roulette") return "light is gathered from elements, and no path ends";
  if (name == "shots" && !isSouthwell) return "solver is not southwell";
  return "";
}

// Corners of the element that a pixel shows; false: it shows none.
struct SeenElement {
  uint32_t side = 0;
  uint32_t unknowns[3] = {};
};
bool seenElement(const FrameSnapshot& frame, size_t pixel, SeenElement& out) {
  const std::span<const uint32_t> seen = frame.words("seen_elements");
  const std::span<const uint32_t> elements = frame.words("elements");
  if (pixel >= seen.size() || seen[pixel] == 0) return false;
  out.side = seen[pixel] - 1;
  const size_t at = size_t{out.side / 2} * 4 * rl::RL_RADIOSITY_ELEMENT_UVEC4S;
  for (size_t k = 0; k < 3; ++k) out.unknowns[k] = 2 * elements[at + k] + (out.side & 1u);
  return true;
}

std::vector<LayerInfo> radiosityLayers() {
  LayerInfo elements;
  elements.name = "elements";
  elements.summary = "1 + the number of the element, twice, + 1 on its back";
  elements.isName = true;
  elements.values = [](const FrameSnapshot& frame) {
    const std::span<const uint32_t> seen = frame.words("seen_elements");
    return [seen](size_t pixel) { return pixel < seen.size() ? float(seen[pixel]) : 0.0f; };
  };
  LayerInfo residual;
  residual.name = "residual";
  residual.summary = "irradiance that the last iteration changed, mean of an element's vertices";
  residual.unit = "W/m^2";
  residual.values = [](const FrameSnapshot& frame) {
    const std::span<const uint32_t> change = frame.words("change");
    return [&frame, change](size_t pixel) {
      SeenElement element;
      if (change.empty() || !seenElement(frame, pixel, element)) return 0.0f;
      float sum = 0.0f;
      for (const uint32_t unknown : element.unknowns) sum += std::bit_cast<float>(change[unknown]);
      return sum / 3.0f;
    };
  };
  return {elements, residual};
}

std::vector<double> radiosityResiduals(const FrameSnapshot& frame) {
  const std::span<const uint32_t> state = frame.words("state");
  const std::span<const uint32_t> words = frame.words("residuals");
  std::vector<double> all;
  if (state.empty()) return all;
  const size_t done = std::min<size_t>(state[rl::RL_RADIOSITY_ITERATIONS], words.size());
  for (size_t i = 0; i < done; ++i) all.push_back(double(std::bit_cast<float>(words[i])));
  return all;
}

std::vector<ProbeValue> radiosityProbe(const FrameSnapshot& frame, size_t pixel) {
  SeenElement element;
  const std::span<const uint32_t> state = frame.words("state");
  const std::span<const uint32_t> irradiance = frame.words("irradiance");
  if (state.empty() || !seenElement(frame, pixel, element)) return {};
  std::vector<ProbeValue> all = {
      {"iterations", std::to_string(state[rl::RL_RADIOSITY_ITERATIONS])}};
  for (size_t k = 0; k < 3; ++k) {
    const auto channel = [&](size_t c) {
      return std::bit_cast<float>(irradiance[3 * size_t{element.unknowns[k]} + c]);
    };
    all.push_back({fmt::format("irradiance of vertex {}", k + 1),
                   fmt::format("{:.4g} {:.4g} {:.4g} W/m^2", channel(0), channel(1), channel(2))});
  }
  return all;
}

}  // namespace

const IntegratorInfo& radiosityIntegratorInfo() {
  static const IntegratorInfo info = [] {
    IntegratorInfo i;
    i.name = "radiosity";
    i.summary = "radiosity of a mesh of elements, solved for once; a frame costs one ray a pixel";
    i.modes = {
        {"biased", BiasClass::biased,
         "every surface reflects as Lambert's, and light varies linearly within an element"}};
    i.leavesOut = "all reflection that is not diffuse";
    i.leavesOutOf = [](const CompiledScene& scene, const ParameterMap& parameters) {
      const double share = meshOf(schema().read(parameters), scene)->otherThanLambert;
      if (share == 0.0) return std::string();
      return fmt::format("reflection that is not diffuse, of {:.2g} % of the surfaces",
                         100.0 * share);
    };
    i.parameters = schema().infos();
    i.reasonUnused = whyUnused;
    i.layers = radiosityLayers();
    i.probe = radiosityProbe;
    i.residuals = radiosityResiduals;
    i.record = recordRadiosity;
    return i;
  }();
  return info;
}

}  // namespace restlab
