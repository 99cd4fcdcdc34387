// `radiosity` against what is known: a furnace's geometric sum, paths of as many scattering events
// as iterations, its own solvers, and smaller elements.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/frame/session.h"
#include "core/scene/builtin/builder.h"
#include "core/scene/builtin/mesh.h"
#include "core/scene/compiled/compiled_scene.h"

namespace restlab {
namespace {

using builtin::SceneBuilder;

std::shared_ptr<const CompiledScene> sceneOf(const std::string& name) {
  return CompiledScene::build(makeBuiltinScene(name));
}

SessionConfig configOf(const std::string& integrator, uint32_t maxBounces, ParameterMap parameters,
                       uint32_t size = 32) {
  SessionConfig config;
  config.integrator = integrator;
  config.width = config.height = size;
  config.threads = 1;
  config.maxBounces = maxBounces;
  config.pixelFilter = rl::RL_FILTER_CENTER;  // the same lamps in view in every frame
  config.parameters = std::move(parameters);
  return config;
}

Image meanOf(Session& session, uint32_t frames) {
  Image mean(session.config().width, session.config().height);
  for (uint32_t i = 0; i < frames; ++i) {
    session.frame();
    for (size_t p = 0; p < mean.pixels.size(); ++p)
      mean.pixels[p] += session.radiance().pixels[p] * (1.0f / float(frames));
  }
  return mean;
}

double sumOf(const Image& image) {
  double sum = 0.0;
  for (const glm::vec3& p : image.pixels) sum += double(p.x) + double(p.y) + double(p.z);
  return sum;
}

// Largest difference of two images over the mean of the first.
double differenceOf(const Image& a, const Image& b) {
  double most = 0.0;
  for (size_t p = 0; p < a.pixels.size(); ++p)
    for (int c = 0; c < 3; ++c)
      most = std::max(most, std::abs(double(a.pixels[p][c]) - double(b.pixels[p][c])));
  return most / (sumOf(a) / (3.0 * double(a.pixels.size())));
}

ParameterMap with(ParameterMap map, const ParameterMap& more) {
  for (const auto& [name, value] : more) map[name] = value;
  return map;
}

const ParameterMap kSmall = {{"elements", int64_t{256}}, {"light_samples", int64_t{256}}};
const ParameterMap kToTheEnd = {{"iterations", int64_t{400}}, {"tolerance", 1e-6}};
const ParameterMap kPolygon = {{"factors", std::string("polygon")}};

// Every surface emits 0.5 and reflects rho: k events leave 0.5 times the sum of rho^i up to k, if
// the factors of every row add up to 1.
TEST(Radiosity, AFurnaceIsTheGeometricSumByIteration) {
  for (const ParameterMap& factors : {ParameterMap{}, kPolygon}) {
    for (const char* albedo : {"0.5", "0.9"}) {
      const auto scene = sceneOf(std::string("furnace?albedo=") + albedo);
      const double rho = std::stod(albedo);
      double expected = 1.0, power = 1.0;
      for (uint32_t k = 1; k <= 6; ++k) {
        power *= rho;
        expected += power;
        if (k != 1 && k != 3 && k != 6) continue;
        Session session(scene, configOf("radiosity", k, with(kSmall, factors), 16));
        session.frame();
        EXPECT_NEAR(sumOf(session.radiance()) / (1.5 * 256.0), expected, 0.01 * expected)
            << albedo << ", " << k << (factors.empty() ? ", rays" : ", polygons");
      }
    }
  }
}

TEST(Radiosity, IterationsOfJacobiAreScatteringEventsOfPaths) {
  const auto scene = sceneOf("cornell-box");
  const ParameterMap fine = {{"elements", int64_t{4096}}, {"light_samples", int64_t{64}}};
  for (uint32_t k = 0; k <= 6; ++k) {
    Session radiosity(scene, configOf("radiosity", k, fine));
    Session path(scene, configOf("path", k, {}));
    const double ratio = sumOf(meanOf(radiosity, 1)) / sumOf(meanOf(path, 128));
    // Elements this large lose up to 0.6 %; the noise of the paths is 0.4 %.
    EXPECT_NEAR(ratio, 1.0, 0.016) << k;
  }
  Session limited(scene, configOf("radiosity", 64, with(fine, {{"iterations", int64_t{2}}})));
  Session bounced(scene, configOf("radiosity", 3, fine));
  limited.frame();
  bounced.frame();
  EXPECT_EQ(differenceOf(limited.radiance(), bounced.radiance()), 0.0);
}

TEST(Radiosity, AllSolversReachOneSolution) {
  const auto scene = sceneOf("cornell-box");
  const auto solve = [&](const ParameterMap& more) {
    Session session(scene, configOf("radiosity", 1000, with(with(kSmall, kToTheEnd), more)));
    session.frame();
    const std::vector<double> residuals = session.residuals();
    EXPECT_LE(residuals.back(), 1e-6);
    EXPECT_LT(residuals.size(), 400u);
    return session.radiance();
  };
  const ParameterMap gaussSeidel = {{"solver", std::string("gauss_seidel")}};
  const Image byRays = solve({});
  EXPECT_LT(differenceOf(byRays, solve(gaussSeidel)), 1e-4);
  const Image byPolygons = solve(kPolygon);
  EXPECT_LT(differenceOf(byPolygons, solve(with(kPolygon, gaussSeidel))), 1e-4);
  EXPECT_LT(differenceOf(byPolygons, solve({{"solver", std::string("southwell")}})), 1e-4);
  // The two kinds of factors are those of one scene.
  EXPECT_NEAR(sumOf(byRays) / sumOf(byPolygons), 1.0, 0.02);
}

// Gauss-Seidel uses what it knows: fewer iterations.
TEST(Radiosity, GaussSeidelNeedsFewerIterations) {
  const auto scene = sceneOf("furnace?albedo=0.9");
  const auto iterations = [&](const char* solver) {
    Session session(scene,
                    configOf("radiosity", 1000,
                             with(with(kSmall, kToTheEnd), {{"solver", std::string(solver)}}), 8));
    session.frame();
    return session.residuals().size();
  };
  EXPECT_LT(iterations("gauss_seidel"), 0.75 * double(iterations("jacobi")));
}

// Error of the energy falls with the size of elements: four times as many, half the error.
TEST(Radiosity, SmallerElementsComeNearerToPaths) {
  const auto scene = sceneOf("cornell-box");
  Session path(scene, configOf("path", 8, {}));
  const double truth = sumOf(meanOf(path, 256));
  const auto error = [&](int64_t elements) {
    Session session(scene, configOf("radiosity", 8,
                                    {{"elements", elements},
                                     {"factor_rays", int64_t{1024}},
                                     {"light_samples", int64_t{256}}}));
    return std::abs(sumOf(meanOf(session, 1)) / truth - 1.0);
  };
  EXPECT_LT(error(8192), 0.5 * error(512));
}

// Iterations that are spread over frames end where those of one frame do, wherever the camera is.
TEST(Radiosity, TheSolutionGrowsFromFrameToFrame) {
  const auto scene = sceneOf("cornell-box");
  Session whole(scene, configOf("radiosity", 64, with(kSmall, {{"iterations", int64_t{5}}})));
  const ParameterMap slowly = {{"iterations", int64_t{5}}, {"iterations_per_frame", int64_t{2}}};
  Session parts(scene, configOf("radiosity", 64, with(kSmall, slowly)));
  whole.frame();
  SceneCamera moved = scene->source().cameras[0];
  moved.cameraToWorld[3].x += 0.1;
  for (size_t done : {2u, 4u, 5u, 5u}) {
    parts.setCamera(done == 4 ? moved : scene->source().cameras[0]);
    parts.frame();
    EXPECT_EQ(parts.residuals().size(), done);
  }
  EXPECT_EQ(whole.residuals(), parts.residuals());
}

// A lamp that is switched needs no new factors.
TEST(Radiosity, ASwitchedLampReusesTheFactors) {
  Scene source = makeBuiltinScene("cornell-box");
  const auto bright = CompiledScene::build(source);
  for (SceneMaterial& material : source.materials) material.lightFactor *= 0.25f;
  const auto dim = CompiledScene::build(source);
  Session session(bright, configOf("radiosity", 64, kSmall));
  const auto timesOf = [](const FrameStats& stats, const std::string& name) {
    const auto pass = std::find_if(stats.passes.begin(), stats.passes.end(),
                                   [&](const PassTiming& p) { return p.name == name; });
    return pass->raysPath + pass->raysShadow;
  };
  const FrameStats first = session.frame();
  const double before = sumOf(session.radiance());
  EXPECT_GT(timesOf(first, "factors"), 0u);
  session.setScene(dim);
  const FrameStats second = session.frame();
  EXPECT_EQ(timesOf(second, "factors"), 0u);
  EXPECT_GT(timesOf(second, "direct"), 0u);
  EXPECT_NEAR(sumOf(session.radiance()) / before, 0.25, 0.01);
  EXPECT_EQ(session.frame().sceneMs, 0.0);
}

std::string refusalOf(const std::shared_ptr<const CompiledScene>& scene,
                      const ParameterMap& parameters) {
  try {
    Session session(scene, configOf("radiosity", 4, parameters));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Radiosity, MeshesThatCannotBeSolvedAreRefused) {
  const auto box = sceneOf("cornell-box");
  const std::string tooFine = refusalOf(box, {{"element_size", 1e-3}});
  EXPECT_NE(tooFine.find("radiosity.element_size = 0.001"), std::string::npos) << tooFine;
  EXPECT_NE(tooFine.find("MiB"), std::string::npos) << tooFine;
  EXPECT_NE(tooFine.find("element_size = 0.0"), std::string::npos) << tooFine;
  const std::string dense = refusalOf(box, with(kPolygon, {{"elements", int64_t{50000}}}));
  EXPECT_NE(dense.find("memory_mib = 2048"), std::string::npos) << dense;
  const std::string shape = refusalOf(sceneOf("ball?as=sphere"), {});
  EXPECT_NE(shape.find("is a shape and has no triangles"), std::string::npos) << shape;
  SceneBuilder builder("line");
  builder.add(builtin::quad("line", {0, 0, 0}, {1, 0, 0}, {2, 0, 0}),
              builder.addMaterial("white", builtin::lambert(glm::vec3(0.5f))));
  builder.addCamera("eye", {0, 2, 2}, {0, 0, 0}, 45.0);
  const std::string flat = refusalOf(CompiledScene::build(builder.finish()), {});
  EXPECT_NE(flat.find("no triangle with an area"), std::string::npos) << flat;
}

}  // namespace
}  // namespace restlab
