// The host's side of plugins: which methods there are, and how one is loaded.
//
// A plugin is a file NAME.so in a plugin folder, and NAME is the method's name; a folder NAME beside it holds
// its kernels. Folders in order: those given to set_plugin_path(), $VSGLBENCH_PLUGINS (separated by ':'), and
// the one that came with the programme. In each, names are in alphabetical order; of two plugins of one name
// the first counts, so that a folder of one's own can stand in for a method that came with the programme.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "method/method.h"

namespace vsglbench {

// Folders separated by ':', searched first. Before the first all_methods(). Throws Error(usage) for one that
// does not exist.
void set_plugin_path(const std::string& folders);
std::vector<std::filesystem::path> plugin_folders();

// Every method found, refused ones included, in the order of the search. They are asked once, in a process of
// their own, so that one that crashes or hangs while it loads is refused like any other; `create` is null.
const std::vector<const MethodInfo*>& all_methods();
// Throws Error(config) naming the nearest method. A refused one is returned.
const MethodInfo& find_method(const std::string& name);
// The method that makes importance by lights of this kind: of those that say so the programme's own, else the
// first. Throws Error(config) where there is none.
const MethodInfo& find_importance_maker(LightKind kind);
// One plugin file, as all_methods() would hold it.
MethodInfo inspect_plugin(const std::filesystem::path& library);

// The method with its code loaded into this process. Throws Error(plugin): refused, or the device lacks a
// feature that it needs, each named.
const MethodInfo& load_method(const std::string& name, const DeviceInfo& device);
MethodInfo load_plugin(const std::filesystem::path& library, const DeviceInfo& device);

// Hash of everything that decides what the method does: library and kernels.
std::string plugin_hash(const MethodInfo& method);

// What `list methods --json` shows, and what the inspecting process sends: all but `create`.
Json to_json(const MethodInfo& method);
void from_json(const Json& json, MethodInfo* method);

}  // namespace vsglbench
