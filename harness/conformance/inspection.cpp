#include "conformance/inspection.h"

#include "base/error.h"

namespace vsglbench {

Json to_json(const CheckNews& news) { return {{"kind", static_cast<int>(news.kind)}, {"text", news.text}}; }

void from_json(const Json& json, CheckNews* news) {
  *news = {static_cast<CheckNews::Kind>(json.at("kind").get<int>()), json.at("text")};
}

bool Inspection::uses_importance() { return make()->method().uses_importance(); }

std::vector<Half> Inspection::halves() {
  return uses_importance() ? std::vector{Half::gbuffer, Half::rsm} : std::vector{Half::rsm};
}

void Inspection::on(const std::string& input, const std::function<void()>& body, bool large) {
  input_ = input;
  worker_.now({0, "on " + input, options_.silence_s}, {CheckNews::Kind::input, input});
  try {
    body();
  } catch (const Error& e) {
    if (e.kind() == ErrorKind::device_lost) throw;
    if (large && e.kind() == ErrorKind::case_failed) {
      tell(CheckNews::Kind::left_out, e.what());
    } else {
      found_thrown(e.what());
    }
  } catch (const std::exception& e) {
    found_thrown(e.what());
  }
}

void Inspection::found_thrown(const std::string& what) {
  if (what == thrown_) return found("threw the same");
  thrown_ = what;
  found(fmt::format("threw \"{}\"; expected lights", what));
}

void Inspection::found(const std::string& fault) { tell(CheckNews::Kind::failure, fault); }
void Inspection::measured(const std::string& figure) { tell(CheckNews::Kind::measured, figure); }

void Inspection::tell(CheckNews::Kind kind, const std::string& text) {
  worker_.tell({kind, fmt::format("{}: {}", input_, text)});
}

}  // namespace vsglbench
