#include "core/scene/gltf/accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace restlab::gltf {
namespace {

// Limit on the elements of all accessors without buffer view: they cost a file no bytes, and no
// real file overrides zeros so often.
constexpr size_t kMaxElementsWithoutData = size_t(1) << 24;

// Limit on the bytes that all accessors name together, as a multiple of the bytes in all buffers:
// accessors may overlap, and each is read whole.
constexpr uint64_t kMaxReadsOfAByte = 64;
constexpr uint64_t kFreeBytes = uint64_t(1) << 26;  // always allowed: small files load quickly

size_t componentBytes(int componentType) {
  return static_cast<size_t>(
      tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(componentType)));
}

// Returns 0 if the accessor is not a matrix.
size_t matrixRows(const tinygltf::Accessor& accessor) {
  switch (accessor.type) {
    case TINYGLTF_TYPE_MAT2:
      return 2;
    case TINYGLTF_TYPE_MAT3:
      return 3;
    case TINYGLTF_TYPE_MAT4:
      return 4;
    default:
      return 0;
  }
}

// Bytes from the beginning of one element to its end, and to the next when elements are packed. The
// columns of a matrix begin at multiples of four bytes.
struct ElementSize {
  size_t extent, stride;
};

ElementSize elementSize(const tinygltf::Accessor& accessor) {
  const size_t component = componentBytes(accessor.componentType);
  const size_t components =
      static_cast<size_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor.type)));
  const size_t rows = matrixRows(accessor);
  if (rows == 0) return {component * components, component * components};
  const size_t column = (component * rows + 3) / 4 * 4;
  return {column * (rows - 1) + component * rows, column * rows};
}

const uint8_t* viewBytes(const tinygltf::Model& model, int view) {
  const tinygltf::BufferView& bufferView = model.bufferViews[static_cast<size_t>(view)];
  return model.buffers[static_cast<size_t>(bufferView.buffer)].data.data() + bufferView.byteOffset;
}

template <class T>
T load(const uint8_t* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

uint32_t loadUnsigned(const uint8_t* bytes, int componentType) {
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load<uint8_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<uint16_t>(bytes);
    default:
      return load<uint32_t>(bytes);
  }
}

void checkRange(const tinygltf::Model& model, int view, size_t offset, size_t count, size_t stride,
                size_t element, size_t alignment, const std::string& place, Report& report) {
  const tinygltf::BufferView& bufferView = model.bufferViews[static_cast<size_t>(view)];
  const size_t available = bufferView.byteLength;
  if (element > available || offset > available - element ||
      count - 1 > (available - element - offset) / stride) {
    report.fail(place,
                fmt::format("{} elements of {} bytes at offset {} with stride {} reach beyond "
                            "bufferViews[{}], which has {} bytes",
                            count, element, offset, stride, view, available));
  }
  if ((bufferView.byteOffset + offset) % alignment != 0) {
    report.warn("alignment", place,
                fmt::format("begins at byte {} of its buffer, not at a multiple "
                            "of the component's {} bytes",
                            bufferView.byteOffset + offset, alignment));
  }
}

void checkSparse(const tinygltf::Model& model, const tinygltf::Accessor& accessor,
                 const std::string& place, Report& report) {
  const auto& sparse = accessor.sparse;
  const size_t count = static_cast<size_t>(sparse.count);
  if (count > accessor.count) {
    report.fail(place + ".count", fmt::format("{} elements are replaced, but the accessor has {}",
                                              count, accessor.count));
  }
  const size_t indexBytes = componentBytes(sparse.indices.componentType);
  checkRange(model, sparse.indices.bufferView, static_cast<size_t>(sparse.indices.byteOffset),
             count, indexBytes, indexBytes, indexBytes, place + ".indices", report);
  const ElementSize element = elementSize(accessor);
  checkRange(model, sparse.values.bufferView, static_cast<size_t>(sparse.values.byteOffset), count,
             element.stride, element.extent, componentBytes(accessor.componentType),
             place + ".values", report);
  const uint8_t* indices = viewBytes(model, sparse.indices.bufferView) + sparse.indices.byteOffset;
  int64_t previous = -1;
  for (size_t i = 0; i < count; ++i) {
    const int64_t index = loadUnsigned(indices + i * indexBytes, sparse.indices.componentType);
    if (index <= previous) {
      report.fail(place + ".indices", fmt::format("element {} is {} after {}; increasing indices "
                                                  "expected",
                                                  i, index, previous));
    }
    if (static_cast<size_t>(index) >= accessor.count) {
      report.fail(place + ".indices",
                  fmt::format("element {} is {}, but the accessor has {} elements", i, index,
                              accessor.count));
    }
    previous = index;
  }
}

