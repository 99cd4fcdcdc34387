// Registries, as `restlab list` shows them.
#include "core/scene/scene.h"
#include "experiments/python/bindings.h"
#include "experiments/python/call.h"
#include "experiments/python/values.h"
#include "experiments/runner/registries/registries.h"

namespace restlab::python {

namespace py = pybind11;

namespace {

using Json = nlohmann::ordered_json;

py::list scenes() {
  py::list all;
  for (const std::string& name : builtinSceneNames()) {
    py::dict scene, parameters;
    for (const SceneParameter& parameter : builtinSceneParameters(name))
      parameters[strOf(parameter.name)] = strOf(parameter.summary);
    scene["name"] = strOf(name);
    scene["summary"] = strOf(builtinSceneSummary(name));
    scene["parameters"] = parameters;
    all.append(scene);
  }
  return all;
}

}  // namespace

void addLists(py::module_& module) {
  module.def("scenes", &scenes,
             "Built-in scenes: name, summary, and parameters, which go behind the name "
             "('furnace?albedo=0.9').");
  struct Registry {
    const char* name;
    Json (*list)();
    const char* help;
  };
  for (const Registry& registry :
       {Registry{"integrators", integratorsJson, "Integrators: modes, parameters, layers."},
        Registry{"caches", cachesJson, "Caches of reservoirs: parameters, layers."},
        Registry{"denoisers", denoisersJson, "Denoisers: bias, parameters."},
        Registry{"backends", backendsJson, "Backends and their devices."}}) {
    module.def(
        registry.name,
        [list = registry.list] {
          if (list == backendsJson) useVulkan();  // asks for its devices
          return py::list(objectOf(list()));
        },
        registry.help);
  }
}

}  // namespace restlab::python
