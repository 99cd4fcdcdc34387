#include "core/base/share_folder.h"

#include <dlfcn.h>
#include <link.h>

#include <system_error>

namespace restlab {

namespace fs = std::filesystem;

namespace {
const char kHere = 0;  // its address lies in the file
}  // namespace

fs::path fileOfThisCode() {
  std::error_code status;
  Dl_info info;
  link_map* object = nullptr;
  const bool isKnown =
      dladdr1(&kHere, &info, reinterpret_cast<void**>(&object), RTLD_DL_LINKMAP) != 0;
  // The program itself has no name.
  if (isKnown && object != nullptr && object->l_name[0] != '\0')
    return fs::canonical(object->l_name, status);
  return fs::read_symlink("/proc/self/exe", status);
}

const fs::path& shareFolder() {
  static const fs::path folder = [] {
    std::error_code status;
    fs::path above = fileOfThisCode().parent_path();
    for (int i = 0; i < 2 && above.has_relative_path(); ++i) {
      above = above.parent_path();
      const fs::path share = above / "share" / "restlab";
      if (fs::is_directory(share / "suites", status)) return share;
    }
    return fs::path();
  }();
  return folder;
}

}  // namespace restlab
