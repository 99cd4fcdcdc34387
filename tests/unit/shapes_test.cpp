// Every kind of shape beside triangles: rays, points, draws and densities agree; closed shapes do
// not leak, and no shape shadows itself, whatever its size and place.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <map>

#include "core/scene/builtin/builder.h"
#include "core/scene/shapes/fine_meshes.h"
#include "core/scene/shapes/shape_info.h"
#include "tests/unit/constants.h"
#include "tests/unit/dialect_context.h"
#include "tests/unit/goodness.h"
#include "tests/unit/random_inputs.h"

namespace restlab::unit {
namespace {

struct ShapeCase {
  std::string name;
  const ShapeInfo* info;
  ShapeGeometry shape;
  bool isClosed;
};

std::vector<ShapeCase> shapeCases() {
  std::vector<ShapeCase> cases;
  const auto add = [&](const std::string& name, ShapeGeometry shape) {
    cases.push_back({name, shape.info, shape, shape.info->isClosed(shape)});
  };
  for (const ShapeInfo& info : shapeRegistry()) {
    std::vector<float> values;
    for (const ShapeParameter& p : info.parameters) values.push_back(float(p.fallback));
    if (!info.read) add(info.name, {&info, values});
    for (const ShapeExample& example : info.examples)
      add(example.name, {&info, example.values, example.words});
  }
  return cases;
}

// A context with the parameters of one shape, in its own space.
struct LocalShape {
  explicit LocalShape(const ShapeCase& of) : words(shapeWords(of.shape)) {
    shape.kind = of.info->kind;
    shape.firstWord = 0;
    d.scene.shapeWords.data = words.data();
  }
  std::vector<glm::uvec4> words;
  rl::Shape shape{};
  Dialect<> d;
};

rl::SurfaceId idOf(const rl::Hit& hit) { return {0, hit.primitive, hit.bary}; }

rl::Ray rayOf(const glm::vec3& origin, const glm::vec3& dir) { return {origin, 0.0f, dir, 3e38f}; }

// Inside of a closed shape, from its definition.
bool isInside(const std::string& name, const glm::dvec3& p) {
  const double r2 = p.x * p.x + p.y * p.y;
  if (name == "sphere") return glm::length(p) < 1.0;
  if (name == "cube") return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < 1.0;
  if (name == "cylinder") return r2 < 1.0 && p.z > 0.0 && p.z < 1.0;
  return p.z > 0.0 && p.z < 1.0 && std::sqrt(r2) < 1.0 - p.z;  // cone
}
bool isDefined(const std::string& name) {
  return name == "sphere" || name == "cube" || name == "cylinder" || name == "cone";
}

class Shapes : public testing::TestWithParam<ShapeCase> {};

TEST_P(Shapes, ThePointOfAnIdLiesOnTheRay) {
  LocalShape local(GetParam());
  Inputs inputs(1);
  const auto box = GetParam().info->box(GetParam().shape);
  int hits = 0;
  for (int i = 0; i < 100'000; ++i) {
    const glm::vec3 u(inputs.uniform(), inputs.uniform(), inputs.uniform());
    const glm::vec3 target = glm::mix(box[0], box[1], u);
    const glm::vec3 dir = inputs.direction();
    const float away = inputs.below(4) == 0 ? 0.0f : inputs.scale(0.1f, 1e3f);
    rl::Hit hit{};
    const rl::Ray ray = rayOf(target - dir * away, dir * inputs.scale(1e-3f, 1e3f));
    if (!local.d->shapeIntersect(local.shape, ray, hit)) continue;
    ++hits;
    ASSERT_GT(hit.t, 0.0f);
    ASSERT_TRUE(hit.bary.x >= 0.0f && hit.bary.x <= 1.0f && hit.bary.y >= 0.0f &&
                hit.bary.y <= 1.0f);
    ASSERT_LT(hit.primitive, 8u);  // reservoirs of direct light have three bits for it
    // As reservoirs hold it.
    hit.bary = {local.d->unpackUnorm24(local.d->packUnorm24(hit.bary.x)),
                local.d->unpackUnorm24(local.d->packUnorm24(hit.bary.y))};
    const rl::ShapePoint p = local.d->shapePoint(local.shape, idOf(hit));
    const float reach = std::max(1.0f, glm::length(ray.origin));
    // A ray that grazes has a point that moves far for a small error.
    const float cosine = std::abs(glm::dot(p.normalL, dir));
    ASSERT_LT(glm::distance(ray.origin + hit.t * ray.dir, p.posL),
              2e-6f * reach / std::max(cosine, 1e-3f))
        << "ray " << i;
    ASSERT_NEAR(glm::length(p.normalL), 1.0f, 1e-6f);
    for (int c = 0; c < 3; ++c) ASSERT_LE(std::abs(p.posL[c]), p.extent[c] + 1e-6f);
    ASSERT_LT(std::abs(glm::dot(p.normalL, glm::normalize(p.dpdu))), 1e-5f);
    ASSERT_LT(std::abs(glm::dot(p.normalL, glm::normalize(p.dpdv))), 1e-5f);
  }
  EXPECT_GT(hits, 20'000);
}

TEST_P(Shapes, TheFirstPointIsFound) {
  if (!GetParam().isClosed || !isDefined(GetParam().info->name))
    GTEST_SKIP() << "an open shape, or one that is not defined here";
  LocalShape local(GetParam());
  Inputs inputs(2);
  int crossed = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto box = GetParam().info->box(GetParam().shape);
    const auto within = [&] {
      const glm::vec3 u(inputs.uniform(), inputs.uniform(), inputs.uniform());
      return glm::mix(box[0], box[1], u);
    };
    const glm::vec3 target = within(), from = within();
    const glm::vec3 origin = i % 2 == 0 ? from : 3.0f * from;
    const glm::vec3 dir = glm::normalize(target - origin);
    const auto inside = [&](double t) {
      const glm::dvec3 at = glm::dvec3(origin) + t * glm::dvec3(dir);
      const bool is = isInside(GetParam().info->name, at);
      EXPECT_EQ(GetParam().info->isInside(GetParam().shape, at), is);
      return is;
    };
    constexpr double kStep = 0.002;
    double low = 0.0, high = -1.0;
    for (double t = kStep; t < 8.0; t += kStep) {
      if (inside(t) != inside(0.0)) {
        low = t - kStep;
        high = t;
        break;
      }
    }
    rl::Hit hit{};
    const bool found = local.d->shapeIntersect(local.shape, rayOf(origin, dir), hit);
    if (high < 0.0) continue;  // thin corners fall between the steps
    ++crossed;
    for (int k = 0; k < 40; ++k) {
      const double middle = 0.5 * (low + high);
      (inside(middle) == inside(0.0) ? low : high) = middle;
    }
    ASSERT_TRUE(found) << "ray " << i;
    if (double(hit.t) < low - kStep) continue;  // an earlier corner that the steps passed over
    ASSERT_NEAR(hit.t, high, 1e-4) << "ray " << i;
    const rl::ShapePoint p = local.d->shapePoint(local.shape, idOf(hit));
    ASSERT_EQ(glm::dot(p.normalL, dir) > 0.0f, inside(0.0)) << "the normal points outside";
  }
  EXPECT_GT(crossed, 300);
}

TEST_P(Shapes, TheStandInFacesOutside) {
  LocalShape local(GetParam());
  const MeshGeometry mesh = GetParam().info->standIn(GetParam().shape);
  int compared = 0;
  double area = 0.0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    const glm::vec3 n = glm::cross(b - a, c - a);
    area += 0.5 * double(glm::length(n));
    if (!(glm::length(n) > 1e-6f)) continue;
    const glm::vec3 unit = glm::normalize(n), centre = (a + b + c) / 3.0f;
    rl::Hit hit{};
    rl::Ray ray = rayOf(centre + 0.2f * unit, -unit);
    ray.tMax = 0.4f;
    ASSERT_TRUE(local.d->shapeIntersect(local.shape, ray, hit));
    const rl::ShapePoint p = local.d->shapePoint(local.shape, idOf(hit));
    EXPECT_GT(glm::dot(p.normalL, unit), 0.5f);
    ++compared;
  }
  EXPECT_GT(compared, 1);
  // The density over the whole surface tells the true area where draws are uniform: from inside.
  const rl::ShapePoint any = local.d->shapePoint(local.shape, {0, 0, {0.5f, 0.5f}});
  const float density = local.d->shapeDensity(local.shape, glm::vec3(0.0f, 0.0f, 0.5f), any);
  EXPECT_NEAR(area * double(density), 1.0, 0.02);
}

TEST_P(Shapes, TheFineMeshHasItsNormalsAndTextureCoordinates) {
  LocalShape local(GetParam());
  const MeshGeometry mesh = fineMesh(GetParam().shape);
  int compared = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    const auto mean = [&](const auto& of) { return (of[t.x] + of[t.y] + of[t.z]) / 3.0f; };
    const glm::vec3 n = glm::normalize(mean(mesh.normals)), at = mean(mesh.positions);
    rl::Hit hit{};
    rl::Ray ray = rayOf(at + 0.1f * n, -n);
    ray.tMax = 0.2f;
    ASSERT_TRUE(local.d->shapeIntersect(local.shape, ray, hit));
    const rl::ShapePoint p = local.d->shapePoint(local.shape, idOf(hit));
    ASSERT_LT(glm::distance(p.normalL, n), 0.03f);
    const glm::vec2 uv = mean(mesh.uvs[0]);
    // Coordinates turn fast at a pole.
    if (glm::length(glm::vec2(at)) < 0.5f && GetParam().info->name != "cube" &&
        GetParam().info->name != "rectangle")
      continue;
    EXPECT_NEAR(p.uv.x, uv.x, 0.01f);
    EXPECT_NEAR(p.uv.y, uv.y, 0.01f);
    ++compared;
  }
  EXPECT_GT(compared, 1);
}