void checkAccessor(const tinygltf::Model& model, size_t index, size_t& elementsWithoutData,
                   Report& report) {
  const tinygltf::Accessor& accessor = model.accessors[index];
  if (accessor.count == 0) return;  // never drawn: gltf_rules.h
  const std::string place = fmt::format("accessors[{}]", index);
  const ElementSize element = elementSize(accessor);
  if (accessor.normalized && (accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT ||
                              accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)) {
    report.fail(place + ".normalized",
                "true, but only 8-bit and 16-bit integers can be normalised");
  }
  if (accessor.bufferView >= 0) {
    const size_t stride = model.bufferViews[static_cast<size_t>(accessor.bufferView)].byteStride;
    if (stride != 0 && stride < element.extent) {
      report.fail(place,
                  fmt::format("elements of {} bytes in bufferViews[{}], whose byteStride is {}",
                              element.extent, accessor.bufferView, stride));
    }
    checkRange(model, accessor.bufferView, accessor.byteOffset, accessor.count,
               stride == 0 ? element.stride : stride, element.extent,
               componentBytes(accessor.componentType), place, report);
  } else if (accessor.count > kMaxElementsWithoutData - elementsWithoutData) {
    report.fail(place + ".count",
                fmt::format("{} elements without a bufferView; at most {} in all accessors are "
                            "accepted",
                            accessor.count, kMaxElementsWithoutData));
  } else {
    elementsWithoutData += accessor.count;
  }
  if (accessor.sparse.isSparse) checkSparse(model, accessor, place + ".sparse", report);
}

// Returns whether `value` lies outside the declared bounds by more than their decimal digits
// explain.
bool outsideBounds(double value, double low, double high) {
  const double tolerance = 1e-4 * std::max({std::abs(low), std::abs(high), high - low, 1e-6});
  return value < low - tolerance || value > high + tolerance;
}

void surveyAccessor(const tinygltf::Model& model, size_t index, Report& report) {
  const tinygltf::Accessor& accessor = model.accessors[index];
  const AccessorReader reader(model, static_cast<int>(index));
  const size_t components = static_cast<size_t>(reader.components());
  const bool hasBounds =
      accessor.minValues.size() == components && accessor.maxValues.size() == components;
  const bool isFloat = accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
  if (!hasBounds && !isFloat) return;
  const std::string place = fmt::format("accessors[{}]", index);
  bool finite = true, inside = true;
  for (size_t element = 0; element < reader.count() && (finite || inside); ++element) {
    for (size_t c = 0; c < components; ++c) {
      const double value = reader.storedNumber(element, static_cast<int>(c));
      if (!std::isfinite(value)) {
        if (finite) {
          report.warn("non-finite accessor", place,
                      fmt::format("element {} is not finite; nothing imported reads it", element));
        }
        finite = false;
      } else if (hasBounds && inside &&
                 outsideBounds(value, accessor.minValues[c], accessor.maxValues[c])) {
        report.warn("accessor bounds", place,
                    fmt::format("component {} of element {} is {:g}, outside the declared bounds "
                                "{:g} to {:g}",
                                c, element, value, accessor.minValues[c], accessor.maxValues[c]));
        inside = false;
      }
    }
    if (!hasBounds && !finite) break;
  }
}

}  // namespace

void checkAccessors(const tinygltf::Model& model, Report& report) {
  uint64_t bytes = 0;
  for (const tinygltf::Buffer& buffer : model.buffers) bytes += buffer.data.size();
  const uint64_t allowed = kMaxReadsOfAByte * bytes + kFreeBytes;
  uint64_t named = 0;
  size_t elementsWithoutData = 0;
  for (size_t i = 0; i < model.accessors.size(); ++i) {
    checkAccessor(model, i, elementsWithoutData, report);
    // checkAccessor() found the range inside a buffer, so no product or sum overflows.
    const tinygltf::Accessor& accessor = model.accessors[i];
    if (accessor.bufferView >= 0) named += uint64_t(accessor.count) * elementSize(accessor).extent;
    if (named > allowed) {
      report.fail(fmt::format("accessors[{}]", i),
                  fmt::format("with those before it names {} bytes of the {} in all buffers; at "
                              "most {} are read",
                              named, bytes, allowed));
    }
  }
}

