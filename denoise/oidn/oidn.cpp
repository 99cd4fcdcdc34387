// oidn: Intel Open Image Denoise, a network that was trained on path-traced images. The network
// sees one frame with its guides, and runs on the processor whatever the backend is. Built only
// where CMake finds the library.
#include <OpenImageDenoise/oidn.hpp>

#include <fmt/format.h>

#include <memory>

#include "core/base/error.h"
#include "core/frame/denoiser.h"
#include "denoise/common/settings.h"

namespace restlab {

const DenoiserInfo& oidnDenoiserInfo();

namespace {

struct OidnSettings {
  std::string quality = "high";
};

const Schema<OidnSettings>& schema() {
  static const Schema<OidnSettings> all = {Parameter<OidnSettings>(
      &OidnSettings::quality, "oidn_quality", Choices{"fast", "balanced", "high"},
      "the library's modes: fast and balanced are less exact than high",
      "the library's own default")};
  return all;
}

oidn::Quality qualityOf(const ParameterMap& parameters) {
  const std::string name = schema().read(parameters).quality;
  if (name == "fast") return oidn::Quality::Fast;
  return name == "balanced" ? oidn::Quality::Balanced : oidn::Quality::High;
}

// The library's device and its filter, kept from frame to frame: both take long to make.
class Network {
 public:
  Network(int threads, oidn::Quality quality) : device_(oidn::newDevice(oidn::DeviceType::CPU)) {
    check();
    if (threads > 0) device_.set("numThreads", threads);
    device_.commit();
    check();
    filter_ = device_.newFilter("RT");
    check();
    filter_.set("hdr", true);
    filter_.set("quality", quality);
  }

  Image run(const HostFrame& frame) {
    Image shown(frame.radiance.width, frame.radiance.height);
    set("color", frame.radiance);
    set("albedo", frame.albedo);
    set("normal", frame.normalW);
    set("output", shown);
    // The network is built for the first frame; later frames of its size only change addresses.
    filter_.commit();
    filter_.execute();
    check();
    return shown;
  }

 private:
  // Sets an input or output by its name. The library takes all of them as writable memory, and its
  // CPU device reads the host's.
  void set(const char* name, const Image& image) {
    filter_.setImage(name, const_cast<glm::vec3*>(image.pixels.data()), oidn::Format::Float3,
                     image.width, image.height);
  }

  // Throws the device's error, also of a device that could not be created.
  void check() {
    const char* message = nullptr;
    if (device_.getError(message) == oidn::Error::None) return;
    throw Error(ExitCode::deviceUnavailable,
                fmt::format("Open Image Denoise: {}", message != nullptr ? message : "no reason"));
  }

  oidn::DeviceRef device_;
  oidn::FilterRef filter_;
};

}  // namespace

const DenoiserInfo& oidnDenoiserInfo() {
  static const DenoiserInfo info = [] {
    DenoiserInfo i;
    i.name = "oidn";
    i.summary = "Intel Open Image Denoise: a network, over the frame alone";
    i.biasOfStillView = BiasClass::biased;
    i.biasOfMovingView = BiasClass::biased;
    i.why = "a network averages neighbours";
    i.parameters = schema().infos();
    append(i.parameters, demodulateSchema().infos());
    i.parameters.back().help =
        "reflectances that the network is told: none, the diffuse one, or that and the specular "
        "one at normal incidence";
    i.parameters.back().source = "the library's manual: what it asks for of metals";
    i.needsFeatures = true;
    i.onHost = [](int threads, const ParameterMap& p) -> HostFilter {
      const auto network = std::make_shared<Network>(threads, qualityOf(p));
      return [network](const HostFrame& frame) { return network->run(frame); };
    };
    return i;
  }();
  return info;
}

}  // namespace restlab
