// The page's rules for the front against what `vsglbench analyze` wrote into the committed report.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { transformSync } from "esbuild";
import { report as reportOf } from "./harness.mjs";

const source = readFileSync(new URL("../src/pareto.ts", import.meta.url), "utf8");
const { code } = transformSync(source, { loader: "ts", format: "esm" });
const { pointsOf, place, frontOf, student95 } = await import("data:text/javascript," + encodeURIComponent(code));
const report = reportOf("front");

// The report's cases of one group as the page's columns, rounded as it rounds.
function columns(group) {
  const round = (v) => Number(v.toPrecision(7));
  const cases = report.cases.filter((c) => c.scene === group.scene && c.accuracy?.reference.hash === group.reference);
  const estimate = (m) => (m.heavy_tailed ? [m.median, m.least, m.largest] : [m.value, ...(m.ci95 ?? [m.value, m.value])]);
  const error = cases.map((c) => estimate(c.accuracy[group.metric]).map(round));
  const ms = cases.map((c) => [c.frame.method.median_ms, ...c.frame.method.ci95_ms].map(round));
  const three = (rows) => ({ value: rows.map((r) => r[0]), lo: rows.map((r) => r[1]), hi: rows.map((r) => r[2]) });
  return {
    ids: cases.map((c) => c.id),
    status: cases.map((c) => c.status),
    times: { method: three(ms) },
    errors: { [group.metric]: { ...three(error), heavy: cases.map((c) => (c.accuracy[group.metric].heavy_tailed ? 1 : 0)), seeds: cases.map((c) => c.seeds.map((s) => round(s[group.metric]))) } },
  };
}

test("every group of the front report has the front and the standings of its analysis", () => {
  assert.ok(report.analysis.groups.length >= 30);
  for (const group of report.analysis.groups) {
    const cases = columns(group);
    const points = pointsOf(cases, [...cases.ids.keys()], group.metric, "method");
    const id = (p) => cases.ids[p.case];
    const name = `${group.scene} ${group.visibility} ${group.metric}`;
    assert.equal(points.length, group.points, name);
    assert.deepEqual(frontOf(points).map(id), group.front.map((p) => p.case), name);
    const others = place(points, group.time_noise).filter((p) => p.standing !== "front");
    const told = (p) => ({ case: id(p.point), standing: p.standing, by: p.by.slice(0, 3).map((f) => group.front.findIndex((g) => g.case === id(f))) });
    const byCase = (a, b) => (a.case < b.case ? -1 : 1);
    assert.deepEqual(others.map(told).sort(byCase), [...group.others].sort(byCase), name);
  }
});

test("Student's quantiles are the table's", () => {
  for (const [degrees, t] of [[1, 12.706205], [2, 4.302653], [3, 3.182446], [4, 2.776445], [7, 2.364624], [30, 2.042272], [1000, 1.962339]]) {
    assert.ok(Math.abs(student95(degrees) - t) < 1e-6 * t, `${degrees} degrees: ${student95(degrees)}`);
  }
});

test("an exact case, equal cases, and one without a time", () => {
  const none = [null, null, null, null];
  const columns = { value: [1, 2, 2, null], lo: none, hi: none };
  const cases = { status: ["ok", "ok", "ok", "ok"], times: { method: columns }, errors: { smape: { value: [5, 0, 0, 1], lo: none, hi: none, heavy: [0, 0, 0, 0], seeds: none } } };
  const placed = place(pointsOf(cases, [0, 1, 2, 3], "smape", "method"), 0);
  assert.deepEqual(placed.map((p) => [p.point.case, p.standing]), [[0, "front"], [1, "front"], [2, "ambiguous"]]);
});
