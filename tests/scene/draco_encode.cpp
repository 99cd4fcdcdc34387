#include "tests/scene/draco_encode.h"

#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>

#include <stdexcept>

namespace restlab::test {
namespace {

template <class T>
void addValues(draco::PointCloud& cloud, draco::GeometryAttribute::Type type, draco::DataType data,
               size_t components, const std::vector<T>& values) {
  if (values.empty()) return;
  draco::GeometryAttribute attribute;
  attribute.Init(type, nullptr, int8_t(components), data, data != draco::DT_FLOAT32,
                 int64_t(components * sizeof(T)), 0);
  const size_t count = values.size() / components;
  const int id = cloud.AddAttribute(attribute, true, uint32_t(count));
  for (size_t i = 0; i < count; ++i) {
    cloud.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(uint32_t(i)),
                                           &values[i * components]);
  }
}

void addAttributes(draco::PointCloud& cloud, const DracoInput& input) {
  cloud.set_num_points(uint32_t(input.positions.size() / 3));
  addValues(cloud, draco::GeometryAttribute::POSITION, draco::DT_FLOAT32, 3, input.positions);
  addValues(cloud, draco::GeometryAttribute::NORMAL, draco::DT_FLOAT32, 3, input.normals);
  addValues(cloud, draco::GeometryAttribute::COLOR, draco::DT_UINT16, 4, input.colors);
}

std::string bytesOf(const draco::Status& status, const draco::EncoderBuffer& buffer) {
  if (!status.ok()) throw std::runtime_error(status.error_msg_string());
  return {buffer.data(), buffer.size()};
}

}  // namespace

DracoInput dracoGrid(uint32_t n) {
  DracoInput grid;
  for (uint32_t y = 0; y <= n; ++y) {
    for (uint32_t x = 0; x <= n; ++x) {
      const float u = float(x) / float(n), v = float(y) / float(n);
      grid.positions.insert(grid.positions.end(), {u, v, 0.0f});
      grid.normals.insert(grid.normals.end(), {0.0f, 0.0f, 1.0f});
      grid.colors.insert(grid.colors.end(),
                         {uint16_t(65535 * x / n), uint16_t(65535 * y / n), 0, 65535});
    }
  }
  for (uint32_t y = 0; y < n; ++y) {
    for (uint32_t x = 0; x < n; ++x) {
      const uint32_t a = y * (n + 1) + x, b = a + 1, c = a + n + 1, d = c + 1;
      grid.triangles.insert(grid.triangles.end(), {a, b, c, b, d, c});
    }
  }
  return grid;
}

std::string dracoMesh(const DracoInput& input, bool isSequential) {
  draco::Mesh mesh;
  addAttributes(mesh, input);
  for (size_t i = 0; i + 2 < input.triangles.size(); i += 3) {
    mesh.AddFace({draco::PointIndex(input.triangles[i]), draco::PointIndex(input.triangles[i + 1]),
                  draco::PointIndex(input.triangles[i + 2])});
  }
  draco::Encoder encoder;
  encoder.SetEncodingMethod(isSequential ? draco::MESH_SEQUENTIAL_ENCODING
                                         : draco::MESH_EDGEBREAKER_ENCODING);
  if (!isSequential) {
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::NORMAL, 10);
  }
  draco::EncoderBuffer buffer;
  const draco::Status status = encoder.EncodeMeshToBuffer(mesh, &buffer);
  return bytesOf(status, buffer);
}

std::string dracoPointCloud(const DracoInput& input) {
  draco::PointCloud cloud;
  addAttributes(cloud, input);
  draco::Encoder encoder;
  draco::EncoderBuffer buffer;
  const draco::Status status = encoder.EncodePointCloudToBuffer(cloud, &buffer);
  return bytesOf(status, buffer);
}

}  // namespace restlab::test
