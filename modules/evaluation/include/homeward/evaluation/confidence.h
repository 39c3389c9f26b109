// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace homeward
{

/** Where a value lies with 95 % confidence. */
struct Interval
{
  double low = 0.0;  ///< lower end
  double high = 0.0; ///< upper end
};

/** So many of so many. */
struct Share
{
  std::size_t successes = 0; ///< trials at most
  std::size_t trials = 0;    ///< of all

  double value() const; ///< 0 to 1; 0 of nothing

  /**
   * Wilson's score interval at 95 %, as if the trials were independent; 0 to 1 of nothing.
   * \cite Wilson1927
   * @throw LogicError when there are more successes than trials
   */
  Interval interval() const;
};

/** The mean of a measured value. */
struct Mean
{
  double value = 0.0;               ///< 0 of nothing
  std::size_t count = 0;            ///< of measurements
  std::optional<Interval> interval; ///< Student's, 95 %; nothing of fewer than two
};

/** @throw LogicError for a value that is not finite */
Mean meanOf(const std::vector<double> &values);

} // namespace homeward
