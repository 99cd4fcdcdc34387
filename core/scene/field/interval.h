// An interval of values of a field.
#pragma once

namespace restlab {

struct FieldRange {
  double low = 0.0, high = 0.0;
};

}  // namespace restlab
