// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <random>

namespace homeward
{

/**
 * A seeded stream of random numbers. Streams of one seed with different names are independent, so
 * that one more draw in one place changes nothing in another.
 */
class Random
{
public:
  /** The stream `stream` of `seed`. */
  Random(std::uint64_t seed, std::uint32_t stream)
  {
    std::seed_seq sequence{static_cast<std::uint32_t>(seed),
                           static_cast<std::uint32_t>(seed >> 32U), stream};
    m_engine.seed(sequence);
  }

  /** Uniform in [low, high). */
  double uniform(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(m_engine);
  }

  /** Normal with mean 0 and the standard deviation given. */
  double normal(double sigma)
  {
    return std::normal_distribution<double>(0.0, 1.0)(m_engine) * sigma;
  }

  /** 64 random bits. */
  std::uint64_t bits() { return m_engine(); }

private:
  std::mt19937_64 m_engine;
};

} // namespace homeward
