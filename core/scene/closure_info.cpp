#include "core/scene/closure_info.h"

#include <algorithm>
#include <utility>

#include "core/dialect/features.h"

namespace restlab {

void ClosureInfo::is(const char* summaryText, const char* sourceText) {
  summary = summaryText;
  source = sourceText;
}
void ClosureInfo::color(const char* parameter, double fallback, const char* help, double most) {
  parameters.push_back({parameter, ClosureParameter::Kind::color, fallback, 0.0, most, {}, help});
}
void ClosureInfo::number(const char* parameter, double fallback, double lo, double hi,
                         const char* help) {
  parameters.push_back({parameter, ClosureParameter::Kind::number, fallback, lo, hi, {}, help});
}
void ClosureInfo::choice(const char* parameter, std::vector<std::string> choices,
                         const char* help) {
  const double last = double(choices.size()) - 1.0;
  parameters.push_back(
      {parameter, ClosureParameter::Kind::choice, 0.0, 0.0, last, std::move(choices), help});
}
void ClosureInfo::table(const char* parameter, const char* help) {
  parameters.push_back(
      {parameter, ClosureParameter::Kind::table, 0.0, 0.0, 0.0, {}, help, /*isOptional=*/false});
}
void ClosureInfo::material(const char* parameter, bool isOptional, const char* help) {
  parameters.push_back(
      {parameter, ClosureParameter::Kind::material, 0.0, 0.0, 0.0, {}, help, isOptional});
}
void ClosureInfo::breaks(std::vector<std::string> laws, const char* parameter, const char* value) {
  brokenLaws = std::move(laws);
  brokenWhere = parameter;
  brokenIf = value;
}
void ClosureInfo::convex(std::vector<std::string> parts) { convexParts = std::move(parts); }
void ClosureInfo::looksAtTangent(const char* parameter) { anisotropicWhere = parameter; }

namespace {

// Each file says in these lines what it is; kernels see the rest of it.
std::vector<ClosureInfo> declaredClosures() {
  std::vector<ClosureInfo> all;
#define RL_CLOSURE_DECLARED
#define RL_CLOSURE_INFO(closure, kindNumber, featureBit) \
  {                                                      \
    ClosureInfo& info = all.emplace_back();              \
    info.name = #closure;                                \
    info.kind = rl::kindNumber;                          \
    info.feature = rl::featureBit;
#define RL_CLOSURE_INFO_END }
#include "closures/declared.inl"
  return all;
}

}  // namespace

const std::vector<ClosureInfo>& closureRegistry() {
  static const std::vector<ClosureInfo> kAll = declaredClosures();
  return kAll;
}

const ClosureInfo* findClosure(const std::string& name) {
  const std::vector<ClosureInfo>& all = closureRegistry();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const ClosureInfo& info) { return info.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace restlab
