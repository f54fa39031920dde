#include "scene/track.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vsglbench {
namespace {

using glm::dquat;
using glm::dvec3;

double unit(double v) { return v; }
dvec3 unit(const dvec3& v) { return v; }
dquat unit(const dquat& q) { return q / glm::length(q); }

// a + u (b - a), which is a where both are equal.
template <class T>
T between(const T& a, const T& b, double u) {
  return a + (b - a) * u;
}

// Shoemake 1985, "Animating Rotation with Quaternion Curves", along the shorter arc.
template <>
dquat between(const dquat& from, const dquat& to, double u) {
  if (from == to) return from;
  const dquat a = unit(from);
  dquat b = unit(to);
  if (glm::dot(a, b) < 0) b = -b;
  // The angle from its half's sine and cosine, which both keep their digits however near a and b are.
  const double angle = 2 * std::atan2(glm::length(b - a), glm::length(b + a));
  const double sine = std::sin(angle);
  if (!(sine > 1e-9)) return a + (b - a) * u;
  return (a * std::sin((1 - u) * angle) + b * std::sin(u * angle)) / sine;
}

// Hermite's cubic in the form that is a where b = a and both tangents are 0.
template <class T>
T hermite(const T& a, const T& out, const T& in, const T& b, double span, double u) {
  const double u2 = u * u, u3 = u2 * u;
  return a + (b - a) * (3 * u2 - 2 * u3) + out * (span * (u3 - 2 * u2 + u)) + in * (span * (u3 - u2));
}

bool finite(double v) { return std::isfinite(v); }
bool finite(const dvec3& v) { return finite(v.x) && finite(v.y) && finite(v.z); }
bool finite(const dquat& q) { return finite(q.x) && finite(q.y) && finite(q.z) && finite(q.w); }

template <class T>
bool is_no_rotation(const T&) {
  return false;
}
template <>
bool is_no_rotation(const dquat& q) {
  return !(glm::length(q) > 0 && std::isfinite(glm::length(q)));
}

template <class T>
void align(std::vector<T>*) {}
template <>
void align(std::vector<dquat>* q) {
  for (size_t i = 1; i < q->size(); ++i) {
    if (glm::dot((*q)[i - 1], (*q)[i]) < 0) (*q)[i] = -(*q)[i];
  }
}

}  // namespace

template <class T>
T Track<T>::at(double time) const {
  const size_t next = static_cast<size_t>(std::upper_bound(times.begin(), times.end(), time) - times.begin());
  if (next == 0) return unit(values.front());
  const size_t key = next - 1;
  if (next == times.size() || interpolation == Interpolation::step) return unit(values[key]);
  const double span = times[next] - times[key], u = (time - times[key]) / span;
  if (interpolation == Interpolation::linear) return unit(between(values[key], values[next], u));
  return unit(hermite(values[key], out[key], in[next], values[next], span, u));
}

template <class T>
void smooth(Track<T>* track) {
  track->interpolation = Interpolation::cubic;
  align(&track->values);
  const size_t n = track->values.size();
  track->out.clear();
  for (size_t i = 0; i < n; ++i) {
    const size_t a = i == 0 ? 0 : i - 1, b = std::min(i + 1, n - 1);
    const double span = track->times[b] - track->times[a];
    track->out.push_back((track->values[b] - track->values[a]) * (span > 0 ? 1 / span : 0));
  }
  track->in = track->out;
}

template <class T>
std::string problem_of(const Track<T>& track) {
  const size_t n = track.times.size();
  const size_t tangents = track.interpolation == Interpolation::cubic ? n : 0;
  if (n == 0) return "it has no key";
  if (track.values.size() != n) return fmt::format("{} values stand at {} times", track.values.size(), n);
  if (track.in.size() != tangents || track.out.size() != tangents) return "its tangents are no two a key";
  for (size_t i = 0; i < n; ++i) {
    if (!finite(track.times[i])) return fmt::format("time {} is not finite", i);
    if (i > 0 && !(track.times[i] > track.times[i - 1])) {
      return fmt::format("time {} is {}, which does not come after {}", i, track.times[i],
                         track.times[i - 1]);
    }
    if (!finite(track.values[i])) return fmt::format("value {} is not finite", i);
    if (is_no_rotation(track.values[i])) return fmt::format("quaternion {} has no length", i);
    if (tangents > 0 && !(finite(track.in[i]) && finite(track.out[i]))) {
      return fmt::format("a tangent of key {} is not finite", i);
    }
  }
  return "";
}

template struct Track<double>;
template struct Track<dvec3>;
template struct Track<dquat>;
template void smooth(Track<double>*);
template void smooth(Track<dvec3>*);
template void smooth(Track<dquat>*);
template std::string problem_of(const Track<double>&);
template std::string problem_of(const Track<dvec3>&);
template std::string problem_of(const Track<dquat>&);

}  // namespace vsglbench
