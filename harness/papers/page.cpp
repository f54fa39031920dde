#include "papers/page.h"

#include <algorithm>
#include <array>
#include <map>

#include "base/printable.h"
#include "papers/measured_table.h"

namespace vsglbench {
namespace {

constexpr std::array kOrder = {Ruling::holds, Ruling::in_part, Ruling::undecided, Ruling::does_not_hold,
                               Ruling::not_run};

// Text of a file as a page may have it, in a table's cell, too: no markup of its own.
std::string cell(const std::string& text) {
  std::string out;
  for (const char c : printable(text)) {
    out += c == '|'   ? "\\|"
           : c == '<' ? "&lt;"
           : c == '>' ? "&gt;"
           : c == '&' ? "&amp;"
           : c == '`' ? "'"
                      : std::string(1, c);
  }
  return out;
}

std::string number(double value) {
  return value >= 1000 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

std::string interval_text(const Json& row) {
  if (!row.contains("value")) return "-";
  if (!row.contains("ci95")) return number(row["value"]);
  return fmt::format("{} [{}, {}]", number(row["value"]), number(row["ci95"].at(0)),
                     number(row["ci95"].at(1)));
}

// --- the ledger ---

struct Entry {
  ClaimTrial first;
  std::vector<ClaimTrial> trials;
};

// By claim, in the order in which exhibits try them.
std::vector<Entry> entries_of(const Json& papers) {
  std::vector<Entry> out;
  for (const ClaimTrial& t : trials_in(papers)) {
    auto at = std::ranges::find_if(out, [&](const Entry& e) { return e.first.claim == t.claim; });
    if (at == out.end()) at = out.insert(out.end(), {t, {}});
    at->trials.push_back(t);
  }
  return out;
}

std::string counts(const std::vector<ClaimTrial>& trials) {
  std::vector<std::string> parts;
  for (const Ruling ruling : kOrder) {
    const auto count = std::ranges::count(trials, ruling, &ClaimTrial::ruling);
    if (count > 0) parts.push_back(fmt::format("{} {}", name(ruling), count));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

// One word for a claim: what all certain trials say, else "in part"; "undecided" where none is certain.
Ruling whole(const std::vector<ClaimTrial>& trials) {
  const auto has = [&](Ruling r) { return std::ranges::count(trials, r, &ClaimTrial::ruling) > 0; };
  if (has(Ruling::in_part) || (has(Ruling::holds) && has(Ruling::does_not_hold))) return Ruling::in_part;
  if (has(Ruling::holds)) return Ruling::holds;
  if (has(Ruling::does_not_hold)) return Ruling::does_not_hold;
  return has(Ruling::undecided) ? Ruling::undecided : Ruling::not_run;
}

std::string places(const Entry& entry) {
  std::vector<std::string> names;
  for (const ClaimTrial& t : entry.trials) {
    const std::string link = fmt::format("[{0}](#{0})", cell(t.exhibit));
    if (std::ranges::count(names, link) == 0) names.push_back(link);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string ledger(const Json& papers) {
  const std::vector<Entry> entries = entries_of(papers);
  std::map<Ruling, size_t> total;
  for (const Entry& e : entries) ++total[whole(e.trials)];
  std::vector<std::string> parts;
  for (const Ruling r : kOrder) {
    if (total[r] > 0) parts.push_back(fmt::format("{} {}", total[r], name(r)));
  }
  std::string out = fmt::format(
      "## What the papers claim\n\nOf {} claims: {}. A claim holds where its ratio lies wholly on the side "
      "that "
      "is said, by its 95 % interval; it holds in part where scenes, errors or pairs contradict each other. "
      "What does not hold is a finding, not a failure.\n\n"
      "| where | claim | tried as | verdict | trials | in |\n| --- | --- | --- | --- | --- | --- |\n",
      entries.size(), fmt::join(parts, ", "));
  for (const Entry& e : entries) {
    out += fmt::format("| {} | {} | {} | **{}** | {} | {} |\n", cell(e.first.source), cell(e.first.text),
                       cell(e.first.how), name(whole(e.trials)), counts(e.trials), places(e));
  }
  return out + "\n";
}

// --- an exhibit ---

bool is_positive(const std::string& published) {
  return !published.empty() && published_value(published) > 0;
}

// Shares of the column's sum, of medians, carry over from one machine to another; milliseconds do not.
std::string table_text(const Json& table) {
  std::map<std::string, std::pair<double, double>> sums;  // published, measured: by column
  for (const Json& row : table.at("rows")) {
    if (row.value("sum", false) && row.contains("value") && is_positive(row["published"]))
      sums[row["column"]] = {published_value(row["published"]), row["value"]};
  }
  const std::string unit = table.value("unit", "");
  const std::string scene = table.value("scene", "");
  std::string out = scene.empty() ? "" : fmt::format("Scene `{}`:\n\n", cell(scene));
  out += fmt::format(
      "| | | published{0} | here{0} | here / published |{1}\n| --- | --- | ---: | ---: | ---: |{2}\n",
      unit.empty() ? "" : ", " + unit, sums.empty() ? "" : " share, published | share, here |",
      sums.empty() ? "" : " ---: | ---: |");
  std::string before;
  for (const Json& row : table.at("rows")) {
    const std::string column = row["column"], published = row["published"];
    const bool known = is_positive(published) && row.contains("value");
    const double value = known ? row["value"].get<double>() : 0;
    out += fmt::format("| {} | {} | {} | {} | {} |", column == before ? "" : cell(column),
                       row.value("sum", false) ? fmt::format("**{}**", cell(row["name"])) : cell(row["name"]),
                       published.empty() ? "-" : cell(published), interval_text(row),
                       known ? number(value / published_value(published)) : "-");
    const auto sum = sums.find(column);
    if (sum != sums.end() && known) {
      out += fmt::format(" {:.1f} % | {:.1f} % |", 100 * published_value(published) / sum->second.first,
                         100 * value / sum->second.second);
    } else if (!sums.empty()) {
      out += " | |";
    }
    out += '\n';
    before = column;
  }
  return out + "\n";
}

std::string machines(const Json& exhibit) {
  std::vector<std::string> out;
  for (const Json& table : exhibit.at("tables")) {
    for (const Json& row : table.at("rows")) {
      const std::string machine = row.value("machine", "");
      if (!machine.empty() && std::ranges::count(out, machine) == 0) out.push_back(machine);
    }
  }
  return fmt::format("{}", fmt::join(out, ", "));
}

std::string trials_text(const Json& exhibit) {
  if (exhibit.at("trials").empty()) return "";
  std::string out =
      "| claim | place | measure | verdict | ratio [95 %] | |\n| --- | --- | --- | --- | ---: | --- |\n";
  for (const Json& json : exhibit.at("trials")) {
    const ClaimTrial t = trial_from_json(json);
    const std::string ratio = !t.ratio ? ""
                              : t.ci95
                                  ? fmt::format("{:.3g} [{:.3g}, {:.3g}]", *t.ratio, t.ci95->lo, t.ci95->hi)
                                  : fmt::format("{:.3g}", *t.ratio);
    out += fmt::format("| {} {} | {} | {} | {} | {} | {} |\n", cell(t.source), cell(t.claim), cell(t.place),
                       cell(t.metric), name(t.ruling), ratio, cell(t.figures));
  }
  return out + "\n";
}

std::string commit_text(const Json& of) {
  return cell(of.at("commit").get<std::string>().substr(0, 7)) +
         (of.at("dirty").get<bool>() ? " with changes" : "");
}

std::string exhibit_text(const Json& e) {
  std::string out = fmt::format("## {}\n\n**{}** {}.\n\n", cell(e.at("name").get<std::string>()),
                                cell(e.at("source")), cell(e.at("title")));
  if (e.contains("differs")) out += fmt::format("Unlike the paper: {}.\n\n", cell(e["differs"]));
  out += fmt::format("`{}`, commit {}", cell(e.at("command")), commit_text(e));
  for (const Json& m : e.at("measured")) {
    out += fmt::format("; `{}` was measured {} in {:.0f} s, commit {}", cell(m.at("config")),
                       cell(m.at("created")), m.at("wall_s").get<double>(), commit_text(m));
  }
  out += ".\n\n";
  if (e.contains("sheet")) out += fmt::format("![{0}]({0})\n\n", cell(e["sheet"]));
  for (const Json& problem : e.at("problems"))
    out += fmt::format("Not made: {}.\n\n", cell(problem.get<std::string>()));
  for (const Json& note : e.value("notes", Json::array()))
    out += fmt::format("* {}.\n", cell(note.get<std::string>()));
  if (e.contains("notes")) out += '\n';
  if (const std::string published = machines(e); !published.empty())
    out += fmt::format("Published on {}; here on {}.\n\n", cell(published),
                       e.contains("device") ? cell(e["device"].at("name")) : cell(e.at("host").at("cpu")));
  for (const Json& table : e.at("tables")) out += table_text(table);
  for (const Json& report : e.at("reports"))
    out += printable_lines(report.at("markdown").get<std::string>()) + "\n";
  return out + trials_text(e);
}

}  // namespace

std::vector<ClaimTrial> trials_in(const Json& papers) {
  std::vector<ClaimTrial> out;
  for (const Json& exhibit : papers.at("exhibits")) {
    for (const Json& trial : exhibit.at("trials")) out.push_back(trial_from_json(trial));
  }
  return out;
}

Json merged(const Json& earlier, const Json& fresh, const std::vector<Exhibit>& all) {
  const auto exhibits_of = [](const Json& papers) { return papers.value("exhibits", Json::array()); };
  const Json old = exhibits_of(earlier), anew = exhibits_of(fresh);
  const auto named = [](const Json& exhibits, const std::string& name) {
    return std::ranges::find_if(exhibits, [&](const Json& e) { return e.at("name") == name; });
  };
  std::vector<std::string> order;
  for (const Exhibit& exhibit : all) order.push_back(exhibit.name);
  for (const Json* exhibits : {&anew, &old}) {  // then those that this list does not know
    for (const Json& e : *exhibits) {
      const std::string name = e.at("name");
      if (std::ranges::count(order, name) == 0) order.push_back(name);
    }
  }
  Json out = fresh;
  out["exhibits"] = Json::array();
  for (const std::string& name : order) {
    if (const auto at = named(anew, name); at != anew.end()) {
      out["exhibits"].push_back(*at);
    } else if (const auto before = named(old, name); before != old.end()) {
      out["exhibits"].push_back(*before);
    }
  }
  return out;
}

std::string papers_page(const Json& papers) {
  std::vector<std::string> hosts;  // exhibits that keep their place may be another's
  const auto add_host = [&](const Json& host) {
    const std::string text =
        fmt::format("{} with {} cores", cell(host.at("cpu")), host.at("cores").get<int>());
    if (std::ranges::count(hosts, text) == 0) hosts.push_back(text);
  };
  for (const Json& e : papers.at("exhibits"))
    if (e.contains("host")) add_host(e["host"]);
  if (hosts.empty()) add_host(papers.at("host"));
  std::string out = "# The papers, reproduced\n\n";
  const Json& device = papers.at("device");
  out += fmt::format(
      "What [MFIS16], [VSGL14], [VSGL15s] and [SGL22] show in tables and figures, made anew by "
      "`vsglbench reproduce all` on {} ({} {}), {}{}. Published values stand as printed; what "
      "is "
      "asserted is only what carries over between machines: order, ratios, signs. Each thumbnail is made of "
      "a "
      "larger sheet, which the command leaves beside its images. This page is made of "
      "[papers.json](papers.json), which has every figure of it; `vsglbench reproduce all --check` tells "
      "where a "
      "verdict has changed since.\n\n",
      cell(device.at("name")), cell(device.at("driver")), cell(device.at("driver_version")),
      fmt::join(hosts, " and "),
      device.at("type") == "cpu" ? ": a CPU, whose times say nothing of a GPU's" : "");
  out += "Exhibits: ";
  std::vector<std::string> links;
  for (const Json& e : papers.at("exhibits"))
    links.push_back(fmt::format("[{0}](#{0}) ({1})", cell(e.at("name")), cell(e.at("scale"))));
  out += fmt::format("{}.\n\n", fmt::join(links, ", "));
  out += ledger(papers);
  for (const Json& e : papers.at("exhibits")) out += exhibit_text(e);
  return out;
}

}  // namespace vsglbench
