// The changes and the figures of the history as tables.
import type { Change, History } from "../data";
import type { State } from "../state";
import { table, type Column } from "../table";
import { changeGlyph, percentChange } from "./changes";
import { unitText, type HistoryChoice } from "./history_choice";
import { commitText, dateText } from "./history_describe";
import type { Line } from "./history_model";

export function changesTable(history: History, changes: Change[], caption: string, prefix: string, state: State, jump: (c: Change) => void): HTMLElement {
  const of = (c: Change) => history.series[c.series];
  const titles = new Map(history.columns.map((c) => [c.name, c.title]));
  const columns: Column<Change>[] = [
    { key: "report", title: "report", hint: "place in the history", value: (c) => c.report + 1 },
    { key: "change", title: "change", value: (c) => c.change, text: (c) => c.change, node: (c) => changeGlyph(c.change) },
    { key: "ratio", title: "by", hint: "now over before", value: (c) => c.ratio, text: (c) => percentChange(c.ratio) },
    { key: "lo", title: "from", hint: "lower end of the 95 % interval", value: (c) => c.lo, text: (c) => percentChange(c.lo) },
    { key: "hi", title: "to", hint: "upper end of the 95 % interval", value: (c) => c.hi, text: (c) => percentChange(c.hi) },
    { key: "column", title: "of", value: (c) => titles.get(c.column) ?? c.column },
    { key: "scene", title: "scene", value: (c) => of(c).scene },
    { key: "series", title: "series", value: (c) => of(c).label },
    { key: "until", title: "crept until", hint: "the report by which it had crept three quarters of the way, in steps too small to be told from noise", value: (c) => (c.until === null ? null : c.until + 1) },
    { key: "persistent", title: "persistent", value: (c) => (c.persistent ? "yes" : "no") },
    { key: "commit", title: "commit", value: (c) => commitText(history, c.report) },
    { key: "date", title: "date", value: (c) => dateText(history, c.report) },
    { key: "id", title: "case", value: (c) => of(c).id },
  ];
  const told: Record<string, (c: Change) => boolean> = { until: (c) => c.until !== null, persistent: (c) => !c.persistent };
  const shown = columns.filter((k) => !told[k.key] || changes.some(told[k.key]));
  return table({ caption, file: `vsglbench-${prefix.replace(".", "-")}`, rows: changes, columns: shown, state, prefix, choose: jump,
                 chooseLabel: (c) => `Open ${of(c).label} at report ${c.report + 1}` });
}

interface Figure {
  report: number;
  line: Line;
}

// A row for each report of each line.
export function figuresTable(history: History, c: HistoryChoice, lines: Line[], caption: string, prefix: string): HTMLElement {
  const rows: Figure[] = [];
  for (const line of lines) for (let report = c.from; report <= c.to; ++report) if (line.y[report] !== null) rows.push({ report, line });
  const times = (v: number | null, line: Line) => (v === null ? null : v * line.divisor);
  const columns: Column<Figure>[] = [
    { key: "report", title: "report", value: (f) => f.report + 1 },
    { key: "date", title: "date", value: (f) => dateText(history, f.report) },
    { key: "commit", title: "commit", value: (f) => commitText(history, f.report) },
    { key: "scene", title: "scene", value: (f) => f.line.scene },
    { key: "line", title: "line", value: (f) => f.line.label },
    { key: "value", title: c.column.title, unit: unitText(c.column.unit), value: (f) => times(f.line.y[f.report], f.line) },
    { key: "lo", title: "from", hint: "lower end of the 95 % interval", value: (f) => times(f.line.lo[f.report], f.line) },
    { key: "hi", title: "to", hint: "upper end of the 95 % interval", value: (f) => times(f.line.hi[f.report], f.line) },
    { key: "refusal", title: "not compared", value: (f) => history.reports[f.report].refusal },
  ];
  for (const column of columns) if (["value", "lo", "hi"].includes(column.key)) column.text = (f) => {
    const v = column.value(f);
    return typeof v === "number" ? String(Number(v.toPrecision(5))) : "–";
  };
  return table({ caption, file: `vsglbench-${prefix}`, rows, columns });
}
