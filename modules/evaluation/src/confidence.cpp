// SPDX-License-Identifier: GPL-3.0-or-later
#include <homeward/evaluation/confidence.h>

#include <homeward/core/error.h>

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace homeward
{
namespace
{

constexpr double kUpperQuantile = 0.975; // of both sides, 95 % lie between

}

double Share::value() const
{
  return trials == 0 ? 0.0 : static_cast<double>(successes) / static_cast<double>(trials);
}

Interval Share::interval() const
{
  if (successes > trials) {
    throw LogicError(std::to_string(successes) + " successes of " + std::to_string(trials) +
                     " trials");
  }
  if (trials == 0) {
    return {0.0, 1.0};
  }
  const double z = boost::math::quantile(boost::math::normal(), kUpperQuantile);
  const double n = static_cast<double>(trials);
  const double p = value();
  const double middle = (p + z * z / (2.0 * n)) / (1.0 + z * z / n);
  const double half = z * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n)) / (1.0 + z * z / n);
  return {std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

Mean meanOf(const std::vector<double> &values)
{
  if (!std::all_of(values.begin(), values.end(),
                   [](double value) { return std::isfinite(value); })) {
    throw LogicError("a value to be averaged is not finite");
  }
  Mean mean;
  mean.count = values.size();
  if (values.empty()) {
    return mean;
  }
  const double n = static_cast<double>(values.size());
  mean.value = std::accumulate(values.begin(), values.end(), 0.0) / n;
  if (values.size() >= 2) {
    double squares = 0.0;
    for (const double value : values) {
      squares += (value - mean.value) * (value - mean.value);
    }
    const double t = boost::math::quantile(boost::math::students_t(n - 1.0), kUpperQuantile);
    const double half = t * std::sqrt(squares / (n - 1.0) / n);
    mean.interval = Interval{mean.value - half, mean.value + half};
  }
  return mean;
}

} // namespace homeward
