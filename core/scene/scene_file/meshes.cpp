#include "core/scene/scene_file/meshes.h"

#include <fmt/format.h>

#include "core/base/memory.h"
#include "core/scene/content_hash.h"
#include "core/scene/crease.h"
#include "core/scene/mitsuba/files.h"
#include "core/scene/mitsuba/mesh_files.h"

namespace restlab {

namespace {

constexpr uint64_t kMostNamedMeshBytes = uint64_t{1} << 32;

MeshGeometry meshOfBytes(const NamedFile& file, mitsuba::Report& report, Scene& scene) {
  const bool isObj = file.name.ends_with(".obj");
  MeshGeometry mesh = isObj ? mitsuba::readObj(file.bytes, file.name, report)
                            : mitsuba::readPly(file.bytes, file.name, report);
  for (std::string& line : report.warnings()) scene.warnings.push_back(std::move(line));
  // Rows of images begin at v = 0 here, and at v = 1 in OBJ files.
  if (isObj)
    for (glm::vec2& uv : mesh.uvs[0]) uv.y = 1.0f - uv.y;
  if (!mesh.normals.empty()) mitsuba::completeNormals(mesh);
  return mesh;
}

}  // namespace

bool isSingleMesh(const std::string& name) {
  return name.ends_with(".obj") || name.ends_with(".ply");
}

NamedFile readNamedFile(const std::string& name, const std::string& place, uint64_t mostBytes,
                        const std::filesystem::path& folder, Scene& scene) {
  mitsuba::Report report;
  mitsuba::Files files(folder, report);
  const std::filesystem::path file = files.find(name, place);
  NamedFile named{file.string(), files.read(file, place, mostBytes)};
  scene.contentHash = hashBytes(named.bytes.data(), named.bytes.size(), scene.contentHash);
  return named;
}

Scene sceneOfMesh(const std::filesystem::path& file) {
  Scene scene;
  mitsuba::Report report;
  mitsuba::Files files(file.parent_path(), report);
  const NamedFile named{file.string(), files.read(file, "", kMostNamedMeshBytes)};
  scene.geometries.push_back(meshOfBytes(named, report, scene));
  scene.instances.push_back({file.stem().string()});
  return scene;
}

MeshGeometry readMeshFile(const ConfigTable& table, const std::filesystem::path& folder,
                          Scene& scene) {
  const std::string name = table.getString("file", "");
  if (!isSingleMesh(name))
    table.fail("file",
               fmt::format("'{}' is no mesh that is read; an .obj or a .ply expected", name));
  mitsuba::Report report;
  return meshOfBytes(readNamedFile(name, table.place("file"), kMostNamedMeshBytes, folder, scene),
                     report, scene);
}

namespace {

void smooth(const ConfigTable& table, double degrees, MeshGeometry& mesh) {
  static thread_local MemoryGuard memory;  // for all that a thread reads
  constexpr uint64_t kBytes = 400;         // of a triangle: corners, edges, new vertices
  memory.take(table.place("normals"), kBytes * mesh.triangles.size());
  smoothNormals(mesh, degrees);
}

}  // namespace

void readNormals(const ConfigTable& table, MeshGeometry& mesh) {
  if (!table.has("normals")) return;
  const std::vector<std::string> texts = table.getTexts("normals");
  const bool isWord =
      !texts.empty() && !texts[0].empty() && (texts[0].front() == '"' || texts[0].front() == '\'');
  if (!isWord) {
    smooth(table, table.getNumber("normals", 180.0, 0.0, 180.0), mesh);
    return;
  }
  const std::string word = table.getChoice("normals", "file", {"file", "flat", "smooth"});
  if (word == "flat") flattenNormals(mesh);
  if (word == "smooth") smooth(table, 180.0, mesh);
}

}  // namespace restlab
