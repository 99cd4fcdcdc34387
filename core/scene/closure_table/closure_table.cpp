#include "core/scene/closure_table/closure_table.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace restlab {
namespace {

using std::numbers::pi;

double luminance(const glm::dvec3& v) { return 0.2126 * v.x + 0.7152 * v.y + 0.0722 * v.z; }

// theta_h at a coordinate of its axis, in cells.
double thetaHalf(double cells, uint32_t size) {
  const double share = cells / size;
  return share * share * 0.5 * pi;
}

glm::dvec3 directionOf(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

// Nearest value for light from the normal that leaves at an angle: theta_h = theta_d = theta / 2.
glm::dvec3 fromNormal(const ClosureTable& table, double theta) {
  const auto cell = [](double share, uint32_t size) {
    return uint32_t(std::min(share * size, double(size) - 1.0));
  };
  const double share = theta / pi;  // of theta_h and theta_d in 90 degrees
  if (table.angles == TableAngles::half)
    return table.at(cell(std::sqrt(share), table.sizes.x), cell(share, table.sizes.y), 0);
  return table.at(0, cell(2.0 * share, table.sizes.y), 0);
}

// Albedos and roughness for whoever asks how a surface scatters on the whole: the least value is
// taken for a diffuse part, and the width of what rises above it for that of a lobe.
struct Summary {
  glm::dvec3 diffuse{0.0}, specular{0.0};
  double alpha = 1.0;
};

Summary summarise(const ClosureTable& table) {
  constexpr int kSteps = 4096;
  constexpr double kWidest = 80.0 / 180.0 * pi;  // grazing values are the least certain
  const auto angleOf = [](int i) {
    // Narrow lobes need steps that begin small.
    const double share = (i + 0.5) / kSteps;
    return share * share * 0.5 * pi;
  };
  Summary s;
  glm::dvec3 albedo(0.0), least(1e30);
  for (int i = 0; i < kSteps; ++i) {
    const double theta = angleOf(i);
    const glm::dvec3 f = fromNormal(table, theta);
    const double width = (2.0 * i + 1.0) / (double(kSteps) * kSteps) * 0.5 * pi;
    albedo += f * (2.0 * pi * std::sin(theta) * std::cos(theta) * width);
    if (theta < kWidest) least = glm::min(least, f);
  }
  s.diffuse = glm::min(least * pi, albedo);
  s.specular = albedo - s.diffuse;
  const double base = luminance(least), peak = luminance(fromNormal(table, 0.0)) - base;
  if (!(peak > base)) return s;
  // GGX falls to half of its peak where the tangent of theta_h is 0.644 alpha.
  for (int i = 0; i < kSteps; ++i) {
    const double theta = angleOf(i);
    if (luminance(fromNormal(table, theta)) - base > 0.5 * peak) continue;
    s.alpha = std::clamp(std::tan(0.5 * theta) / 0.644, 1e-3, 1.0);
    break;
  }
  return s;
}

// Makes masses cumulative, the last 1. A part is spread evenly, as values between centres may lie
// above both.
void accumulate(std::vector<double>& mass) {
  constexpr double kEven = 0.05;
  double total = 0.0;
  for (const double m : mass) total += m;
  double sum = 0.0;
  for (double& m : mass) {
    const double even = 1.0 / double(mass.size());
    sum += total > 0.0 ? (1.0 - kEven) * m / total + kEven * even : even;
    m = sum;
  }
  mass.back() = 1.0;
}

// Cumulative probabilities of theta_h: of the light that facets of this angle reflect.
std::vector<double> halfCumulative(const ClosureTable& table) {
  const glm::uvec3 n = table.sizes;
  std::vector<double> mass(n.x);
  for (uint32_t i = 0; i < n.x; ++i) {
    double sum = 0.0;
    const uint32_t steep = std::max(1u, n.y * 2u / 3u);  // theta_d below 60 degrees
    for (uint32_t j = 0; j < steep; ++j) {
      for (uint32_t k = 0; k < n.z; ++k) sum += luminance(table.at(i, j, k));
    }
    const double low = std::sin(thetaHalf(i, n.x)), high = std::sin(thetaHalf(i + 1.0, n.x));
    mass[i] = sum / (double(steep) * n.z) * (high * high - low * low);
  }
  accumulate(mass);
  return mass;
}

// Cumulative probabilities of the cells of wi for one theta of wo.
std::vector<double> rowCumulative(const ClosureTable& table, uint32_t i) {
  const glm::uvec3 n = table.sizes;
  std::vector<double> mass;
  mass.reserve(size_t(n.y) * n.z);
  for (uint32_t j = 0; j < n.y; ++j) {
    const double low = std::sin(0.5 * pi * j / n.y), high = std::sin(0.5 * pi * (j + 1.0) / n.y);
    for (uint32_t k = 0; k < n.z; ++k)
      mass.push_back(luminance(table.at(i, j, k)) * (high * high - low * low));
  }
  accumulate(mass);
  return mass;
}

glm::uvec4 recordOf(const glm::dvec3& v, double w) {
  return {std::bit_cast<uint32_t>(float(v.x)), std::bit_cast<uint32_t>(float(v.y)),
          std::bit_cast<uint32_t>(float(v.z)), std::bit_cast<uint32_t>(float(w))};
}

}  // namespace

TableDirections directionsAt(TableAngles angles, const glm::uvec3& sizes, const glm::dvec3& cells) {
  const double second = 0.5 * pi * cells.y / sizes.y;
  const double phi = pi * cells.z / sizes.z;
  if (angles == TableAngles::directions)
    return {directionOf(0.5 * pi * cells.x / sizes.x, 0.0), directionOf(second, phi)};
  // The half vector leans towards +x by theta_h; wi is local to it, wo its mirror image.
  const double theta = thetaHalf(cells.x, sizes.x);
  const glm::dvec3 h = directionOf(theta, 0.0), across(0.0, 1.0, 0.0);
  const glm::dvec3 along(std::cos(theta), 0.0, -std::sin(theta));
  const glm::dvec3 local = directionOf(second, phi);
  const glm::dvec3 wi = along * local.x + across * local.y + h * local.z;
  return {h * (2.0 * glm::dot(h, wi)) - wi, wi};
}

TableDirections directionsOfCell(TableAngles angles, const glm::uvec3& sizes,
                                 const glm::uvec3& cell) {
  return directionsAt(angles, sizes, glm::dvec3(cell) + 0.5);
}

namespace {

// Lifts a direction below the surface to it: cells at the horizon are read from above.
glm::dvec3 lifted(const glm::dvec3& w) {
  return glm::normalize(glm::dvec3(w.x, w.y, std::max(w.z, 0.01)));
}

}  // namespace

ClosureTable tabulate(const BrdfFunction& f, TableAngles angles, const glm::uvec3& sizes) {
  ClosureTable table{"", angles, sizes, {}};
  table.values.reserve(size_t(sizes.x) * sizes.y * sizes.z);
  for (uint32_t i = 0; i < sizes.x; ++i) {
    for (uint32_t j = 0; j < sizes.y; ++j) {
      for (uint32_t k = 0; k < sizes.z; ++k) {
        const TableDirections d = directionsOfCell(angles, sizes, {i, j, k});
        table.values.emplace_back(f(lifted(d.wo), lifted(d.wi)));
      }
    }
  }
  return table;
}

void makeReciprocal(ClosureTable& table) {
  if (table.angles != TableAngles::directions) return;
  const glm::uvec3 n = table.sizes;
  for (uint32_t i = 0; i < n.x; ++i) {
    for (uint32_t j = i + 1; j < n.y; ++j) {
      for (uint32_t k = 0; k < n.z; ++k) {
        glm::vec3& a = table.values[(size_t(i) * n.y + j) * n.z + k];
        glm::vec3& b = table.values[(size_t(j) * n.y + i) * n.z + k];
        a = b = 0.5f * (a + b);
      }
    }
  }
}

std::vector<glm::uvec4> tableRecords(const ClosureTable& table) {
  // The cosine draws what the table does not: all that is diffuse for tables of half vectors.
  const double byCosine = table.angles == TableAngles::half ? 0.4 : 0.1;
  const Summary s = summarise(table);
  std::vector<glm::uvec4> records = {recordOf(s.diffuse, s.alpha), recordOf(s.specular, byCosine)};
  records.reserve(records.size() + table.values.size());
  const bool isHalf = table.angles == TableAngles::half;
  const std::vector<double> halves = isHalf ? halfCumulative(table) : std::vector<double>();
  const size_t slice = size_t(table.sizes.y) * table.sizes.z;
  for (uint32_t i = 0; i < table.sizes.x; ++i) {
    const std::vector<double> row =
        isHalf ? std::vector<double>(slice, halves[i]) : rowCumulative(table, i);
    for (size_t c = 0; c < slice; ++c)
      records.push_back(recordOf(table.values[size_t(i) * slice + c], row[c]));
  }
  return records;
}

}  // namespace restlab
