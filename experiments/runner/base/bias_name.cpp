#include "experiments/runner/base/bias_name.h"

namespace restlab {

const char* biasName(BiasClass bias) {
  switch (bias) {
    case BiasClass::unbiased:
      return "unbiased";
    case BiasClass::consistent:
      return "consistent";
    case BiasClass::biased:
      break;
  }
  return "biased";
}

}  // namespace restlab
