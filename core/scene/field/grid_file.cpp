#include "core/scene/field/grid_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "core/base/error.h"

namespace restlab {

namespace {

constexpr uint8_t kGridVersion = 3;
constexpr int32_t kFloat32 = 1, kGridChannels = 1;
constexpr float kFurthest = 1e6f, kMostSample = 1e15f;

static_assert(std::endian::native == std::endian::little, "the format's order of bytes");

struct GridHeader {
  std::array<uint8_t, 4> magic{'V', 'O', 'L', kGridVersion};
  int32_t encoding = kFloat32;
  std::array<int32_t, 3> samples{};
  int32_t channels = kGridChannels;
  std::array<float, 6> box{};
};
static_assert(sizeof(GridHeader) == kGridHeaderBytes);

class GridReader {
 public:
  GridReader(const std::vector<uint8_t>& bytes, const std::string& file)
      : bytes_(bytes), file_(file) {}

  SampledGrid read() {
    if (bytes_.size() < 3 || std::memcmp(bytes_.data(), "VOL", 3) != 0)
      fail("does not begin with 'VOL': no grid of samples");
    if (bytes_.size() < kGridHeaderBytes)
      fail(fmt::format("ends within its header: {} bytes of {}", bytes_.size(), kGridHeaderBytes));
    GridHeader header;
    std::memcpy(&header, bytes_.data(), sizeof header);
    if (header.magic[3] != kGridVersion)
      fail(fmt::format("version {}; {} expected", header.magic[3], kGridVersion));
    if (header.encoding != kFloat32)
      fail(fmt::format("encoding {}; {} expected (32-bit floats)", header.encoding, kFloat32));
    if (header.channels != kGridChannels)
      fail(fmt::format("{} channels; {} expected", header.channels, kGridChannels));
    return body(header);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    failInput(fmt::format("{}: {}", file_, what));
  }

  SampledGrid body(const GridHeader& header) const {
    SampledGrid grid;
    uint64_t count = 1;
    for (int c = 0; c < 3; ++c) {
      const int32_t n = header.samples[size_t(c)];
      if (n < 2 || uint64_t(n) > kMostSamples)
        fail(fmt::format("{} samples along {}; from 2 to {} expected", n, "xyz"[c], kMostSamples));
      grid.samples[c] = n;
      count = std::min(count * uint64_t(n), kMostSamples + 1);
      grid.low[c] = double(header.box[size_t(c)]);
      grid.high[c] = double(header.box[size_t(c) + 3]);
    }
    if (count > kMostSamples)
      fail(fmt::format("{} x {} x {} samples; at most {} expected", grid.samples.x, grid.samples.y,
                       grid.samples.z, kMostSamples));
    const uint64_t size = kGridHeaderBytes + 4 * count;
    if (bytes_.size() != size)
      fail(fmt::format("{} bytes; {} expected for {} x {} x {} samples", bytes_.size(), size,
                       grid.samples.x, grid.samples.y, grid.samples.z));
    if (const std::string fault = faultOfGridBox(grid); !fault.empty()) fail(fault);
    grid.values.resize(count);
    std::memcpy(grid.values.data(), bytes_.data() + kGridHeaderBytes, 4 * count);
    for (uint64_t i = 0; i < count; ++i)
      if (!(std::abs(grid.values[i]) <= kMostSample))
        fail(fmt::format("sample {} is {}; numbers of at most {:g} expected", i, grid.values[i],
                         kMostSample));
    return grid;
  }

  const std::vector<uint8_t>& bytes_;
  const std::string& file_;
};

}  // namespace

std::string faultOfGridBox(const SampledGrid& grid) {
  const glm::dvec3 cell = (grid.high - grid.low) / glm::dvec3(grid.samples - 1);
  for (int c = 0; c < 3; ++c) {
    const double far = std::max(std::abs(grid.low[c]), std::abs(grid.high[c]));
    if (!(far <= double(kFurthest)))
      return fmt::format("its box reaches from {:g} to {:g} along {}; at most {:g} expected",
                         grid.low[c], grid.high[c], "xyz"[c], kFurthest);
    if (!(cell[c] > 1e-5 * far) || !(cell[c] > 1e-9))
      return fmt::format(
          "its cells are {:g} wide along {}, from {:g} to {:g}; 1/100000 of the "
          "coordinates expected at least",
          cell[c], "xyz"[c], grid.low[c], grid.high[c]);
  }
  return "";
}

SampledGrid readGrid(const std::vector<uint8_t>& bytes, const std::string& file) {
  return GridReader(bytes, file).read();
}

std::vector<uint8_t> gridBytes(const SampledGrid& grid) {
  GridHeader header;
  for (int c = 0; c < 3; ++c) {
    header.samples[size_t(c)] = grid.samples[c];
    header.box[size_t(c)] = float(grid.low[c]);
    header.box[size_t(c) + 3] = float(grid.high[c]);
  }
  std::vector<uint8_t> bytes(kGridHeaderBytes + 4 * grid.values.size());
  std::memcpy(bytes.data(), &header, sizeof header);
  std::memcpy(bytes.data() + sizeof header, grid.values.data(), 4 * grid.values.size());
  return bytes;
}

}  // namespace restlab
