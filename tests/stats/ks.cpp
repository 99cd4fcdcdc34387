#include "tests/stats/ks.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace restlab::stats {
namespace {

constexpr size_t kExactLimit = 400;

// Returns P(D_n < d) = n!/n^n times the middle entry of H^n, where n d = k - h, 0 <= h < 1, and H
// has 2k - 1 rows: 1/(i-j+1)! on and below the first superdiagonal, with the first column and the
// last row corrected for h. The factors are applied one at a time to a row vector, and each is
// scaled by a step of n!/n^n, so that nothing overflows.
double exactLowerTail(double d, size_t n) {
  const double nd = double(n) * d;
  const size_t k = size_t(std::floor(nd)) + 1;
  const size_t m = 2 * k - 1;
  const double h = double(k) - nd;
  std::vector<double> inverseFactorial(m + 2, 1.0);
  for (size_t i = 1; i < inverseFactorial.size(); ++i) {
    inverseFactorial[i] = inverseFactorial[i - 1] / double(i);
  }
  std::vector<std::vector<double>> H(m, std::vector<double>(m, 0.0));
  for (size_t i = 0; i < m; ++i) {
    for (size_t j = 0; j < m && j <= i + 1; ++j) H[i][j] = inverseFactorial[i + 1 - j];
  }
  for (size_t i = 0; i < m; ++i) {
    const double correction = std::pow(h, double(i + 1)) * inverseFactorial[i + 1];
    H[i][0] -= correction;
    H[m - 1][m - 1 - i] -= correction;
  }
  if (2.0 * h > 1.0) H[m - 1][0] += std::pow(2.0 * h - 1.0, double(m)) * inverseFactorial[m];

  std::vector<double> row(m, 0.0);
  row[k - 1] = 1.0;
  for (size_t step = 1; step <= n; ++step) {
    std::vector<double> next(m, 0.0);
    for (size_t i = 0; i < m; ++i) {
      for (size_t j = 0; j < m && j <= i + 1; ++j) next[j] += row[i] * H[i][j];
    }
    for (double& value : next) value *= double(step) / double(n);
    row = std::move(next);
  }
  return std::clamp(row[k - 1], 0.0, 1.0);
}

// Returns Kolmogorov's limit distribution, 2 sum (-1)^(j-1) exp(-2 j^2 x^2).
double limitUpperTail(double x) {
  if (x < 0.2) return 1.0;  // 1 - 5e-13
  double sum = 0.0;
  for (int j = 1; j <= 100; ++j) {
    const double term = std::exp(-2.0 * double(j) * double(j) * x * x);
    sum += j % 2 == 1 ? term : -term;
    if (term < 1e-17) break;
  }
  return std::clamp(2.0 * sum, 0.0, 1.0);
}

}  // namespace

double ksUpperTail(double d, size_t n) {
  if (n == 0) throw std::invalid_argument("ksUpperTail: no values");
  if (d <= 0.0) return 1.0;
  if (d >= 1.0) return 0.0;
  const double rootN = std::sqrt(double(n));
  const double corrected = d * (rootN + 0.12 + 0.11 / rootN);
  // Far in the tail 1 - P loses all digits, and a large d needs a large matrix.
  if (n > kExactLimit || corrected > 2.4) return limitUpperTail(corrected);
  return 1.0 - exactLowerTail(d, n);
}

KsResult ksUniformTest(std::span<const double> values) {
  if (values.empty()) throw std::invalid_argument("ksUniformTest: no values");
  std::vector<double> sorted(values.begin(), values.end());
  for (const double v : sorted) {
    if (!(v >= 0.0 && v <= 1.0)) throw std::invalid_argument("ksUniformTest: value not in [0, 1]");
  }
  std::sort(sorted.begin(), sorted.end());
  KsResult r;
  const double n = double(sorted.size());
  for (size_t i = 0; i < sorted.size(); ++i) {
    r.statistic = std::max({r.statistic, double(i + 1) / n - sorted[i], sorted[i] - double(i) / n});
  }
  r.pValue = ksUpperTail(r.statistic, sorted.size());
  return r;
}

}  // namespace restlab::stats
