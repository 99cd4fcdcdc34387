// Host side of `template`: its description for the program, the tables and the tests.
#include "integrators/template/template.h"

#include "core/frame/frame_graph.h"
#include "core/frame/integrator.h"
#include "core/frame/schema.h"

namespace restlab {

namespace {

// Parameters with their defaults.
struct TemplateSettings {
  double misExponent = 2.0;
};

// Member, name, range, meaning, where the default comes from.
const Schema<TemplateSettings>& schema() {
  static const Schema<TemplateSettings> all = {Parameter<TemplateSettings>(
      &TemplateSettings::misExponent, "mis_exponent", Range{1.0, 8.0},
      "exponent of the MIS weights; 1: balance heuristic", "Veach 1997, section 9.2.3: 2")};
  return all;
}

// Records a frame: its buffers, and its passes in their order.
void recordTemplate(FrameGraph& g, const FrameInfo& f) {
  rl::TemplateParams params{};
  params.misExponent = float(schema().read(f.parameters).misExponent);
  // Name, number of elements, bytes per element.
  const Buffer radiance = g.buffer("radiance", f.pixels, sizeof(glm::vec3));
  // Buffers in the order of TemplateBuffers; name in the time columns, name of rl_add_kernel.
  g.kernels<rl::TemplateBuffers>(params, {radiance})
      .pass("template", "template")
      .writes({radiance});
  g.shared.radiance = radiance;  // what denoisers and the session read
}

}  // namespace

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
    i.parameters = schema().infos();
    i.record = recordTemplate;
    return i;
  }();
  return info;
}

}  // namespace restlab
