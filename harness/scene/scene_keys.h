// Keys in a scene.json: {"interpolation": "cubic", "keys": [{"time": 0, "eye": [0, 1, 2]}, ...]} in whatever
// moves.
#pragma once

#include <string>
#include <vector>

#include "base/json.h"
#include "scene/track.h"

namespace vsglbench {

class KeyList {
 public:
  // Of the value at `at` ("/views/A/camera") of a document that follows the schema; it need not have keys.
  // Error "FILE:LINE: ..." for times that don't ascend, and for keys where the document has no `animation`.
  KeyList(const JsonDocument& document, const std::string& at);

  // The keys that hold `property`, each read by read(pointer); `constant` where none does.
  template <class T, class Read>
  Track<T> track(const std::string& property, const T& constant, const Read& read) const {
    Track<T> track;
    for (const Key& key : keys_) {
      if (!has(key, property)) continue;
      track.times.push_back(key.time);
      track.values.push_back(read(key.at + "/" + property));
    }
    if (track.times.empty()) return Track<T>(constant);
    track.interpolation = interpolation_;
    if (interpolation_ == Interpolation::cubic) smooth(&track);
    return track;
  }

  // Error for the first key that holds `property`, which has no place here.
  void refuse(const std::string& property, const std::string& why) const;

 private:
  struct Key {
    std::string at;  // pointer
    double time;     // seconds
  };
  bool has(const Key& key, const std::string& property) const;

  const JsonDocument& document_;
  Interpolation interpolation_ = Interpolation::linear;
  std::vector<Key> keys_;
};

}  // namespace vsglbench