// Counts draws in cells of the ids' coordinates, against the integral of the density over each.
void expectDrawsFit(const ShapeCase& of, const glm::vec3& receiver, const std::string& what) {
  LocalShape local(of);
  constexpr int kIdCells = 12, kFine = 8, kN = kIdCells * kFine;
  constexpr uint64_t kDraws = 200'000;
  std::vector<double> expected;
  std::vector<uint64_t> counts;
  std::map<uint32_t, size_t> firstOf;
  double total = 0.0;
  for (uint32_t part = 0; part < 6; ++part) {
    const size_t first = expected.size();
    std::vector<double> cells(size_t{kIdCells} * kIdCells, 0.0);
    double sum = 0.0;
    for (int y = 0; y < kN; ++y) {
      for (int x = 0; x < kN; ++x) {
        const auto at = [&](double dx, double dy) {
          return local.d->shapePoint(local.shape,
                                     {0, part, {float((x + dx) / kN), float((y + dy) / kN)}});
        };
        const rl::ShapePoint middle = at(0.5, 0.5);
        const bool isRound = (of.info->name == "disk") || (part != 0 && of.info->name != "cube");
        if (isRound && glm::length(glm::vec2(middle.posL)) > 1.0f) continue;
        const glm::dvec3 du = glm::dvec3(at(0.9, 0.5).posL) - glm::dvec3(at(0.1, 0.5).posL);
        const glm::dvec3 dv = glm::dvec3(at(0.5, 0.9).posL) - glm::dvec3(at(0.5, 0.1).posL);
        const double area = glm::length(glm::cross(du, dv)) / 0.64;
        const double p = double(local.d->shapeDensity(local.shape, receiver, middle)) * area;
        cells[size_t(y / kFine) * kIdCells + size_t(x / kFine)] += p;
        sum += p;
      }
    }
    const bool exists = part == 0 || of.info->name == "cube" ||
                        (!of.shape.values.empty() && of.shape.values[0] > 0.0f &&
                         part <= (of.info->name == "cylinder" ? 2u : 1u));
    if (!exists) break;
    firstOf[part] = first;
    expected.insert(expected.end(), cells.begin(), cells.end());
    total += sum;
  }
  EXPECT_NEAR(total, 1.0, 0.01) << what << ": the density must integrate to 1";
  for (double& p : expected) p /= total;
  counts.assign(expected.size(), 0);
  Inputs inputs(3);
  for (uint64_t i = 0; i < kDraws; ++i) {
    const rl::SurfaceId id = local.d->shapeDraw(local.shape, receiver, inputs.square());
    ASSERT_TRUE(firstOf.count(id.primitive));
    ASSERT_TRUE(id.bary.x >= 0.0f && id.bary.x <= 1.0f && id.bary.y >= 0.0f && id.bary.y <= 1.0f);
    const auto cell = [](float v) { return std::min(int(v * kIdCells), kIdCells - 1); };
    ++counts[firstOf[id.primitive] + size_t(cell(id.bary.y)) * kIdCells + size_t(cell(id.bary.x))];
  }
  // Cells at the rim of a disk and at a horizon are integrated coarsely: they are joined.
  std::vector<uint64_t> joinedCounts(1, 0);
  std::vector<double> joined(1, 0.0);
  for (size_t i = 0; i < expected.size(); ++i) {
    const double actual = double(counts[i]) / double(kDraws);
    const bool isWhole = expected[i] > 0.7 / double(expected.size()) && expected[i] > 1e-3;
    if (isWhole) {
      joinedCounts.push_back(counts[i]);
      joined.push_back(expected[i]);
      EXPECT_NEAR(actual, expected[i], 0.15 * expected[i] + 1e-3) << what << ": cell " << i;
    } else {
      joinedCounts[0] += counts[i];
      joined[0] += expected[i];
    }
  }
  double relative = 0.0;
  for (size_t i = 1; i < joined.size(); ++i)
    relative += (double(joinedCounts[i]) / double(kDraws) - joined[i]) / joined[i];
  EXPECT_LT(std::abs(relative / double(joined.size() - 1)), 0.02) << what;
}

