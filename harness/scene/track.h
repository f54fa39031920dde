// Values keyed over time. Source: Khronos, "glTF 2.0 Specification" (2021), Appendix C.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

namespace vsglbench {

enum class Interpolation { step, linear, cubic };

// A value over time: held before the first key and after the last, so that one key is a constant. T is
// double, dvec3, or dquat, whose keys may have any length but 0, whose `linear` is the spherical one along
// the shorter arc, and whose values have length 1.
template <class T>
struct Track {
  Interpolation interpolation = Interpolation::linear;
  std::vector<double> times;  // seconds, ascending, at least one
  std::vector<T> values;      // one a key
  std::vector<T> in, out;     // of `cubic` only: the tangents before and after each key, per second

  Track() = default;
  explicit Track(const T& constant) : times{0}, values{constant} {}
  bool keyed() const { return times.size() > 1; }

  // Between two equal keys (of `cubic`: with tangents of 0) exactly their value. Not finite, or of a dquat
  // NaN, where the keys lead there: where a cubic leaves the numbers, or passes the zero quaternion.
  T at(double time) const;
};

// Makes a track cubic through its keys (Catmull and Rom 1974): the tangent at a key is the slope between its
// two neighbours, at the ends between the key and its one neighbour. Quaternions are first turned to the sign
// that is nearer to the key before.
template <class T>
void smooth(Track<T>* track);

// What is wrong with a track, in a few words; "" where nothing is: as many times as values and tangents, at
// least one, all finite, times ascending, no quaternion of length 0.
template <class T>
std::string problem_of(const Track<T>& track);

}  // namespace vsglbench
