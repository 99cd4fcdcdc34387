#include "experiments/view/redirect_file.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include "core/base/error.h"
#include "core/image/io/atomic_file.h"
#include "experiments/report/text.h"

namespace restlab {

namespace {

namespace fs = std::filesystem;

fs::path folderOfUser() {
  const char* runtime = std::getenv("XDG_RUNTIME_DIR");
  std::error_code status;
  if (runtime != nullptr && fs::is_directory(runtime, status)) return runtime;
  return fs::temp_directory_path();
}

}  // namespace

RedirectFile::RedirectFile(const std::string& url) {
  constexpr const char* kExtension = ".html";
  std::string name = (folderOfUser() / "restlab-view-XXXXXX.html").string();
  // mkstemps() makes the file readable for its owner only, from the start.
  const int file = mkstemps(name.data(), int(std::strlen(kExtension)));
  if (file < 0) failInput(fmt::format("{}: cannot be written: {}", name, std::strerror(errno)));
  path_ = name;
  addTemporaryFile(path_);
  const std::string page = fmt::format(
      "<!doctype html>\n<meta charset=\"utf-8\">\n<meta http-equiv=\"refresh\" "
      "content=\"0;url={0}\">\n<title>restlab view</title>\n<a href=\"{0}\">restlab view</a>\n",
      escapeMarkup(url));
  const bool isWritten = write(file, page.data(), page.size()) == ssize_t(page.size());
  if (close(file) != 0 || !isWritten) {
    std::error_code ignored;
    fs::remove(path_, ignored);
    forgetTemporaryFile(path_);
    failInput(fmt::format("{}: cannot be written", name));
  }
}

RedirectFile::~RedirectFile() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
  forgetTemporaryFile(path_);
}

}  // namespace restlab
