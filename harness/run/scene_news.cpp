#include "run/scene_news.h"

#include <algorithm>

namespace vsglbench {
namespace {

Json frame_json(const std::string& id, const FrameTimes& frame) {
  Json passes = Json::array();
  for (const PassTime& pass : frame.passes) passes.push_back({pass.pass.name(), pass.ms});
  return {id, frame.span_ms, frame.sum_ms, frame.generate_dispatches, passes};
}

std::pair<std::string, FrameTimes> frame_from(const Json& json) {
  FrameTimes frame{.span_ms = json.at(1), .sum_ms = json.at(2), .generate_dispatches = json.at(3)};
  for (const Json& pass : json.at(4)) frame.passes.push_back({parse_pass_name(pass.at(0)), pass.at(1)});
  return {json.at(0), frame};
}

}  // namespace

Json to_json(const SceneNews& news) {
  Json json = {{"wall", part_to_json(news.wall)}, {"validation", news.validation}};
  if (news.scene) json["scene"] = part_to_json(*news.scene);
  if (news.scored)
    json["scored"] = {{"case", part_to_json(news.scored->result)}, {"rays_ms", news.scored->rays_ms}};
  for (const auto& [id, frame] : news.frames) json["frames"].push_back(frame_json(id, frame));
  if (news.result) json["case"] = part_to_json(*news.result);
  if (news.aa) json["aa"] = part_to_json(*news.aa);
  return json;
}

void from_json(const Json& json, SceneNews* news) {
  news->wall = part_from_json<WallTime>(json.at("wall"));
  news->validation = json.at("validation");
  if (json.contains("scene")) news->scene = part_from_json<SceneReport>(json["scene"]);
  if (json.contains("scored"))
    news->scored = {part_from_json<CaseResult>(json["scored"].at("case")), json["scored"].at("rays_ms")};
  if (json.contains("frames"))
    for (const Json& frame : json["frames"]) news->frames.push_back(frame_from(frame));
  if (json.contains("case")) news->result = part_from_json<CaseResult>(json["case"]);
  if (json.contains("aa")) news->aa = part_from_json<AaPair>(json["aa"]);
}

bool is_worth_noting(const SceneNews& news) {
  return news.scene || news.scored || !news.frames.empty() || news.result || news.aa;
}

void add(const SceneNews& news, SceneOutcome* outcome) {
  const auto is_open = [&](const std::string& id) { return !has_result(*outcome, id); };
  if (news.scene) outcome->scene = news.scene;
  if (news.scored && is_open(news.scored->result.id))
    outcome->begun[news.scored->result.id].scored = news.scored;
  for (const auto& [id, frame] : news.frames)
    if (is_open(id)) outcome->begun[id].frames.push_back(frame);
  if (news.result && is_open(news.result->id)) outcome->cases.push_back(*news.result);
  if (news.result) outcome->begun.erase(news.result->id);
  if (news.aa) outcome->aa = news.aa;
}

void take_news(const Json& json, SceneOutcome* outcome) {
  SceneNews news;
  from_json(json, &news);
  add(news, outcome);
}

bool has_result(const SceneOutcome& outcome, const std::string& id) {
  return std::any_of(outcome.cases.begin(), outcome.cases.end(),
                     [&](const CaseResult& r) { return r.id == id; });
}

}  // namespace vsglbench
