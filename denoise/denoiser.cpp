#include "denoise/denoiser.h"

#include "core/error.h"

namespace restlab {

const DenoiserInfo& findDenoiser(const std::string& name) {
  std::vector<std::string> names;
  for (const DenoiserInfo* info : denoiserRegistry()) {
    if (info->name == name) return *info;
    names.push_back(info->name);
  }
  failUsage("unknown denoiser '" + name + "'" + didYouMean(name, names));
}

}  // namespace restlab
