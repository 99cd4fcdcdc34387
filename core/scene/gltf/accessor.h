// Bounds-checked reads of accessors: strided, sparse, normalised, quantised.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/scene/gltf/document.h"
#include "core/scene/gltf/report.h"

namespace restlab::gltf {

// Checks every accessor: its elements and those of its sparse part lie inside their buffer views,
// sparse indices increase and stay below the count. After this, a reader made of any accessor
// cannot reach outside a buffer.
void checkAccessors(const tinygltf::Model& model, Report& report);

// Warns of numbers outside an accessor's declared bounds, and of NaN and infinity in accessors that
// are not imported (imported ones are checked when read, with a better place).
void surveyAccessors(const tinygltf::Model& model, Report& report);

// Reads elements of one accessor. checkAccessors() must have accepted the model, and the model must
// outlive the reader.
class AccessorReader {
 public:
  AccessorReader(const tinygltf::Model& model, int accessor);

  size_t count() const { return accessor_->count; }
  int components() const { return components_; }
  int componentType() const { return accessor_->componentType; }
  bool normalized() const { return accessor_->normalized; }

  // Value of a component. Integers are converted, and divided by their largest value when
  // normalised (-128 and -32768 become -1).
  float number(size_t element, int component) const;
  // Value of a component as stored, never divided.
  double storedNumber(size_t element, int component) const;
  // First component of an unsigned integer accessor.
  uint32_t index(size_t element) const;

 private:
  const uint8_t* elementBytes(size_t element) const;
  size_t componentOffset(int component) const;

  const tinygltf::Accessor* accessor_;
  int components_;
  const uint8_t* base_ = nullptr;  // null: elements are zero except for the sparse ones
  size_t stride_ = 0;
  size_t elementStride_ = 0;             // stride of packed elements
  std::vector<uint32_t> sparseIndices_;  // increasing
  const uint8_t* sparseValues_ = nullptr;
};

// "{VEC3, FLOAT}" for error lines.
std::string formatOf(const tinygltf::Accessor& accessor);

}  // namespace restlab::gltf
