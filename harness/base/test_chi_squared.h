// Tests only: how large χ² may be where counts follow what they are held to.
#pragma once

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>

namespace vsglbench {

// The χ² of `degrees` degrees of freedom that is exceeded as seldom as a normal exceeds z standard
// deviations.
inline double chi_squared_limit(double degrees, double z) {
  using namespace boost::math;
  const chi_squared law(degrees);
  return z > 0 ? quantile(complement(law, cdf(complement(normal(), z)))) : quantile(law, cdf(normal(), z));
}

}  // namespace vsglbench
