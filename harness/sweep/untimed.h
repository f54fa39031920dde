// Tests only: a report without what is measured by a clock, or says when and where.
#pragma once

#include "report/report.h"

namespace vsglbench {

inline Json untimed(const Report& report) {
  Json json = to_json(report);
  for (const char* key : {"created", "argv", "wall", "analysis", "environment"}) json.erase(key);
  for (Json& scene : json["scenes"]) {
    for (const char* key : {"warnings", "clocks", "effects_priced", "contact"}) scene.erase(key);
  }
  if (json.contains("aa"))
    for (Json& pair : json["aa"]) pair.erase("times");
  for (Json& c : json["cases"]) {
    for (const char* key : {"passes", "frame", "stopping"}) c.erase(key);
    if (!c.contains("generate")) continue;
    for (const char* key : {"gbuffer_ms", "rsm_ms", "total"}) c["generate"].erase(key);
  }
  return json;
}

}  // namespace vsglbench
