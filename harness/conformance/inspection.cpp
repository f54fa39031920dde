#include "conformance/inspection.h"

#include "base/error.h"

namespace vsglbench {

bool Inspection::uses_importance() { return make()->method().uses_importance(); }

std::vector<Half> Inspection::halves() {
  return uses_importance() ? std::vector{Half::gbuffer, Half::rsm} : std::vector{Half::rsm};
}

void Inspection::on(const std::string& input, const std::function<void()>& body, bool large) {
  input_ = input;
  parent_.send({{"input", input}});
  try {
    body();
  } catch (const Error& e) {
    if (e.kind() == ErrorKind::device) throw;
    if (large && e.kind() == ErrorKind::case_failed) {
      parent_.send({{"left_out", fmt::format("{}: {}", input_, e.what())}});
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

void Inspection::found(const std::string& fault) {
  parent_.send({{"failure", fmt::format("{}: {}", input_, fault)}});
}

void Inspection::measured(const std::string& figure) {
  parent_.send({{"measured", fmt::format("{}: {}", input_, figure)}});
}

}  // namespace vsglbench
