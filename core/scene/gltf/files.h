// Files in memory for tinygltf, through the callbacks of its various versions.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "core/scene/gltf/tinygltf.h"

namespace restlab::gltf {

// Callbacks that serve the files; `user` is passed to each.
struct FileAnswers {
  tinygltf::FileExistsFunction exists;
  tinygltf::ExpandFilePathFunction path;
  tinygltf::ReadWholeFileFunction read;
  bool (*size)(size_t* bytes, std::string* error, const std::string& name, void* user);
  void* user;
};

// Refuses to write: tinygltf 2.9 accepts no callbacks without a writer.
inline bool refuseToWrite(std::string* error, const std::string& name,
                          const std::vector<unsigned char>&, void*) {
  if (error) *error += name + " is not written";
  return false;
}

// Makes the loader read only through `answers`. Returns whether the loader accepts the callbacks.
template <class Loader>
bool serveFiles(Loader& loader, const FileAnswers& answers) {
  tinygltf::FsCallbacks callbacks = {};
  callbacks.FileExists = answers.exists;
  callbacks.ExpandFilePath = answers.path;
  callbacks.ReadWholeFile = answers.read;
  callbacks.WriteWholeFile = refuseToWrite;
  callbacks.user_data = answers.user;
  // tinygltf has this callback since 2.9, with a limit of 2 GB that 2.7 does not have.
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
