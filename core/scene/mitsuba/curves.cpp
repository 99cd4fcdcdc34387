// Mitsuba's bsplinecurve and linearcurve.
#include "core/scene/mitsuba/curves.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/scene/curves/curve_words.h"
#include "core/scene/curves/read_curves.h"
#include "core/scene/shapes/shape_info.h"

namespace restlab::mitsuba {

bool isCurveFile(const std::string& type) {
  return type == "bsplinecurve" || type == "linearcurve";
}

MeshGeometry readCurves(const Bytes& bytes, const std::string& file, const std::string& type,
                        const glm::dmat4& pointsToWorld, glm::dvec3& centre) {
  const StrandBasis basis = type == "linearcurve" ? StrandBasis::linear : StrandBasis::bspline;
  Strands strands = readStrandText(bytes, file, basis);
  glm::dvec3 low(1e300), high(-1e300);
  for (glm::dvec4& p : strands.points) {
    const glm::dvec3 at(pointsToWorld * glm::dvec4(glm::dvec3(p), 1.0));
    p = glm::dvec4(at, p.w);
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  centre = 0.5 * (low + high);
  for (glm::dvec4& p : strands.points) p -= glm::dvec4(centre, 0.0);
  return atPlace(file, [&] {
    return makeShape({findShape("curves"), {}, curveWords(cutStrands(strands, kStrandError))},
                     type);
  });
}

}  // namespace restlab::mitsuba
