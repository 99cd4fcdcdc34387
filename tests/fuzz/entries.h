// Readers of untrusted files as functions of bytes, for libFuzzer (CMakeLists.txt) and for the
// committed seeds (seeds_test.cpp).
#pragma once

#include <cstddef>
#include <cstdint>

namespace restlab::fuzz {

// Returns true if the bytes were read, false if they were refused as the manual promises: an Error
// with the right exit code and one line of text. Throws anything else, which ends libFuzzer or
// fails a test.
using Entry = bool (*)(const uint8_t* bytes, size_t count);

bool readGltf(const uint8_t* bytes, size_t count);     // .gltf or .glb, up to the compiled scene
bool readSuite(const uint8_t* bytes, size_t count);    // .toml
bool readHdr(const uint8_t* bytes, size_t count);      // an environment, .hdr
bool readExr(const uint8_t* bytes, size_t count);      // .exr
bool readCommand(const uint8_t* bytes, size_t count);  // from a page to the viewer
// Streams of compressed geometry, behind numbers of two bytes. Draco: triangles, vertices, bits of
// more attributes; meshopt: mode and filter, elements, bytes of each.
bool readDraco(const uint8_t* bytes, size_t count);
bool readMeshopt(const uint8_t* bytes, size_t count);
bool readTexture(const uint8_t* bytes, size_t count);  // PNG or JPEG
// .scene.toml, and, behind a byte 0, settings behind its name
bool readSceneFile(const uint8_t* bytes, size_t count);
// Mitsuba's XML, and, behind a byte 0, settings behind its name; its meshes.
bool readMitsuba(const uint8_t* bytes, size_t count);
bool readObjMesh(const uint8_t* bytes, size_t count);
bool readPlyMesh(const uint8_t* bytes, size_t count);
// An expression, or, behind an s, a solid made of others.
bool readField(const uint8_t* bytes, size_t count);
// Strands as text, behind a byte for their basis.
bool readCurves(const uint8_t* bytes, size_t count);
// Samples of a solid, .vol.
bool readGridFile(const uint8_t* bytes, size_t count);
bool readSerializedMesh(const uint8_t* bytes, size_t count);

}  // namespace restlab::fuzz
