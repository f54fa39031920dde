#include <fmt/format.h>

#include <algorithm>
#include <csignal>

#include "base/child.h"
#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "base/printable.h"
#include "cli/command.h"
#include "figure/gnuplot.h"
#include "image/png.h"
#include "papers/reproduce.h"
#include "papers/sheet.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

constexpr uint64_t kThumbnailBytes = 200'000;

struct ReproduceCommand {
  std::vector<std::string> names;
  std::string scale = kQuickScale;
  fs::path out, page, exhibits, claims, against;
  WorkOptions work;
  bool check = false;
};

// "lavapipe", "h200": the folder of a device's page.
std::string folder_name(const std::string& device) {
  if (device.find("llvmpipe") != std::string::npos) return "lavapipe";
  std::string word, last;
  for (const char c : device + " ") {
    if (std::isalnum(static_cast<unsigned char>(c))) {
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else if (!word.empty()) {
      last = word;
      word.clear();
    }
  }
  return last.empty() ? "device" : last;
}

std::optional<Json> papers_at(const fs::path& file) {
  std::error_code ec;
  if (!fs::exists(file, ec)) return std::nullopt;
  const JsonDocument doc = JsonDocument::load(file, ErrorKind::config);
  if (!doc.root().is_object() || doc.root().value("schema", "") != kPapersSchema)
    throw doc.error("", fmt::format("is no {}", kPapersSchema));
  try {
    trials_in(doc.root());
  } catch (const Json::exception& e) {
    throw doc.error("", e.what());
  }
  return doc.root();
}

// The page anew, with what an earlier one of the device has of other exhibits.
class Page {
 public:
  Page(const ReproduceCommand& command, const std::vector<Exhibit>& all) : command_(command), all_(all) {}

  void add(const Json& exhibit) {
    if (!exhibit.contains("device")) return;  // nothing of it was made
    if (folder_.empty()) open(exhibit["device"]);
    papers_["exhibits"].push_back(exhibit);
    write();
  }
  const Json& papers() const { return papers_; }
  const fs::path& folder() const { return folder_; }
  const std::optional<Json>& committed() const { return committed_; }

 private:
  void open(const Json& of) {
    const std::string device = of.at("name");
    const fs::path kept =
        command_.page.empty() ? fs::path("reports") / "papers" / folder_name(device) : command_.page;
    committed_ = papers_at(command_.against.empty() ? kept / "papers.json" : command_.against);
    folder_ = command_.check ? command_.out / "check" : kept;
    if (!command_.check && command_.against.empty()) earlier_ = committed_.value_or(Json::object());
    papers_ = {
        {"schema", kPapersSchema}, {"argv", command_.work.argv}, {"device", of}, {"exhibits", Json::array()}};
  }
  void write() {
    Json all = merged(earlier_, papers_, all_);
    all["host"] = papers_["exhibits"].back().at("host");
    for (const Json& exhibit : papers_["exhibits"]) {
      if (!exhibit.contains("sheet")) continue;
      const std::string file = exhibit["sheet"];
      write_png(folder_ / file, thumbnail(read_png(command_.out / file), kThumbnailBytes));
    }
    write_text(folder_ / "papers.json", all.dump(1) + "\n");
    write_text(folder_ / "README.md", papers_page(all));
    papers_["host"] = all["host"];
  }

  const ReproduceCommand& command_;
  const std::vector<Exhibit>& all_;
  Json papers_, earlier_ = Json::object();
  std::optional<Json> committed_;
  fs::path folder_;
};

void print_trials(const Json& exhibit) {
  fmt::print("{} {} ({:.0f} s)\n", exhibit.at("name").get<std::string>(),
             exhibit.at("source").get<std::string>(), exhibit.at("wall_s").get<double>());
  for (const Json& json : exhibit.at("trials")) {
    const Trial t = trial_from_json(json);
    const std::string ratio = t.ratio ? fmt::format("  {:.3g}", *t.ratio) : "";
    fmt::print("  {:<13}  {} {} {}{}\n", name(t.ruling), t.claim, printable(t.place), t.metric, ratio);
  }
  for (const Json& problem : exhibit.at("problems"))
    fmt::print("  not made: {}\n", printable(problem.get<std::string>()));
}

// 4 where what held no longer does, or the other way round.
int check(const Page& page) {
  if (!page.committed())
    throw fail(ErrorKind::usage, "there is no page to check against: {} does not exist; give --against FILE",
               (page.folder() / "papers.json").string());
  size_t lost = 0;
  for (const Flip& flip : flips(*page.committed(), page.papers())) {
    fmt::print("{}{}\n", flip.lost ? "FLIPPED " : "changed ", printable(flip_text(flip)));
    lost += flip.lost;
  }
  fmt::print("{} verdicts flipped\n", lost);
  return lost > 0 ? 4 : 0;
}

void on_interrupt(int signal) {
  kill_children();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void reproduce(ReproduceCommand command, CommandResult* result) {
  const std::vector<Exhibit> all = load_exhibits(command.exhibits);
  const std::vector<Exhibit> wanted = select_exhibits(all, command.names);
  const std::vector<PaperClaim> claims = load_claims(command.claims);
  if (command.out.empty()) command.out = fs::path("reports") / "out" / "papers" / command.scale;
  ensure_writable_directory(command.out);
  Gnuplot();  // where it is missing, that is said before the work
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  command.work.out = command.out;
  command.work.scale = command.scale == kPaperScale ? "" : command.scale;
  PapersWork work(command.work);
  Page page(command, all);
  bool whole = true;
  for (const Exhibit& exhibit : wanted) {
    const Json made = reproduce_exhibit(exhibit, claims, &work, command.scale, command.out);
    whole = whole && made.at("problems").empty();
    print_trials(made);
    page.add(made);
    std::fflush(stdout);
  }
  if (page.folder().empty())
    throw fail(ErrorKind::case_failed, "nothing was measured on a device; there is no page");
  fmt::print("{}\n", (page.folder() / "README.md").string());
  result->exit_code = whole ? 0 : 1;
  if (command.check) result->exit_code = std::max(result->exit_code, check(page));
}

}  // namespace

void add_reproduce_command(CLI::App& app, const std::vector<std::string>& argv, CommandResult* result) {
  auto options = std::make_shared<ReproduceCommand>();
  CLI::App* command = app.add_subcommand(
      "reproduce", "tables and figures of the papers made anew, beside what is published, on one page");
  command->footer(
      "Each is measured in a folder of its own below --out and goes on where it was interrupted; what is "
      "finished "
      "stands as\nlong as config, programme and device are the same. The page, README.md and papers.json "
      "with "
      "thumbnails, goes to\nreports/papers/DEVICE; exhibits that were not asked for keep their place on it.\n"
      "Scales: quick takes a fraction of the published sizes, paper the sizes themselves, which take hours "
      "on a "
      "CPU.\nWith --check the page is left alone: verdicts are held against it, and exit code 4 says that "
      "one has "
      "flipped, as in\n\"[MFIS16 §5]: no longer holds\".\n"
      "Exit codes: 0 all made, 1 something was not, 2 bad usage or config, 3 no usable device, 4 a verdict "
      "has "
      "flipped.\n"
      "Example: vsglbench reproduce mfis16-tab1 mfis16-fig5 --scale quick");
  command->add_option("names", options->names, "tables and figures, or all (default)");
  command->add_option("--only", options->names, "the same; may come again")->allow_extra_args(false);
  command->add_option("--scale", options->scale, "quick or paper")
      ->check(CLI::IsMember({kQuickScale, kPaperScale}))
      ->capture_default_str();
  command->add_option("--out", options->out,
                      "folder for what is measured (default reports/out/papers/SCALE)");
  command->add_option("--page", options->page, "folder of the page (default reports/papers/DEVICE)");
  command->add_flag("--check", options->check,
                    "hold the verdicts against those of the page, and leave it alone");
  command->add_option("--against", options->against, "papers.json to check against (default: the page's)");
  command->add_option("--assets", options->work.assets,
                      "folder of downloaded scenes (default $VSGLBENCH_ASSETS)");
  command->add_option("--device", options->work.device,
                      "Vulkan device: index, UUID, PCI address or part of its name");
  command->add_flag("--force", options->work.force, "measure anew what is finished");
  command->add_flag("--as-is", options->work.as_is,
                    "take what is finished in --out, whatever programme made it: the page says which");
  command->add_option("--exhibits", options->exhibits,
                      "a list of your own (default: harness/papers/exhibits.json)");
  command->add_option("--claims", options->claims,
                      "claims of your own (default: harness/answer/claims.json)");
  command->callback([=] {
    options->work.argv = argv;
    reproduce(*options, result);
  });
}

}  // namespace vsglbench
