#include "core/scene/mitsuba/mitsuba.h"

#include <algorithm>
#include <string>
#include <vector>

#include "core/scene/mitsuba/mesh_files.h"
#include "tests/fuzz/entries.h"
#include "tests/fuzz/input_file.h"

namespace restlab::fuzz {
namespace {

std::vector<uint8_t> bytesOf(const uint8_t* bytes, size_t count) { return {bytes, bytes + count}; }

// Reads a mesh or its error; later steps must bear what was read.
template <class Read>
bool isMeshRead(const char* name, const Read& read) {
  return isRead(name, ExitCode::badInput, [&] {
    mitsuba::Report report;
    MeshGeometry mesh = read(report);
    mitsuba::completeNormals(mesh);
    mitsuba::addTangents(mesh);
    mitsuba::checkMesh(mesh, name, report);
  });
}

}  // namespace

bool readMitsuba(const uint8_t* bytes, size_t count) {
  const uint8_t* end = std::find(bytes, bytes + count, uint8_t(0));
  const std::string settings(end == bytes + count ? end : end + 1, bytes + count);
  const std::filesystem::path file = inputFile("x.xml", bytes, size_t(end - bytes));
  return isRead(file, ExitCode::badInput, [&] { loadMitsuba(file, settings); });
}

bool readObjMesh(const uint8_t* bytes, size_t count) {
  return isMeshRead("x.obj", [&](mitsuba::Report& report) {
    return mitsuba::readObj(bytesOf(bytes, count), "x.obj", report);
  });
}

bool readPlyMesh(const uint8_t* bytes, size_t count) {
  return isMeshRead("x.ply", [&](mitsuba::Report& report) {
    return mitsuba::readPly(bytesOf(bytes, count), "x.ply", report);
  });
}

bool readSerializedMesh(const uint8_t* bytes, size_t count) {
  return isMeshRead("x.serialized", [&](mitsuba::Report& report) {
    return mitsuba::readSerialized(bytesOf(bytes, count), 0, "x.serialized", report);
  });
}

}  // namespace restlab::fuzz
