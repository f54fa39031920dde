// Settings of a paper, or of published code, under one name: configs/presets/NAME.json, with any of a
// config's keys `frame`, `ism`, those of every case, and a method's own parameters.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/json.h"

namespace vsglbench {

// "papers/mfis16" …, in alphabetical order.
std::vector<std::string> preset_names();

// The keys of a preset. Throws Error(config) naming the nearest preset where there is none of that name; that
// names the file where it holds a wrong type or value.
Json load_preset(const std::string& name);
Json read_preset(const std::filesystem::path& file);

// What `object` of `doc` (the root at "", or an entry at its JSON pointer) gets from the preset that it
// names; an empty object where it names none. Throws doc.error().
Json preset_of(const JsonDocument& doc, const Json& object, const std::string& at);

}  // namespace vsglbench
