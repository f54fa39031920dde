#include "report/table_layout.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "base/nearest.h"
#include "report/case_names.h"
#include "report/columns.h"
#include "report/table_notes.h"

namespace vsglbench {
namespace {

// --- what is shown ---

std::vector<const CaseResult*> chosen_cases(const Report& report, const std::vector<std::string>& globs) {
  std::vector<const CaseResult*> cases;
  for (const CaseResult& c : report.cases) {
    const auto matches = [&](const auto& glob) { return matches_glob(c.id, glob); };
    if (globs.empty() || std::ranges::any_of(globs, matches)) cases.push_back(&c);
  }
  if (cases.empty() && !globs.empty())
    throw fail(ErrorKind::usage, "no case of the report matches '{}'", fmt::join(globs, "' or '"));
  return cases;
}

bool only_generation(const Report& report) {
  return std::ranges::any_of(report.cases,
                             [](const CaseResult& c) { return c.measure == Measure::generation; });
}

std::vector<Column> named_columns(const std::vector<Column>& all, const std::vector<std::string>& names) {
  std::vector<Column> chosen;
  std::vector<std::string> known;
  for (const Column& column : all) known.push_back(column.name);
  for (const std::string& name : names) {
    const auto at = std::ranges::find(known, name);
    if (at == known.end())
      throw fail(ErrorKind::usage, "no column '{}' in this report{}", name, suggestion(name, known));
    chosen.push_back(all[static_cast<size_t>(at - known.begin())]);
  }
  return chosen;
}

// The named ones, or all that a case has a number for.
std::vector<Column> chosen_columns(const Report& report, const std::vector<const CaseResult*>& cases,
                                   const std::vector<std::string>& names) {
  std::vector<Column> all = only_generation(report) ? generation_columns() : frame_columns();
  if (!names.empty()) return named_columns(all, names);
  std::erase_if(all, [](const Column& column) { return column.on_request; });
  const auto is_empty = [&](const Column& column) {
    return std::ranges::none_of(cases, [&](const CaseResult* c) {
      return c->status == Status::ok && !column.number(*c, first_of_scene(report, *c)).empty();
    });
  };
  std::vector<Column> full;
  std::ranges::remove_copy_if(all, std::back_inserter(full), is_empty);
  return full.empty() ? all : full;  // an error's message needs a place
}

// Scenes keep their order, and rows within them where numbers are equal.
void sort_cases(const Report& report, const TableOptions& options, std::vector<const CaseResult*>* cases) {
  if (!options.across.empty())
    throw fail(ErrorKind::usage, "a table across '{}' can't be sorted", options.across);
  const bool falling = options.sort.starts_with('-');
  const std::vector<Column> by =
      named_columns(only_generation(report) ? generation_columns() : frame_columns(),
                    {options.sort.substr(falling ? 1 : 0)});
  using Key = std::tuple<size_t, bool, double>;  // scene, whether without a number, the number
  std::vector<std::pair<Key, const CaseResult*>> keyed;
  std::map<std::string, size_t> scenes;
  for (const CaseResult* c : *cases) {
    const size_t scene = scenes.try_emplace(c->scene, scenes.size()).first->second;
    const auto value =
        c->status == Status::ok ? by.front().value(*c, first_of_scene(report, *c)) : std::nullopt;
    keyed.push_back({{scene, !value, falling ? -value.value_or(0) : value.value_or(0)}, c});
  }
  std::ranges::stable_sort(keyed, {}, [](const auto& k) { return k.first; });
  for (size_t i = 0; i < keyed.size(); ++i) (*cases)[i] = keyed[i].second;
}

// --- the two shapes ---

// A reason that many cases share, such as a scene whose asset is absent, is told once.
std::string message_of(const CaseResult& c, std::set<std::string>* told) {
  const std::string reason = c.error ? c.error->message : "no reason recorded";
  const bool fresh = told->insert(reason).second;
  return fmt::format("{}: {}", name(c.status), fresh ? reason : "as said above");
}

void add_unless_empty(const TableLine& line, TableLayout* table) {
  const auto is_empty = [](const std::string& cell) { return cell.empty(); };
  if (!std::ranges::all_of(line.cells, is_empty)) table->lines.push_back(line);
}

void add_floor(const Report& report, const std::string& scene, const std::vector<Column>& columns,
               TableLayout* table) {
  TableLine line{scene, kFloorRow, {}, ""};
  for (const Column& column : columns) line.cells.push_back(column.floor(report, scene));
  add_unless_empty(line, table);
}

TableLayout one_row_a_case(const Report& report, const std::vector<const CaseResult*>& cases,
                           const std::vector<Column>& columns) {
  TableLayout table{{"case"}, {}, {}, {}};
  for (const Column& column : columns) {
    table.heads.push_back(column.head);
    table.columns.push_back(column.name);
  }
  const CaseNames names(cases);
  std::set<std::string> told;
  for (size_t i = 0; i < cases.size(); ++i) {
    const CaseResult& c = *cases[i];
    TableLine line{c.scene, names.label(c), {}, ""};
    if (c.status == Status::ok) {
      const CaseResult& first = first_of_scene(report, c);
      for (const Column& column : columns) line.cells.push_back(column.cell(c, first));
    } else {
      line.message = message_of(c, &told);
    }
    table.lines.push_back(line);
    if (i + 1 == cases.size() || cases[i + 1]->scene != c.scene) add_floor(report, c.scene, columns, &table);
  }
  return table;
}

// "12.3 / 0.45", with "-" for what there is not; empty when there is none of it.
template <class Text>
std::string joined(const std::vector<Column>& columns, const Text& text) {
  std::vector<std::string> parts;
  for (const Column& column : columns) parts.push_back(text(column));
  const auto is_empty = [](const std::string& part) { return part.empty(); };
  if (std::ranges::all_of(parts, is_empty)) return "";
  std::ranges::replace_if(parts, is_empty, "-");
  return fmt::format("{}", fmt::join(parts, " / "));
}

// Values in the order in which they were first met.
struct Places {
  std::vector<std::string> values;
  size_t of(const std::string& value) {
    const auto at = std::ranges::find(values, value);
    const auto place = static_cast<size_t>(at - values.begin());
    if (at == values.end()) values.push_back(value);
    return place;
  }
};

std::string note_on_cells(const std::vector<Column>& columns) {
  return "each cell: " + joined(columns, [](const Column& column) {
           return column.head.substr(0, column.head.find(" ["));  // without the interval
         });
}

// What is noise stands in a row of its own where scenes stand across, else in a column.
TableLayout across(const Report& report, const std::vector<const CaseResult*>& cases,
                   const std::vector<Column>& columns, const std::string& part) {
  const CaseNames names(cases);
  const bool scenes_across = part == "scene";
  Places heads, rows;
  for (const CaseResult* c : cases) heads.of(names.part(*c, part));
  const auto floor = [&](const std::string& scene) {
    return joined(columns, [&](const Column& column) { return column.floor(report, scene); });
  };
  const bool floor_column = !scenes_across && std::ranges::any_of(cases, [&](const CaseResult* c) {
    return !floor(c->scene).empty();
  });
  TableLayout table{{"case"}, {}, {note_on_cells(columns)}, {}};
  table.heads.insert(table.heads.end(), heads.values.begin(), heads.values.end());
  if (floor_column) table.heads.push_back(kFloorRow);
  for (const CaseResult* c : cases) {
    const std::string scene = scenes_across ? "" : c->scene, label = names.label_without(*c, part);
    const size_t row = rows.of(scene + "/" + label);
    if (row == table.lines.size()) {
      table.lines.push_back({scene, label, TableCells(heads.values.size()), ""});
      if (floor_column) table.lines.back().cells.push_back(floor(scene));
    }
    const auto number = [&](const Column& column) { return column.number(*c, first_of_scene(report, *c)); };
    table.lines[row].cells[heads.of(names.part(*c, part))] =
        c->status == Status::ok ? joined(columns, number) : std::string(name(c->status));
  }
  if (!scenes_across) return table;
  TableLine line{"", kFloorRow, {}, ""};
  for (const auto& scene : heads.values) line.cells.push_back(floor(scene));
  add_unless_empty(line, &table);
  return table;
}

}  // namespace

const CaseResult& first_of_scene(const Report& report, const CaseResult& c) {
  const auto sound = [&](const CaseResult& other) {
    return other.scene == c.scene && other.status == Status::ok;
  };
  return *std::ranges::find_if(report.cases, sound);
}

namespace {

// What the columns of flicker are; empty where none is shown.
std::string note_on_flicker(const std::vector<const CaseResult*>& cases, const std::vector<Column>& columns) {
  const auto is_temporal = [](const Column& c) { return std::ranges::count(kTemporalColumns, c.name) > 0; };
  if (std::ranges::none_of(columns, is_temporal)) return "";
  std::set<uint64_t> frames, seeds;
  std::vector<double> unlit;
  for (const CaseResult* c : cases) {
    if (!c->temporal) continue;
    frames.insert(c->temporal->frames);
    seeds.insert(c->temporal->seeds);
    unlit.push_back(c->temporal->unlit);
  }
  if (frames.empty()) return "";
  return fmt::format(
      "over {} frames in motion and {} seeds, relative to the mean of the references: flicker, how far the "
      "image "
      "changes from frame to frame other than its reference, so that light which lags, is blurred away or "
      "never "
      "comes counts too (a black image has {}); static flicker, how far apart two seeds' images of one frame "
      "are; "
      "detail, how much of the reference's is left: 1 as sharp, below 1 blurred; gain, how bright the image "
      "is "
      "beside the reference: what loses light flickers less",
      fmt::join(frames, " or "), fmt::join(seeds, " or "), range_of(unlit));
}

}  // namespace

TableContents contents_of(const Report& report, const TableOptions& options) {
  TableContents out{chosen_cases(report, options.only), {}};
  out.columns = chosen_columns(report, out.cases, options.columns);
  if (!options.sort.empty()) sort_cases(report, options, &out.cases);
  return out;
}

TableLayout table_of(const Report& report, const TableOptions& options) {
  const auto [cases, columns] = contents_of(report, options);
  TableLayout table = options.across.empty() ? one_row_a_case(report, cases, columns)
                                             : across(report, cases, columns, options.across);
  if (const std::string note = note_on_flicker(cases, columns); !note.empty()) table.notes.push_back(note);
  const auto more = table_notes(report, CaseNames(cases).shared(), options.link);
  table.notes.insert(table.notes.end(), more.begin(), more.end());
  return table;
}

}  // namespace vsglbench
