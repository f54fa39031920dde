// What a worker tells of a scene's cases, on its way to the command and in the journal.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "run/scene_run.h"

namespace vsglbench {

// What a worker tells: what has become known, with the time that it has spent so far, and what the validation
// layers have said since its last message.
struct SceneNews {
  std::optional<SceneReport> scene;
  std::optional<ScoredCase> scored;
  std::vector<std::pair<std::string, FrameTimes>> frames;  // timed, by case id
  std::optional<CaseResult> result;
  std::optional<AaPair> aa;
  WallTime wall;
  std::vector<std::string> validation;
};

Json to_json(const SceneNews& news);
void from_json(const Json& json, SceneNews* news);  // throws std::exception for what is none

// Not the time alone.
bool is_worth_noting(const SceneNews& news);

bool has_result(const SceneOutcome& outcome, const std::string& case_id);
// Nothing of a case that has come to an end.
void add(const SceneNews& news, SceneOutcome* outcome);
// The same of what another process was told; throws as from_json().
void take_news(const Json& json, SceneOutcome* outcome);

}  // namespace vsglbench
