#include "experiments/runner/registries/registries.h"

#include <variant>

#include "core/scene/shapes/shape_info.h"
#include "core/scene/scene_file/scene_file.h"
#include "core/backend/backend.h"
#include "core/frame/cache.h"
#include "core/frame/denoiser.h"
#include "core/frame/integrator.h"
#include "core/frame/method_settings.h"
#include "core/frame/transport_settings.h"
#include "core/image/metrics/metrics.h"
#include "experiments/runner/base/bias_name.h"

namespace restlab {

using Json = nlohmann::ordered_json;

Json parameterValueJson(const ParameterValue& value) {
  return std::visit([](const auto& one) { return Json(one); }, value);
}

Json parameterJson(const ParameterInfo& parameter) {
  Json json = {{"name", parameter.name}};
  json["default"] = parameterValueJson(parameter.defaultValue);
  if (parameter.defaultValue.index() == 1 || parameter.defaultValue.index() == 2) {
    json["range"] = {parameter.minValue, parameter.maxValue};
  }
  if (!parameter.choices.empty()) json["choices"] = parameter.choices;
  json["help"] = parameter.help;
  json["source"] = parameter.source;
  return json;
}

namespace {

Json parametersJson(const std::vector<ParameterInfo>& all) {
  Json parameters = Json::array();
  for (const ParameterInfo& parameter : all) parameters.push_back(parameterJson(parameter));
  return parameters;
}

Json layersJson(const PartInfo& part) {
  Json layers = Json::array();
  for (const LayerInfo& layer : part.layers) {
    layers.push_back({{"name", layer.name}, {"unit", layer.unit}, {"help", layer.summary}});
    if (layer.enabledIf.parameter != nullptr)
      layers.back()["only_with"] = layer.enabledIf.parameter;
  }
  return layers;
}

}  // namespace

Json transportSettingsJson() { return parametersJson(transportSchema().infos()); }

Json integratorsJson() {
  Json all = Json::array();
  for (const IntegratorInfo* info : integratorRegistry()) {
    Json modes = Json::array();
    for (const ModeInfo& mode : info->modes) {
      modes.push_back({{"name", mode.name}, {"bias", biasName(mode.bias)}, {"why", mode.why}});
    }
    all.push_back({{"name", info->name},
                   {"summary", info->summary},
                   {"uses_cache", info->usesCache},
                   {"leaves_out", info->leavesOut},
                   {"modes", modes},
                   {"parameters", parametersJson(parametersOf(*info))},
                   {"layers", layersJson(*info)}});
  }
  return all;
}

Json cachesJson() {
  Json all = Json::array();
  for (const CacheInfo* cache : cacheRegistry()) {
    all.push_back({{"name", cache->name},
                   {"summary", cache->summary},
                   {"parameters", parametersJson(parametersOf(*cache))},
                   {"layers", layersJson(*cache)}});
  }
  return all;
}

Json backendsJson() {
  Json all = Json::array();
  for (const BackendInfo& backend : backendRegistry()) {
    Json json = {
        {"name", backend.name}, {"summary", backend.description}, {"available", backend.available}};
    json["devices"] = backend.devices;
    if (!backend.available) json["why_not"] = backend.whyNot;
    all.push_back(json);
  }
  return all;
}

Json denoisersJson() {
  Json all = Json::array();
  for (const DenoiserInfo* denoiser : denoiserRegistry()) {
    all.push_back({{"name", denoiser->name},
                   {"summary", denoiser->summary},
                   {"available", true},
                   {"bias_still", biasName(denoiser->biasOfStillView)},
                   {"bias_moving", biasName(denoiser->biasOfMovingView)},
                   {"why", denoiser->why},
                   {"parameters", parametersJson(parametersOf(*denoiser))}});
  }
  for (const MissingDenoiser& missing : missingDenoisers()) {
    all.push_back({{"name", missing.name},
                   {"summary", missing.summary},
                   {"available", false},
                   {"why_not", missing.whyNot}});
  }
  return all;
}

Json shapesJson() {
  Json all = Json::array();
  for (const ShapeInfo& info : shapeRegistry()) {
    Json parameters = Json::array();
    for (const ShapeParameter& p : info.parameters) {
      parameters.push_back({{"name", p.name},
                            {"default", p.fallback},
                            {"range", {p.lo, p.hi}},
                            {"type", "number"},
                            {"help", p.help}});
    }
    all.push_back({{"name", info.name},
                   {"summary", info.summary},
                   {"source", ""},
                   {"breaks", Json::array()},
                   {"parameters", parameters}});
  }
  return all;
}

Json closuresJson() {
  using Kind = ClosureParameter::Kind;
  Json all = Json::array();
  for (const MaterialKind& kind : materialKinds()) {
    Json parameters = Json::array();
    for (const ClosureParameter& p : kind.parameters) {
      Json parameter = {{"name", p.name}};
      if (p.kind == Kind::table || p.kind == Kind::material) {
        parameter["default"] = p.isOptional ? "none" : "to be given";
      } else if (p.kind == Kind::choice) {
        parameter["default"] = p.choices.at(size_t(p.fallback));
        parameter["choices"] = p.choices;
      } else {
        parameter["default"] = p.fallback;
        parameter["range"] = {p.lo, p.hi};
      }
      parameter["type"] = p.kind == Kind::color      ? "colour"
                          : p.kind == Kind::number   ? "number"
                          : p.kind == Kind::table    ? "file"
                          : p.kind == Kind::material ? "material"
                                                     : "choice";
      parameter["help"] = p.help;
      parameters.push_back(parameter);
    }
    Json breaks = Json::array();
    if (kind.closure != nullptr) breaks = kind.closure->brokenLaws;
    Json json = {{"name", kind.name},
                 {"summary", kind.summary},
                 {"source", kind.source},
                 {"breaks", breaks},
                 {"parameters", parameters}};
    if (!breaks.empty() && !kind.closure->brokenWhere.empty())
      json["breaks_where"] = kind.closure->brokenWhere + " = " + kind.closure->brokenIf;
    all.push_back(json);
  }
  return all;
}

Json metricsJson() {
  Json all = Json::array();
  for (const MetricInfo& metric : metricRegistry()) {
    all.push_back({{"name", metric.name},
                   {"summary", metric.formula},
                   {"higher_is_better", metric.higherIsBetter},
                   {"needs_runs", metric.needsRuns}});
  }
  return all;
}

}  // namespace restlab
