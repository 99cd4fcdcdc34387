// Files of closure tables: MERL's format, and EXR.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <fstream>
#include <sstream>

#include "core/base/error.h"
#include "core/base/file_reason.h"
#include "core/image/image.h"
#include "core/image/io/atomic_file.h"
#include "core/scene/closure_table/closure_table.h"

namespace restlab {
namespace fs = std::filesystem;
namespace {

static_assert(std::endian::native == std::endian::little, "MERL's files are little-endian");

// Values of the three channels are stored over these.
constexpr std::array<double, 3> kMerlScales = {1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0};
constexpr std::array<int32_t, 3> kMerlHeader = {90, 90, 180};
constexpr size_t kMerlCells = 90 * 90 * 180;

glm::uvec3 cellOf(const glm::uvec3& sizes, size_t i) {
  return {uint32_t(i / (size_t(sizes.y) * sizes.z)), uint32_t(i / sizes.z % sizes.y),
          uint32_t(i % sizes.z)};
}

// How much of a cell lies above the surface, where f has a meaning.
enum class Above : char { all, some, none };

// Judges each cell by its corners.
std::vector<Above> cellsAbove(TableAngles angles, const glm::uvec3& n) {
  std::vector<char> corners;
  corners.reserve(size_t(n.x + 1) * (n.y + 1) * (n.z + 1));
  for (uint32_t i = 0; i <= n.x; ++i) {
    for (uint32_t j = 0; j <= n.y; ++j) {
      for (uint32_t k = 0; k <= n.z; ++k) {
        const TableDirections d = directionsAt(angles, n, {i, j, k});
        corners.push_back(d.wo.z > 1e-9 && d.wi.z > 1e-9 ? 1 : 0);
      }
    }
  }
  std::vector<Above> cells;
  cells.reserve(size_t(n.x) * n.y * n.z);
  for (uint32_t i = 0; i < n.x; ++i) {
    for (uint32_t j = 0; j < n.y; ++j) {
      for (uint32_t k = 0; k < n.z; ++k) {
        int count = 0;
        for (uint32_t c = 0; c < 8; ++c) {
          const size_t x = i + (c & 1u), y = j + (c >> 1u & 1u), z = k + (c >> 2u);
          count += corners[(x * (n.y + 1) + y) * (n.z + 1) + z];
        }
        cells.push_back(count == 8 ? Above::all : count > 0 ? Above::some : Above::none);
      }
    }
  }
  return cells;
}

// Takes a value over into a table. A cell that lies partly below the surface may have none, which
// MERL's files say by a negative number.
void putValue(const fs::path& file, ClosureTable& table, Above above, size_t i, int channel,
              double value) {
  if (above == Above::none || (above == Above::some && value < 0.0)) return;
  const glm::uvec3 cell = cellOf(table.sizes, i);
  if (!(value >= 0.0) || !std::isfinite(value) || value > 1e30)
    failInput(fmt::format(
        "{}: {} of cell ({}, {}, {}) is {:g}; a finite value of at least 0 expected", file.string(),
        std::array{"red", "green", "blue"}[size_t(channel)], cell.x, cell.y, cell.z, value));
  table.values[i][channel] = float(value);
}

ClosureTable readMerl(const fs::path& file, std::ifstream& stream) {
  std::array<int32_t, 3> header{};
  stream.read(reinterpret_cast<char*>(header.data()), sizeof header);
  if (!stream || header != kMerlHeader)
    failInput(
        fmt::format("{}: not a file of the MERL database: it begins with {} {} {}, 90 90 180 "
                    "expected",
                    file.string(), header[0], header[1], header[2]));
  ClosureTable table{file.filename().string(), TableAngles::half, kMerlSizes, {}};
  table.values.resize(kMerlCells);
  const std::vector<Above> above = cellsAbove(table.angles, table.sizes);
  std::vector<double> channel(kMerlCells);
  for (int c = 0; c < 3; ++c) {
    stream.read(reinterpret_cast<char*>(channel.data()),
                std::streamsize(channel.size() * sizeof(double)));
    if (!stream)
      failInput(fmt::format("{}: ends too early: {} bytes expected", file.string(),
                            sizeof header + 3 * kMerlCells * sizeof(double)));
    for (size_t i = 0; i < kMerlCells; ++i)
      putValue(file, table, above[i], i, c, channel[i] * kMerlScales[size_t(c)]);
  }
  if (stream.peek() != std::ifstream::traits_type::eof())
    failInput(fmt::format("{}: goes on after its {} values", file.string(), 3 * kMerlCells));
  return table;
}

glm::uvec3 sizesOf(const fs::path& file, const std::string& text) {
  std::istringstream stream(text);
  std::array<long long, 3> n{};
  std::string rest;
  if (!(stream >> n[0] >> n[1] >> n[2]) || stream >> rest)
    failInput(fmt::format("{}: sizes '{}'; three numbers expected", file.string(), text));
  for (const long long side : n) {
    if (side < 2 || side > kMaxTableSide)
      failInput(
          fmt::format("{}: sizes '{}'; 2 to {} expected", file.string(), text, kMaxTableSide));
  }
  if (n[0] * n[1] * n[2] > kMaxTableCells)
    failInput(fmt::format("{}: sizes '{}' are {} cells; at most {} are supported", file.string(),
                          text, n[0] * n[1] * n[2], kMaxTableCells));
  return {uint32_t(n[0]), uint32_t(n[1]), uint32_t(n[2])};
}

ClosureTable readTableExr(const fs::path& file) {
  const LayeredImage image = readExr(file);
  const auto attribute = [&](const char* key) {
    const auto found = image.metadata.find(key);
    if (found == image.metadata.end())
      failInput(fmt::format("{}: no attribute 'restlab:{}': not a table of a material",
                            file.string(), key));
    return found->second;
  };
  const std::string angles = attribute("table");
  if (angles != "half" && angles != "directions")
    failInput(fmt::format("{}: angles '{}'; half or directions expected", file.string(), angles));
  ClosureTable table{file.filename().string(),
                     angles == "half" ? TableAngles::half : TableAngles::directions,
                     sizesOf(file, attribute("sizes")),
                     {}};
  const glm::uvec3 n = table.sizes;
  if (table.angles == TableAngles::directions && n.x != n.y)
    failInput(fmt::format("{}: sizes '{} {} {}' disagree: wo and wi have the same angles",
                          file.string(), n.x, n.y, n.z));
  const auto found = image.layers.find("");
  if (found == image.layers.end() || found->second.width != n.z ||
      found->second.height != n.x * n.y)
    failInput(fmt::format("{}: its pixels disagree with sizes '{} {} {}': {}x{} R, G, B expected",
                          file.string(), n.x, n.y, n.z, n.z, n.x * n.y));
  const std::vector<Above> above = cellsAbove(table.angles, n);
  table.values.resize(found->second.pixels.size());
  for (size_t i = 0; i < table.values.size(); ++i) {
    for (int c = 0; c < 3; ++c) putValue(file, table, above[i], i, c, found->second.pixels[i][c]);
  }
  makeReciprocal(table);
  return table;
}

}  // namespace

ClosureTable readClosureTable(const fs::path& file) {
  std::error_code error;
  const bool isFile = fs::is_regular_file(file, error);
  std::ifstream stream(file, std::ios::binary);
  if (!isFile || !stream) {
    const std::string reason = unreadableReason(file);
    failInput(fmt::format("{}: {}", file.string(), reason.empty() ? "is not a file" : reason));
  }
  if (file.extension() == ".binary") return readMerl(file, stream);
  if (file.extension() == ".exr") return readTableExr(file);
  failInput(
      fmt::format("{}: .binary (MERL) or .exr (restlab bsdf --tabulate) expected", file.string()));
}

void writeMerl(const fs::path& file, const ClosureTable& table) {
  AtomicFile out(file);
  out.stream().write(reinterpret_cast<const char*>(kMerlHeader.data()), sizeof kMerlHeader);
  for (int c = 0; c < 3; ++c) {
    std::vector<double> channel;
    channel.reserve(table.values.size());
    for (const glm::vec3& v : table.values)
      channel.push_back(double(v[c]) / kMerlScales[size_t(c)]);
    out.stream().write(reinterpret_cast<const char*>(channel.data()),
                       std::streamsize(channel.size() * sizeof(double)));
  }
  out.commit();
}

void writeTableExr(const fs::path& file, const ClosureTable& table) {
  const glm::uvec3 n = table.sizes;
  LayeredImage image;
  Image& pixels = image.layers[""];
  pixels = Image(n.z, n.x * n.y);
  pixels.pixels = table.values;
  image.metadata["table"] = table.angles == TableAngles::half ? "half" : "directions";
  image.metadata["sizes"] = fmt::format("{} {} {}", n.x, n.y, n.z);
  writeExr(file, image);
}

}  // namespace restlab