void surveyAccessors(const tinygltf::Model& model, Report& report) {
  for (size_t i = 0; i < model.accessors.size(); ++i) surveyAccessor(model, i, report);
}

AccessorReader::AccessorReader(const tinygltf::Model& model, int accessor)
    : accessor_(&model.accessors[static_cast<size_t>(accessor)]),
      components_(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(accessor_->type))),
      elementStride_(elementSize(*accessor_).stride) {
  if (accessor_->bufferView >= 0) {
    base_ = viewBytes(model, accessor_->bufferView) + accessor_->byteOffset;
    const size_t stride = model.bufferViews[static_cast<size_t>(accessor_->bufferView)].byteStride;
    stride_ = stride == 0 ? elementStride_ : stride;
  }
  if (!accessor_->sparse.isSparse) return;
  const auto& sparse = accessor_->sparse;
  const uint8_t* indices = viewBytes(model, sparse.indices.bufferView) + sparse.indices.byteOffset;
  const size_t indexBytes = componentBytes(sparse.indices.componentType);
  sparseIndices_.resize(static_cast<size_t>(sparse.count));
  for (size_t i = 0; i < sparseIndices_.size(); ++i) {
    sparseIndices_[i] = loadUnsigned(indices + i * indexBytes, sparse.indices.componentType);
  }
  sparseValues_ = viewBytes(model, sparse.values.bufferView) + sparse.values.byteOffset;
}

const uint8_t* AccessorReader::elementBytes(size_t element) const {
  static constexpr std::array<uint8_t, 64> kZero{};  // the largest element: MAT4 of floats
  const auto it = std::lower_bound(sparseIndices_.begin(), sparseIndices_.end(), element);
  if (it != sparseIndices_.end() && *it == element) {
    return sparseValues_ + static_cast<size_t>(it - sparseIndices_.begin()) * elementStride_;
  }
  return base_ ? base_ + element * stride_ : kZero.data();
}

size_t AccessorReader::componentOffset(int component) const {
  const size_t bytes = componentBytes(accessor_->componentType);
  const size_t rows = matrixRows(*accessor_), c = static_cast<size_t>(component);
  return rows == 0 ? c * bytes : c / rows * (elementStride_ / rows) + c % rows * bytes;
}

double AccessorReader::storedNumber(size_t element, int component) const {
  const uint8_t* bytes = elementBytes(element) + componentOffset(component);
  switch (accessor_->componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return load<int8_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load<uint8_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return load<int16_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<uint16_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return load<uint32_t>(bytes);
    default:
      return load<float>(bytes);
  }
}

float AccessorReader::number(size_t element, int component) const {
  const double stored = storedNumber(element, component);
  if (!accessor_->normalized) return static_cast<float>(stored);
  switch (accessor_->componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return static_cast<float>(std::max(stored / 127.0, -1.0));
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return static_cast<float>(stored / 255.0);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return static_cast<float>(std::max(stored / 32767.0, -1.0));
    default:
      return static_cast<float>(stored / 65535.0);
  }
}

uint32_t AccessorReader::index(size_t element) const {
  return loadUnsigned(elementBytes(element), accessor_->componentType);
}

std::string formatOf(const tinygltf::Accessor& accessor) {
  const char* type = "";
  switch (accessor.type) {
    case TINYGLTF_TYPE_SCALAR:
      type = "SCALAR";
      break;
    case TINYGLTF_TYPE_VEC2:
      type = "VEC2";
      break;
    case TINYGLTF_TYPE_VEC3:
      type = "VEC3";
      break;
    case TINYGLTF_TYPE_VEC4:
      type = "VEC4";
      break;
    case TINYGLTF_TYPE_MAT2:
      type = "MAT2";
      break;
    case TINYGLTF_TYPE_MAT3:
      type = "MAT3";
      break;
    case TINYGLTF_TYPE_MAT4:
      type = "MAT4";
      break;
    default:
      break;
  }
  const char* component = "";
  switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      component = "BYTE";
      break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      component = "UNSIGNED_BYTE";
      break;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      component = "SHORT";
      break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      component = "UNSIGNED_SHORT";
      break;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      component = "UNSIGNED_INT";
      break;
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      component = "FLOAT";
      break;
    default:
      break;
  }
  return fmt::format("{{{}, {}{}}}", type, component, accessor.normalized ? " normalized" : "");
}

}  // namespace restlab::gltf
