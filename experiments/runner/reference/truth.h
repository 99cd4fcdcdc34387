// References that are not rendered from the measured scene, but known in another way.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/runner/reference/reference.h"
#include "experiments/runner/suite/suite.h"

namespace restlab {

// Removes `scale`, `radiance` and `move` from the scene of a request.
SceneRequest withoutRelations(SceneRequest request);
// Returns the factor that `radiance` in a scene's name applies to its image; 1 without it.
double radianceFactor(const std::string& scene);

// Returns whether the scene has a `scale` or a `move`. Lengths of a camera path then differ from
// the plain scene's.
bool isElsewhere(const std::string& scene);

// Returns why `truth` is not available for this view; "" if it is. `plain`: prepared from
// withoutRelations().
std::string whyNoTruth(Truth truth, const SceneRequest& request, const PreparedScene& plain,
                       const ReferenceConfig& config);

// Returns the scene without its relations, in the light of the measured frame, for which the truth
// is known. `prepared`: the scene itself. A moving camera of that frame is set in `config`. Throws
// Error (badUsage) at the place in the suite if the requested truth is not available for this view.
PreparedScene plainOf(const Suite& suite, const SuiteScene& scene, const PreparedScene& prepared,
                      ReferenceConfig& config);

// Returns the exact image as a reference without noise: both halves equal it.
Reference exactReference(const SceneRequest& request, const PreparedScene& plain,
                         const ReferenceConfig& config);
// Returns the bound of the error of a pixel of an exact image, as radiance; 0 for any other
// reference.
double exactError(const Reference& reference);
// Returns `reference` times `factor`, its noise included.
Reference multiplied(Reference reference, double factor);

// Names the file in a folder of results that is rendered for Truth::same, with the camera on the
// path of that name.
constexpr const char* kPlainReference = "-plain";
std::string plainLabel(const SceneRequest& request, const std::string& path,
                       const PreparedScene& plain, const ReferenceConfig& config);

// Returns where a reference comes from, for tables: "in closed form", "of the scene without ...,
// 256 spp", "256 spp".
std::string originOf(const Reference& reference);

}  // namespace restlab
