// Files in memory for tinygltf, whose versions ask for more and more of them.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "core/scene/tinygltf.h"

namespace restlab::gltf {

// Answers of whoever has the files; `user` is handed on to each.
struct FileAnswers {
  tinygltf::FileExistsFunction exists;
  tinygltf::ExpandFilePathFunction path;
  tinygltf::ReadWholeFileFunction read;
  bool (*size)(size_t* bytes, std::string* error, const std::string& name, void* user);
  void* user;
};

// Nothing is written; tinygltf 2.9 takes no callbacks without it.
inline bool refuseToWrite(std::string* error, const std::string& name,
                          const std::vector<unsigned char>&, void*) {
  if (error) *error += name + " is not written";
  return false;
}

// Makes the loader read through `answers` alone. Returns whether it takes them.
template <class Loader>
bool serveFiles(Loader& loader, const FileAnswers& answers) {
  tinygltf::FsCallbacks callbacks = {};
  callbacks.FileExists = answers.exists;
  callbacks.ExpandFilePath = answers.path;
  callbacks.ReadWholeFile = answers.read;
  callbacks.WriteWholeFile = refuseToWrite;
  callbacks.user_data = answers.user;
  // Since 2.9, with a limit of 2 GB that 2.7 does not have.
  const auto addSize = [&](auto& all) {
    if constexpr (requires { all.GetFileSizeInBytes; }) all.GetFileSizeInBytes = answers.size;
  };
  addSize(callbacks);
  if constexpr (requires { loader.SetMaxExternalFileSize(size_t(0)); })
    loader.SetMaxExternalFileSize(std::numeric_limits<size_t>::max());
  if constexpr (requires { bool(loader.SetFsCallbacks(callbacks)); }) {
    return loader.SetFsCallbacks(callbacks);
  } else {
    loader.SetFsCallbacks(callbacks);
    return true;
  }
}

}  // namespace restlab::gltf