TEST_P(Shapes, DrawsFitTheirDensity) {
  for (const glm::vec3& receiver : {glm::vec3(0.2f, 0.1f, 0.4f), glm::vec3(3.0f, -2.0f, 1.5f),
                                    glm::vec3(0.3f, 0.2f, -40.0f), glm::vec3(1.1f, 0.9f, 0.2f)})
    expectDrawsFit(GetParam(), receiver, GetParam().name + " from z " + std::to_string(receiver.z));
}

// A shape in a scene of its own, and a speck that keeps the scene's origin where it is.
std::shared_ptr<const CompiledScene> placedShape(const ShapeCase& of, const glm::dmat4& toWorld,
                                                 float emission = 0.0f) {
  builtin::SceneBuilder builder("shape");
  rl::Material material = builtin::lambert(glm::vec3(0.5f));
  material.emission = glm::vec3(emission);
  const uint32_t id = builder.addMaterial("grey", material);
  builder.place("it", builder.addGeometry(makeShape(of.shape, "it")), id, toWorld);
  return CompiledScene::build(builder.finish());
}

TEST_P(Shapes, NoneHitsItselfAtAnySize) {
  if (!GetParam().info->isConvex) GTEST_SKIP() << "a ray may meet it again";
  uint64_t left = 0, selfHits = 0, missed = 0, aimed = 0;
  Inputs inputs(4);
  for (int exponent = -13; exponent <= 17; exponent += 3) {
    for (const double distance : {0.0, 1.0, 100.0}) {
      const double size = std::exp2(exponent);
      glm::dmat4 m =
          glm::translate(glm::dmat4(1.0), distance * size * glm::dvec3(0.48, -0.6, 0.64));
      m = glm::rotate(m, 6.28 * inputs.uniform(), glm::dvec3(inputs.direction()));
      m = glm::scale(m, size * glm::dvec3(1.0, inputs.scale(0.3f, 1.0f), -0.7));
      const auto scene = placedShape(GetParam(), m);
      Dialect<> d(scene);
      const glm::dmat3 linear(m);
      for (int i = 0; i < 1500; ++i) {
        const glm::vec3 inside =
            GetParam().isClosed ? glm::vec3(0.05f, 0.1f, 0.3f) : glm::vec3(0.1f, 0.2f, 0.0f);
        const glm::vec3 centre(glm::dvec3(m * glm::dvec4(glm::dvec3(inside), 1.0)) -
                               scene->origin());
        const glm::vec3 dir = inputs.direction();
        rl::Hit hit{};
        d->traceRay(rayOf(centre - dir * float(size) * inputs.scale(2.0f, 50.0f), dir),
                    rl::RL_RAY_PATH, 0, hit);
        ++aimed;
        if (hit.instance == rl::RL_INVALID) {
          ++missed;
          continue;
        }
        const rl::Surface s = d->surfaceLoad(hit, dir);
        if (s.isFront == 0u) continue;
        const glm::vec3 flat = inputs.direction();
        const float lift = inputs.below(2) == 0 ? 1.0f : inputs.scale(1e-6f, 1.0f);
        const glm::vec3 above =
            flat - s.nGeoW * (glm::dot(s.nGeoW, flat) - lift * std::abs(glm::dot(s.nGeoW, flat)));
        const glm::vec3 out = glm::normalize(above);
        if (glm::dot(s.nGeoW, out) < 0.0f) continue;  // by rounding
        rl::Hit next{};
        d->traceRay(rayOf(d->surfaceOffset(s.posW, s.nGeoW, s.posError, out), out), rl::RL_RAY_PATH,
                    0, next);
        ++left;
        if (next.instance != rl::RL_INVALID) ++selfHits;
      }
    }
  }
  EXPECT_GT(left, 10'000u);
  EXPECT_EQ(selfHits, 0u) << "of " << left;
  EXPECT_TRUE(!GetParam().isClosed || missed == 0u) << missed << " of " << aimed;
}

TEST_P(Shapes, ClosedOnesDoNotLeak) {
  if (!GetParam().isClosed) GTEST_SKIP() << "an open shape";
  Inputs inputs(5);
  glm::dmat4 m = glm::translate(glm::dmat4(1.0), glm::dvec3(3.0, -2.0, 1.0));
  m = glm::scale(glm::rotate(m, 0.7, glm::dvec3(0.3, 0.9, -0.2)), glm::dvec3(1.5, 0.7, 1.1));
  const auto scene = placedShape(GetParam(), m);
  Dialect<> d(scene);
  uint64_t escaped = 0, rays = 0;
  for (int path = 0; path < 20'000; ++path) {
    glm::vec3 at(glm::dvec3(m * glm::dvec4(0.1, 0.05, 0.3, 1.0)) - scene->origin());
    glm::vec3 dir = inputs.direction();
    for (int bounce = 0; bounce < 10; ++bounce) {
      rl::Hit hit{};
      d->traceRay(rayOf(at, dir), rl::RL_RAY_PATH, 0, hit);
      ++rays;
      if (hit.instance == rl::RL_INVALID) {
        ++escaped;
        break;
      }
      const rl::Surface s = d->surfaceLoad(hit, dir);
      dir = inputs.directionAbove(s.nGeoW);
      at = d->surfaceOffset(s.posW, s.nGeoW, s.posError, dir);
    }
  }
  EXPECT_GT(rays, 150'000u);
  EXPECT_EQ(escaped, 0u) << "of " << rays;
}

INSTANTIATE_TEST_SUITE_P(, Shapes, testing::ValuesIn(shapeCases()),
                         [](const auto& one) { return one.param.name; });

const ShapeCase& shapeNamed(const std::string& name) {
  static const std::vector<ShapeCase> all = shapeCases();
  for (const ShapeCase& one : all)
    if (one.name == name) return one;
  throw std::logic_error(name);
}

// Mean of the irradiance of light samples at a receiver, without visibility, and its error.
std::pair<double, double> irradianceOf(Dialect<>& d, const glm::vec3& posW, const glm::vec3& n) {
  constexpr int kSamples = 60'000;
  double sum = 0.0, sum2 = 0.0;
  for (uint32_t i = 0; i < kSamples; ++i) {
    rl::LightReceiver receiver;
    receiver.posW = posW;
    receiver.normalW = n;
    receiver.isTwoSided = 0;
    rl::Rng rng{};
    rng.key = glm::uvec2(i * 2654435761u, 77u);
    const rl::LightSample s = d->lightSample(rng, receiver);
    const rl::LightConnection c = d->lightConnect(s, posW);
    const double cosine = std::max(double(glm::dot(n, c.dirW)), 0.0);
    const double e =
        c.pdfSolidAngle > 0.0f ? double(c.emitted.x) * cosine / double(c.pdfSolidAngle) : 0.0;
    sum += e;
    sum2 += e * e;
  }
  const double mean = sum / kSamples;
  return {mean, std::sqrt(std::max(sum2 / kSamples - mean * mean, 0.0) / kSamples)};
}

// Lambert's formula for a polygon that is above the horizon, radiance 1.
double polygonIrradiance(const std::vector<glm::dvec3>& corners, const glm::dvec3& p,
                         const glm::dvec3& n) {
  double sum = 0.0;
  for (size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 a = glm::normalize(corners[i] - p),
                     b = glm::normalize(corners[(i + 1) % corners.size()] - p);
    sum += std::acos(glm::dot(a, b)) * glm::dot(glm::normalize(glm::cross(a, b)), n);
  }
  return std::abs(0.5 * sum);
}

TEST(ShapeLights, IrradianceIsThatOfTheFormula) {
  const auto expectIrradiance = [](const std::string& kind, const glm::dmat4& m,
                                   const glm::dvec3& p, const glm::dvec3& n, double expected) {
    const auto scene = placedShape(shapeNamed(kind), m, 1.0f);
    Dialect<> d(scene);
    const auto [mean, error] = irradianceOf(d, glm::vec3(p - scene->origin()), glm::vec3(n));
    EXPECT_NEAR(mean, expected, 5.0 * error + 1e-5 * expected) << kind;
    EXPECT_LT(error, 0.02 * expected) << kind;
  };
  const glm::dvec3 up(0.0, 1.0, 0.0);
  // A sphere of radius 0.5 at a height of 3, seen under 30 degrees.
  const glm::dvec3 centre(std::sqrt(3.0), 3.0, 0.0);
  expectIrradiance("sphere", glm::scale(glm::translate(glm::dmat4(1.0), centre), glm::dvec3(0.5)),
                   glm::dvec3(0.0), up, kPi * 0.25 / 12.0 * std::cos(kPi / 6.0));
  // A disk of radius 0.5 that faces the receiver.
  glm::dmat4 down = glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 2.0, 0.0)),
                                0.5 * kPi, glm::dvec3(1.0, 0.0, 0.0));
  expectIrradiance("disk", glm::scale(down, glm::dvec3(0.5)), glm::dvec3(0.0), up,
                   kPi * 0.25 / (4.0 + 0.25));
  const glm::dmat4 place = glm::scale(down, glm::dvec3(1.5, 0.8, 1.0));
  std::vector<glm::dvec3> corners;
  for (const glm::dvec2& c : {glm::dvec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
    corners.emplace_back(place * glm::dvec4(c, 0.0, 1.0));
  const glm::dvec3 receiver(0.7, 0.2, -0.4), tilted = glm::normalize(glm::dvec3(0.2, 1.0, 0.1));
  expectIrradiance("rectangle", place, receiver, tilted,
                   polygonIrradiance(corners, receiver, tilted));
}

// Close to a lamp the drawn points lie within a thousandth of its radius.
TEST(ShapeLights, ReceiversNearASphereAreLitRight) {
  for (const double height : {1e-2, 1e-3, 1e-4, 2e-5, 1e-6}) {
    const auto scene = placedShape(shapeNamed("sphere"), glm::dmat4(1.0), 1.0f);
    Dialect<> d(scene);
    const glm::dvec3 up = glm::normalize(glm::dvec3(0.3, 0.8, -0.4));
    const glm::vec3 posW(-(1.0 + height) * up - scene->origin());
    const double distance = glm::length(glm::dvec3(posW) + scene->origin());
    const auto [mean, error] = irradianceOf(d, posW, glm::vec3(up));
    EXPECT_NEAR(mean, kPi / (distance * distance), 5.0 * error + 0.003 * kPi) << height;
  }
}

// A ray that passes the front of a half transparent ball may still be stopped by its back.
TEST(ShapeAlpha, BothSidesDecide) {
  builtin::SceneBuilder builder("veil");
  rl::Material veil = builtin::lambert(glm::vec3(0.5f));
  veil.alpha = 0.5f;
  veil.flags |= rl::RL_MATERIAL_ALPHA_BLEND;
  const uint32_t id = builder.addMaterial("veil", veil);
  builder.place("ball", builder.addGeometry(makeShape(*findShape("sphere"), {}, "ball")), id,
                glm::dmat4(1.0));
  Dialect<> d(CompiledScene::build(builder.finish()));
  Inputs inputs(7);
  int passed = 0, first = 0;
  constexpr int kRays = 20'000;
  for (int i = 0; i < kRays; ++i) {
    const glm::vec3 dir = inputs.direction();
    const rl::Ray ray = rayOf(-4.0f * dir + 0.3f * inputs.direction(), dir);
    rl::Hit hit{};
    d->traceRay(ray, rl::RL_RAY_PATH, inputs.bits(), hit);
    passed += hit.instance == rl::RL_INVALID ? 1 : 0;
    first += hit.instance != rl::RL_INVALID && hit.t < 4.0f ? 1 : 0;
    rl::Hit unused{};
    rl::Ray shadow = ray;
    shadow.tMax = 10.0f;
    ASSERT_FLOAT_EQ(d->traceRay(shadow, rl::RL_RAY_SHADOW, 0, unused), 0.25f);
  }
  EXPECT_NEAR(double(first) / kRays, 0.5, 0.02);
  EXPECT_NEAR(double(passed) / kRays, 0.25, 0.02);
}

// A camera between a ball and the triangles that stand in for it is in the ball.
TEST(ShapeBodies, ReachToTheSurface) {
  builtin::SceneBuilder builder("ball");
  const uint32_t id = builder.addMaterial("glass", builtin::glass(0.0f, glm::vec3(1.0f)));
  builder.place("ball", builder.addGeometry(makeShape(*findShape("sphere"), {}, "ball")), id,
                glm::scale(glm::dmat4(1.0), glm::dvec3(2.0)));
  const auto scene = CompiledScene::build(builder.finish());
  Inputs inputs(8);
  for (int i = 0; i < 200; ++i) {
    const glm::vec3 n = inputs.direction();
    EXPECT_NE(scene->bodiesAt(1.9999f * n - glm::vec3(scene->origin())).x, 0u);
    EXPECT_EQ(scene->bodiesAt(2.0001f * n - glm::vec3(scene->origin())).x, 0u);
  }
}

TEST(ShapeLights, DensityIsThatOfTheHit) {
  for (const ShapeCase& of : shapeCases()) {
    glm::dmat4 m = glm::translate(glm::dmat4(1.0), glm::dvec3(1.0, 4.0, -2.0));
    m = glm::scale(glm::rotate(m, 1.1, glm::dvec3(0.2, 0.5, 0.8)), glm::dvec3(0.5, 0.8, -1.2));
    const auto scene = placedShape(of, m, 3.0f);
    Dialect<> d(scene);
    Inputs inputs(6);
    int compared = 0;
    for (uint32_t i = 0; i < 5000; ++i) {
      rl::LightReceiver receiver;
      receiver.posW = 6.0f * inputs.direction();
      receiver.normalW = -glm::normalize(receiver.posW);
      receiver.isTwoSided = 1;
      rl::Rng rng{};
      rng.key = glm::uvec2(i * 2654435761u, 5u);
      const rl::LightSample s = d->lightSample(rng, receiver);
      const rl::LightConnection c = d->lightConnect(s, receiver.posW);
      rl::Hit hit{};
      d->traceRay(rayOf(receiver.posW, c.dirW), rl::RL_RAY_PATH, 0, hit);
      if (hit.instance == rl::RL_INVALID || std::abs(hit.t - c.distance) > 1e-3f) continue;
      const rl::Surface surface = d->surfaceLoad(hit, c.dirW);
      const float cosine = std::abs(glm::dot(surface.nGeoW, c.dirW));
      if (cosine < 0.02f || surface.id.primitive != s.id.primitive) continue;
      const float pdf =
          d->lightPdfOfHit(surface.light, surface.id, receiver, surface.nGeoW, c.dirW, hit.t);
      ASSERT_NEAR(pdf / c.pdfSolidAngle, 1.0f, 5e-3f) << of.name;
      ++compared;
    }
    EXPECT_GT(compared, 1000) << of.name;
  }
}

}  // namespace
}  // namespace restlab::unit
