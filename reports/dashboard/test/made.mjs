// Pages with figures that a test has made: the data of another page, changed.
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, relative } from "node:path";
import { deflateSync, inflateSync } from "node:zlib";

const pages = process.env.VSGLBENCH_DASHBOARD_PAGES ?? "";
const element = /(<script[^>]*id="data"[^>]*>)([^<]*)(<\/script>)/;

export function digestOf(name) {
  const text = readFileSync(join(pages, `${name}.html`), "utf8");
  return JSON.parse(inflateSync(Buffer.from(element.exec(text)[2].trim(), "base64")).toString());
}

// -> the name under which harness.open() finds the page whose data `change` has been through. `pictures`: by element,
// the bytes that it holds instead.
export function made(name, change, pictures = {}) {
  let text = readFileSync(join(pages, `${name}.html`), "utf8");
  for (const [id, bytes] of Object.entries(pictures))
    text = text.replace(new RegExp(`(<script[^>]*id="${id}"[^>]*>)[^<]*`), (_, open) => open + bytes.toString("base64"));
  const digest = digestOf(name);
  change(digest);
  const data = deflateSync(JSON.stringify(digest)).toString("base64");
  const file = join(mkdtempSync(join(tmpdir(), "vsglbench-page-")), "page");
  writeFileSync(`${file}.html`, text.replace(element, (_, open, __, close) => open + data + close));
  return relative(pages, file);
}

// A history whose figures are known: series i of report r has 10 (i + 1) ms, but for the steps given as
// [series, report, ratio], and for what crept, given as [series, from, to, ratio]; intervals are ± 1 %.
export function madeHistory({ reports, series, steps = [], crept = [], methods = ["mfis", "fis", "vpl"], scenes = ["cornell", "ring514"], refused = [] }) {
  const drift = (i, r) => crept.reduce((v, [s, from, to, ratio]) => (s === i ? v * ratio ** Math.min(1, Math.max(0, (r - from) / (to - from))) : v), 1);
  const figure = (i, r) => steps.reduce((v, [s, from, ratio]) => (s === i && r >= from ? v * ratio : v), 10 * (i + 1) * drift(i, r));
  const range = (n) => [...Array(n).keys()];
  const estimates = (make) => ({ value: range(reports).map(make), lo: range(reports).map((r) => make(r) * 0.99), hi: range(reports).map((r) => make(r) * 1.01) });
  return {
    reports: range(reports).map((r) => ({
      file: `report-${r}.json`, name: "nightly", created: new Date(Date.UTC(2026, 0, 1 + r)).toISOString(),
      commit: (r + 1).toString(16).padStart(4, "0").repeat(10), dirty: false, device: "llvmpipe", refusal: refused.includes(r) ? "the references differ" : "" })),
    columns: [{ name: "method", title: "method time", unit: "ms", time: true }, { name: "smape", title: "SMAPE", unit: " %", time: false }],
    series: range(series).map((i) => ({
      id: `${scenes[i % scenes.length]}/${methods[i % methods.length]}/N=${i}`, scene: scenes[i % scenes.length], method: methods[i % methods.length],
      label: `${methods[i % methods.length]} N=${i}`, values: { method: estimates((r) => figure(i, r)), smape: estimates(() => i + 5) }, noise: { method: 0.02 } })),
    changes: [
      ...steps.map(([s, report, ratio, persistent = true]) => ({ report, series: s, ratio, until: null, persistent })),
      ...crept.map(([s, report, until, ratio]) => ({ report, series: s, ratio, until, persistent: true })),
    ].map((c) => ({ ...c, column: "method", change: c.ratio > 1 ? "slower" : "faster", lo: c.ratio * 0.99, hi: c.ratio * 1.01 })),
  };
}
