// All cases in one table: figures, settings, and why a case failed or was skipped.
import { casesShown, errorsOf, methodOf, metricOf, selectedCases, timeOf, timesOf } from "../choice";
import { lookOf, swatch } from "../colours";
import { bytes, figure } from "../format";
import { table } from "../table";
import type { Column } from "../table";
import type { Page, View } from "../view";

function columnsOf(page: Page): Column<number>[] {
  const { report, digest } = page;
  const { cases } = report;
  const metric = metricOf(page), time = timeOf(page);
  const ms = timesOf(page), error = errorsOf(page);
  const timeColumn: Column<number> = { key: "ms", title: time.name, unit: "ms", hint: time.words, value: (c) => ms.value[c], text: (c) => figure(ms.value[c]) };
  const errorColumn: Column<number> = { key: "error", title: metric.title, unit: metric.unit, value: (c) => error.value[c], text: (c) => figure(error.value[c]) };
  const columns: Column<number>[] = [
    { key: "case", title: "case", value: (c) => cases.label[c], node: (c) => swatch(lookOf(digest, methodOf(report, c))) },
    { key: "scene", title: "scene", value: (c) => report.scenes[cases.scene[c]].name },
    { key: "status", title: "status", value: (c) => cases.status[c] },
    ...(time.name === "" ? [] : [timeColumn]),
    ...(metric.name === "" ? [] : [errorColumn]),
    ...report.extra.map((e): Column<number> => ({
      key: e.name, title: e.name.replaceAll("_", " "), unit: e.unit, hint: e.words, scaled: e.unit === "B",
      value: (c) => cases.extra[e.name]?.[c] ?? null,
      text: (c) => (e.unit === "B" ? bytes(cases.extra[e.name]?.[c]) : figure(cases.extra[e.name]?.[c], 4)),
    })),
  ];
  for (const [key, column] of Object.entries(cases.parameters)) {
    if (key in report.settings || !column.some((v) => v !== null && v !== "")) continue;
    columns.push({ key: "p." + key, title: key, value: (c) => column[c], text: (c) => String(column[c] ?? "") });
  }
  if (cases.message.some((m) => m !== "")) columns.splice(3, 0, { key: "message", title: "why", value: (c) => cases.message[c] });
  return columns;
}

export const casesView: View = {
  id: "cases",
  title: "Cases",
  filters: ["metric", "time", "methods"],
  has: ({ report }) => report.cases.id.length > 0,
  draw(root, page) {
    const chosen = new Set(selectedCases(page));
    root.append(
      table({
        caption: "All cases", file: `${page.report.name}-cases`, rows: casesShown(page, "report"), columns: columnsOf(page),
        state: page.state, prefix: "ca", marked: (c) => chosen.has(c),
        choose: (c) => {
          if (!chosen.delete(c)) chosen.add(c);
          page.state.set({ c: [...chosen].join(",") }, true);
        },
        chooseLabel: () => "select for the other views",
      }),
    );
  },
};
