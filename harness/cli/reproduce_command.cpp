#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <set>

#include "base/child.h"
#include "base/error.h"
#include "base/file.h"
#include "base/log.h"
#include "base/printable.h"
#include "cli/command.h"
#include "figure/gnuplot.h"
#include "image/png.h"
#include "papers/flips.h"
#include "papers/page.h"
#include "papers/reproduce.h"
#include "papers/sheet.h"
#include "run/config.h"

namespace fs = std::filesystem;

namespace vsglbench {
namespace {

constexpr uint64_t kThumbnailBytes = 200'000;
constexpr const char* kHelp =
    R"(Each is measured in a folder of its own below --out and goes on where it was interrupted; what is finished
stands as long as config, programme and device are the same, and what failed, lacked its scene
or lost its pictures is tried again.
The page, README.md and papers.json with thumbnails, goes to reports/papers/DEVICE; exhibits that were not asked for
keep their place on it.
Scales: quick takes a fraction of the sizes, paper the configs as they are: the published sizes, but for what moves.
With --check the page is left alone, and a new one goes to OUT/check: verdicts are held against it, and exit code 4
says that one has flipped, as in "[MFIS16 §5]: no longer holds".
Exit codes: 0 all made, 1 something was not (a scene that is not on this machine, too), 2 bad usage or config,
3 no usable device, 4 a verdict has flipped.
Example: vsglbench reproduce mfis16-tab1 mfis16-fig5 --scale quick)";

struct ReproduceCommand {
  std::vector<std::string> names;
  std::string scale = kQuickScale;
  fs::path out, page, exhibits, claims, against;
  WorkOptions work;
  bool check = false;
};

// Of --help. Empty where the list can't be read: the command itself says why.
std::string known_names() {
  std::string text = "Names: all";
  size_t width = text.size();
  try {
    for (const Exhibit& exhibit : load_exhibits({})) {
      const bool full = width + 2 + exhibit.name.size() > 100;
      text += (full ? ",\n" : ", ") + exhibit.name;
      width = (full ? 0 : width + 2) + exhibit.name.size();
    }
  } catch (const Error&) {
    return "";
  }
  return text + ".\n";
}

// "lavapipe", "h200", "rtx3080ti": the folder of a device's page.
std::string folder_name(const std::string& device) {
  if (device.find("llvmpipe") != std::string::npos) return "lavapipe";
  static const std::set<std::string> makers = {"nvidia", "geforce", "amd", "radeon",  "intel",
                                               "tm",     "r",       "gpu", "graphics"};
  std::string word, name;
  for (const char c : device + " ") {
    if (std::isalnum(static_cast<unsigned char>(c))) {
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else {
      if (!makers.contains(word)) name += word;
      word.clear();
    }
  }
  return name.empty() ? "device" : name;
}

// Nothing where there is no file. Throws Error(config) for one that no page can be made of.
std::optional<Json> papers_at(const fs::path& file) {
  std::error_code ec;
  if (!fs::exists(file, ec)) return std::nullopt;
  const JsonDocument doc = JsonDocument::load(file, ErrorKind::config);
  try {
    if (doc.root().at("schema") != kPapersSchema)
      throw doc.error("/schema", fmt::format("is not {}", kPapersSchema));
    trials_in(doc.root());
    static_cast<void>(papers_page(doc.root()));
  } catch (const Json::exception& e) {
    throw doc.error("", fmt::format("is no page's JSON: {}", e.what()));
  }
  return doc.root();
}

// The page anew, with what an earlier one of the device has of other exhibits.
class Page {
 public:
  Page(const ReproduceCommand& command, const std::vector<Exhibit>& all) : command_(command), all_(all) {}

  void add(const Json& exhibit) {
    papers_["exhibits"].push_back(exhibit);
    if (exhibit.contains("device")) papers_["device"] = exhibit["device"];
    if (!papers_.contains("device")) return;  // nothing was made yet
    if (folder_.empty()) open();
    write();
  }
  const Json& papers() const { return papers_; }
  const fs::path& folder() const { return folder_; }
  const std::optional<Json>& committed() const { return committed_; }
  const fs::path& held_against() const { return held_against_; }

 private:
  void open() {
    const std::string device = papers_["device"].at("name");
    const fs::path kept =
        command_.page.empty() ? fs::path("reports") / "papers" / folder_name(device) : command_.page;
    folder_ = command_.check ? command_.out / "check" : kept;
    held_against_ = command_.against.empty() ? kept / "papers.json" : command_.against;
    if (command_.check) committed_ = papers_at(held_against_);
  }
  // What another process has put there in the meantime stays.
  void write() {
    const Json earlier =
        command_.check ? Json::object() : papers_at(folder_ / "papers.json").value_or(Json::object());
    Json all = merged(earlier, papers_, all_);
    all["host"] = papers_["exhibits"].back().at("host");
    const std::string text = papers_page(all);
    for (const Json& exhibit : papers_["exhibits"]) {
      if (!exhibit.contains("sheet")) continue;
      const std::string file = exhibit["sheet"];
      write_png(folder_ / file, thumbnail(read_png(command_.out / file), kThumbnailBytes));
    }
    write_text(folder_ / "papers.json", all.dump(1) + "\n");
    write_text(folder_ / "README.md", text);
  }

  const ReproduceCommand& command_;
  const std::vector<Exhibit>& all_;
  Json papers_ = {{"schema", kPapersSchema}, {"exhibits", Json::array()}};
  std::optional<Json> committed_;
  fs::path folder_, held_against_;
};

void print_trials(const Json& exhibit) {
  fmt::print("{} {} ({:.0f} s)\n", exhibit.at("name").get<std::string>(),
             exhibit.at("source").get<std::string>(), exhibit.at("wall_s").get<double>());
  for (const Json& json : exhibit.at("trials")) {
    const ClaimTrial t = trial_from_json(json);
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
               page.held_against().string());
  const Flips found = flips(*page.committed(), page.papers());
  if (found.compared == 0)
    throw fail(ErrorKind::usage,
               "{}: has no verdict of these exhibits at this scale; there is nothing to compare",
               page.held_against().string());
  size_t lost = 0;
  for (const Flip& flip : found.changed) {
    fmt::print("{}{}\n", flip.lost ? "FLIPPED " : "changed ", printable(flip_text(flip)));
    lost += flip.lost;
  }
  fmt::print("{} verdicts compared: {} flipped, {} can be told otherwise; {} are tried no more\n",
             found.compared, lost, found.changed.size() - lost, found.vanished);
  return lost > 0 ? 4 : 0;
}

// What is misspelt is found now, not after an hour of measuring.
void check_names(const std::vector<Exhibit>& exhibits, const std::vector<PaperClaim>& claims,
                 const std::string& scale) {
  for (const Exhibit& e : exhibits) {
    for (const std::string& name : e.claims) {
      if (std::ranges::count(claims, name, &PaperClaim::name) == 0)
        throw fail(ErrorKind::config, "{}: no claim is named '{}'", e.name, name);
    }
    for (const auto* configs : {&e.runs, &e.lights}) {
      for (const std::string& config : *configs) load_config(config_path(config), Json::object(), scale);
    }
    if (!e.figure.empty()) load_figure_config(config_path(e.figure), 0, 0);
  }
}

// A folder or file that is named by nothing is a slip, such as that of a variable that is not set.
void refuse_empty_paths(const CLI::App& command) {
  for (const char* name : {"--out", "--page", "--against", "--exhibits", "--claims"}) {
    const CLI::Option* option = command.get_option(name);
    if (option->count() > 0 && option->as<std::string>().empty())
      throw fail(ErrorKind::usage, "{}: is empty; give a path, or leave the option out", name);
  }
}

// What the command that makes it again needs beside name and scale: lists of the user's own.
std::string own_lists(const ReproduceCommand& command) {
  std::string out;
  if (!command.exhibits.empty()) out += " --exhibits " + command.exhibits.string();
  if (!command.claims.empty()) out += " --claims " + command.claims.string();
  return out;
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
  command.work.scale = command.scale == kPaperScale ? "" : command.scale;
  check_names(wanted, claims, command.work.scale);
  if (command.work.force && command.work.as_is)
    throw fail(ErrorKind::usage, "--force measures anew what --as-is takes as it is; give one of them");
  if (command.check && !command.against.empty() && !papers_at(command.against))
    throw fail(ErrorKind::usage, "--against {}: does not exist", command.against.string());
  if (!command.page.empty()) static_cast<void>(papers_at(command.page / "papers.json"));
  if (!command.check && !command.against.empty())
    throw fail(ErrorKind::usage, "--against is of --check; give both");
  if (command.out.empty()) command.out = fs::path("reports") / "out" / "papers" / command.scale;
  ensure_writable_directory(command.out);
  [[maybe_unused]] const Gnuplot present;  // where it is missing, that is said before the work
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  command.work.out = command.out;
  PapersWork work(command.work);
  Page page(command, all);
  bool whole = true;
  for (const Exhibit& exhibit : wanted) {
    Json made = reproduce_exhibit(exhibit, claims, &work, command.scale, command.out);
    made["command"] = made["command"].get<std::string>() + own_lists(command);
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
  command->footer([] { return known_names() + kHelp; });
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
  command->add_flag(
      "--as-is", options->work.as_is,
      "take what is finished in --out of these configs, whatever programme made it: the page says which");
  command->add_option("--exhibits", options->exhibits,
                      "a list of your own (default: harness/papers/exhibits.json)");
  command->add_option("--claims", options->claims,
                      "claims of your own (default: harness/answer/claims.json)");
  command->callback([=] {
    options->work.argv = argv;
    refuse_empty_paths(*command);
    reproduce(*options, result);
  });
}

}  // namespace vsglbench
