// `vsglbench answer`: which method and settings reach an error, or are best within a time, in one sentence
// and a table.
#pragma once

#include <optional>
#include <string>

#include "answer/point.h"

namespace vsglbench {

// At most one of the two is asked; where none is, the reply is two sentences a scene: the least error, and
// the cheapest case within twice that.
struct Question {
  AnswerOptions options;
  std::string scene;                // empty: every scene of the report
  std::string visibility;           // "none" or "full"; empty: full where the report has it
  std::optional<double> error, ms;  // at most so much
};

// "smape<=5", "rmse <= 0.01": sets metric and error. "2ms", "2 ms", "0.5": sets ms. Throws Error(usage).
void ask_error(const std::string& text, Question* question);
void ask_time(const std::string& text, Question* question);

// Sentence and table of each scene asked for. Throws Error(usage) for a scene or visibility that is not
// there, naming the nearest, and for a report that has no case with error and time.
std::string reply(const Report& report, const Question& question);

}  // namespace vsglbench
