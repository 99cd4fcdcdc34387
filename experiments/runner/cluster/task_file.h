// The result of a task as one file: a tar of task.json and the folders of its jobs. It appears in a
// shared folder by a rename, whole or not at all.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace restlab {

// Packs the files below `folder` into `file`. `head`: contents of task.json, which gets the sizes
// and hashes of all files. Of several writers the first one's file stays, if it is sound. Throws
// Error (badInput) that names the file, e.g. if the disk is full.
void packTask(const std::filesystem::path& file, nlohmann::ordered_json head,
              const std::filesystem::path& folder);

// Returns task.json of the file, without looking at the rest. Throws Error (badInput).
nlohmann::ordered_json readTaskHead(const std::filesystem::path& file);

// Returns why the file is damaged, one line; "" if every byte is as it was packed.
std::string whyDamaged(const std::filesystem::path& file);

// Unpacks the files into `folder`, where none of them may exist. Throws Error (badInput) if the
// file is damaged or has names that lead elsewhere; what was written by then stays.
void unpackTask(const std::filesystem::path& file, const std::filesystem::path& folder);

}  // namespace restlab
