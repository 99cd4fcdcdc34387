// Host side of `template`: its description for the program, the tables and the tests.
#include "integrators/template/template.h"

#include "core/frame/integrator.h"

namespace restlab {

const IntegratorInfo& templateIntegratorInfo() {
  static const IntegratorInfo info = [] {
    IntegratorInfo i;
    i.name = "template";
    i.summary = "1 path per pixel and frame, in the fewest lines: to be copied (CONTRIBUTING.md)";
    // The bias tests read the class: unbiased modes are compared with the truth.
    i.modes = {{"unbiased", BiasClass::unbiased,
                "every path up to max_bounces scattering events has positive density in one "
                "technique, and the MIS "
                "weights sum to one"}};
    // Name, default, range, choices (of strings), meaning, where the default comes from.
    i.parameters = {{"mis_exponent",
                     2.0,
                     1.0,
                     8.0,
                     {},
                     "exponent of the MIS weights; 1: balance heuristic",
                     "Veach 1997, section 9.2.3: 2"}};
    // Bytes per pixel; feature bits without which it is not allocated (0: always); the buffer that
    // it trades places with after a frame, for histories (-1: none).
    i.buffers = {{"radiance", sizeof(glm::vec3), 0, -1}};
    // Name in the time columns, name of rl_add_kernel.
    i.passes = {{"template", "template"}};
    i.packParameters = [](const std::string&, const ParameterMap& parameters) {
      rl::TemplateParams out{};
      out.misExponent = static_cast<float>(std::get<double>(parameters.at("mis_exponent")));
      return bytesOf(out);
    };
    return i;
  }();
  return info;
}

}  // namespace restlab
