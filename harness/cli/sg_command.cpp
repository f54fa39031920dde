#include <fstream>
#include <iostream>
#include <memory>

#include "base/csv.h"
#include "base/error.h"
#include "base/file.h"
#include "cli/command.h"
#include "operation/sg_random.h"
#include "operation/sg_receiver.h"
#include "operation/sg_rows.h"

namespace vsglbench {
namespace {

struct SgOptions {
  std::string model, function = "clamped_cosine", device;
  std::filesystem::path in, out;
  uint64_t random = 0, seed = 1;
};

std::string help() {
  std::string text =
      "Evaluates one operation of harness/shaders on the GPU, in single precision, and compares it with "
      "double\n"
      "precision on the same single-precision arguments. CSV in, with a header line; CSV out: the input's\n"
      "columns, results, exact results, error. Functions and their columns:\n";
  for (const SgFunctionInfo& f : sg_functions()) {
    text += fmt::format("  {:<20} {}\n  {:20} {}; {}\n", f.name, fmt::join(f.columns, ","), "", f.meaning,
                        error_name(f.error));
  }
  return text +
         "Example: printf 'cosine,sharpness\\n0.5,8\\n' | vsglbench sg --model tokuyoshi2024\n"
         "         vsglbench sg --model tokuyoshi2022 --random 1000000 --seed 7\n"
         "         vsglbench sg --function receiver --out receiver.csv";
}

SgQuestion question(const SgOptions& o) {
  SgQuestion q{sg_function(o.function)};
  const bool hemisphere = q.function == SgFunction::hemisphere;
  q.model = diffuse_model(!o.model.empty() ? o.model : hemisphere ? "tokuyoshi2022" : "cosine");
  using enum exact::DiffuseModel;
  if (hemisphere && q.model != meder_bruederlin && q.model != tokuyoshi2022) {
    throw fail(ErrorKind::usage,
               "--model {} has no hemispherical integral of its own; use meder-bruederlin or "
               "tokuyoshi2022",
               o.model);
  }
  if (!o.model.empty() && !q.has_model()) {
    throw fail(ErrorKind::usage, "--model means nothing to --function {}", o.function);
  }
  return q;
}

std::vector<float> read_rows(const SgOptions& o, const SgQuestion& q) {
  if (o.in.empty() && q.function == SgFunction::receiver) return sg_receiver::table_rows();
  if (o.in.empty()) return parse_sg_rows(q, "standard input", std::cin);
  std::ifstream text(o.in);  // which may be a pipe
  if (!text || std::filesystem::is_directory(o.in)) {
    throw fail(ErrorKind::usage, "{}: not a file that can be read", o.in.string());
  }
  return parse_sg_rows(q, o.in.string(), text);
}

// cosine,sharpness,value,exact,abs_error; more than one result: name,exact_name of each.
std::string to_csv(const SgQuestion& q, const std::vector<float>& rows, const SgAnswers& a) {
  const SgFunctionInfo& info = q.info();
  std::vector<std::string> cells = info.columns;
  for (const auto& r : info.results) cells.insert(cells.end(), {r, r == "value" ? "exact" : "exact_" + r});
  cells.emplace_back(error_name(info.error));
  std::string text = csv_row(cells);
  const size_t columns = info.columns.size();
  for (size_t i = 0; i < a.error.size(); ++i) {
    cells.clear();
    for (size_t k = i * columns; k < (i + 1) * columns; ++k) cells.push_back(fmt::format("{}", rows[k]));
    for (size_t k = i * a.results; k < (i + 1) * a.results; ++k) {
      cells.push_back(fmt::format("{}", a.values[k]));
      cells.push_back(fmt::format("{}", a.exact[k]));
    }
    cells.push_back(fmt::format("{:.3g}", a.error[i]));
    text += csv_row(cells);
  }
  return text;
}

std::vector<float> row_of(const SgQuestion& q, const std::vector<float>& rows, size_t i) {
  const auto columns = static_cast<ptrdiff_t>(q.info().columns.size());
  const auto from = rows.begin() + static_cast<ptrdiff_t>(i) * columns;
  return {from, from + columns};
}

// The errors' distribution; the first impossible row, made small. Returns the exit code.
int report_random(SgEvaluator& evaluator, const SgOptions& o, const std::vector<float>& rows,
                  const SgAnswers& a) {
  const SgQuestion& q = evaluator.question();
  const ErrorSpread spread = error_spread(q, a);
  const std::string model = q.has_model() ? " " + q.model_name() : "";
  fmt::print("{}{}, {} random rows, seed {}: {} p50 {:.2e}, p99 {:.2e}, max {:.2e}\n", q.info().name, model,
             o.random, o.seed, error_name(q.info().error), spread.p50, spread.p99, spread.max);
  fmt::print("largest: {}\n", reproducer(q, row_of(q, rows, spread.worst)));
  if (spread.impossible.empty()) return 0;
  const size_t first = spread.impossible.front();
  fmt::print("{} rows are impossible, the first is {}: {}\n", spread.impossible.size(),
             impossible(q, a, first), reproducer(q, shrink(evaluator, row_of(q, rows, first))));
  return exit_code(ErrorKind::case_failed);
}

int evaluate(const SgOptions& o) {
  const SgQuestion q = question(o);
  const std::vector<float> rows = o.random > 0 ? random_rows(q, o.random, o.seed) : read_rows(o, q);
  Device device({.select = o.device});
  SgEvaluator evaluator(device, q);
  const SgAnswers answers = evaluator.evaluate(rows);
  const std::string csv = o.random == 0 || !o.out.empty() ? to_csv(q, rows, answers) : "";
  if (!o.out.empty()) write_text(o.out, csv);
  if (o.random > 0) return report_random(evaluator, o, rows, answers);
  if (o.out.empty()) std::fwrite(csv.data(), 1, csv.size(), stdout);
  return 0;
}

}  // namespace

void add_sg_command(CLI::App& app, CommandResult* result) {
  auto options = std::make_shared<SgOptions>();
  CLI::App* command =
      app.add_subcommand("sg", "evaluate a spherical-Gaussian operation on the GPU, with its error");
  command->footer(help());
  command->add_option("--model", options->model,
                      fmt::format("diffuse model: {}", fmt::join(exact::diffuse_model_names(), ", ")));
  command->add_option("--kernel", options->model)->group("");  // its name of version 0.1.0, for one release
  command->add_option("--function", options->function, "what to evaluate (default clamped_cosine)");
  command->add_option("--in", options->in, "CSV file; none: standard input (receiver: its own table)");
  command->add_option("--out", options->out, "CSV file; none: standard output");
  command
      ->add_option("--random", options->random,
                   "this many random rows over the whole domain, instead of a CSV")
      ->check(CLI::Range(uint64_t{1}, uint64_t{1} << 24));
  command->add_option("--seed", options->seed, "of the random rows (default 1)");
  command->add_option("--device", options->device,
                      "Vulkan device: index, UUID, PCI address or part of its name");
  command->callback([=] { result->exit_code = evaluate(*options); });
}

}  // namespace vsglbench
