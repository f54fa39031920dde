// Prices of knobs: ratios and means are those of pairs of report.json that differ in one setting alone.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { casesOf, errorOf, geometricMean, pairs, sameRows, timeOf } from "./figures.mjs";
import { axisOf, close, open, report, saved } from "./harness.mjs";

after(close);
const front = report("front");
const group = front.analysis.groups[0];
const keys = ["K", "N", "importance", "importance_lights"];
const mostPairs = 24; // of a knob, in the page

const expected = (metric, time, shown = () => true, of = group) => Object.fromEntries(keys.map((key) => [key, pairs(casesOf(front, of).filter((c) => shown(c.method)), key).map(({ before, after }) => ({
  from: String(before.parameters[key]), to: String(after.parameters[key]), before, after,
  error: errorOf(after, metric) - errorOf(before, metric), ms: timeOf(after, time) - timeOf(before, time),
  errorRatio: errorOf(after, metric) / errorOf(before, metric), timeRatio: timeOf(after, time) / timeOf(before, time) }))]));

// 1 and 1.0 are one number.
const value = (text) => (text.trim() !== "" && Number.isFinite(Number(text)) ? String(Number(text)) : text);

async function checkMeans(page, wanted) {
  const rows = await saved(page, "Knobs");
  assert.deepEqual(rows.map((r) => r.setting).sort(), keys.filter((k) => wanted[k].length > 0));
  for (const row of rows) {
    const of = wanted[row.setting];
    assert.equal(Number(row.pairs), of.length, row.setting);
    const error = geometricMean(of.map((p) => p.errorRatio)), time = geometricMean(of.map((p) => p.timeRatio));
    assert.ok(Math.abs(Number(row.error) / error - 1) < 1e-5, `${row.setting}: error ${row.error}, not ${error}`);
    assert.ok(Math.abs(Number(row.time) / time - 1) < 1e-5, `${row.setting}: time ${row.time}, not ${time}`);
  }
}
async function checkPairs(page, wanted, unit) {
  const rows = await saved(page, "Pairs");
  for (const key of keys) {
    const mine = rows.filter((r) => r.setting === key);
    const of = (r) => [value(r.from), value(r.to), Number(r["time (ms)"]), Number(r[`error${unit}`]), Number(r[`error bought (${unit === "" ? "/ ms" : "% / ms"})`])];
    const wrong = sameRows(mine, of, wanted[key], (p) => [value(p.from), value(p.to), p.ms, p.error, -p.error / p.ms], 1e-3);
    if (wanted[key].length <= mostPairs) assert.equal(wrong, "", key);
    else assert.match(wrong, new RegExp(`^${wanted[key].length - mine.length} rows are missing`), key); // the first are there
  }
  return rows;
}

test("means and pairs are those of the report", async () => {
  const page = await open("front", { hash: "v=knobs" });
  const wanted = expected("smape", "method");
  await checkMeans(page, wanted);
  const rows = await checkPairs(page, wanted, " (%)");
  const left = keys.reduce((n, k) => n + wanted[k].length, 0) - rows.length;
  assert.ok(left > 0);
  assert.match(await page.locator("section.table", { hasText: "Pairs" }).last().locator(".note").textContent(), new RegExp(`${left} more`));
  assert.deepEqual([page.errors, page.requests], [[], []]);
});

test("the pass that pays is the one whose median changes most", async () => {
  const page = await open("front", { hash: "v=knobs&kn.key=K" });
  const rows = await saved(page, "Pairs");
  const changes = ({ before, after }) => {
    const ms = (c, name) => c.passes.find((p) => p.name === name)?.median_ms ?? 0;
    const names = [...new Set([...before.passes, ...after.passes].map((p) => p.name))].filter((n) => n !== "gbuffer" && n !== "rsm");
    return names.map((name) => ({ name, ms: ms(after, name) - ms(before, name) })).reduce((a, b) => (Math.abs(b.ms) > Math.abs(a.ms) ? b : a));
  };
  const wanted = expected("smape", "method").K;
  assert.equal(sameRows(rows, (r) => [r["pass that pays"], Number(r["of it (ms)"])], wanted, (p) => [changes(p).name, changes(p).ms]), "");
  const counts = {};
  for (const p of wanted) counts[changes(p).name] = (counts[changes(p).name] ?? 0) + 1;
  const told = (await saved(page, "Knobs")).find((r) => r.setting === "K")["pass that pays"];
  assert.equal(counts[told], Math.max(...Object.values(counts)));
});

test("a symbol stands at its ratios, a ring at the means, and reading tells them", async () => {
  const page = await open("front", { hash: "v=knobs&kn.key=importance" });
  await page.waitForSelector(".chart g.pairs path, .chart g.pairs circle");
  const wanted = expected("smape", "method").importance;
  const [x, y] = [await axisOf(page, ".chart", "x"), await axisOf(page, ".chart", "y")];
  const at = (selector) => page.locator(selector).evaluateAll((all) => all.map((e) => e.getBoundingClientRect()).map((b) => [b.x + b.width / 2, b.y + b.height / 2]));
  const near = (place, p) => Math.abs(place[0] - x(p.timeRatio)) < 3 && Math.abs(place[1] - y(p.errorRatio)) < 3;
  const places = await at(".chart g.pairs > *");
  assert.equal(places.length, wanted.length);
  for (const place of places) assert.ok(wanted.some((p) => near(place, p)), `nothing belongs to ${place}`);
  const mean = { timeRatio: geometricMean(wanted.map((p) => p.timeRatio)), errorRatio: geometricMean(wanted.map((p) => p.errorRatio)) };
  assert.ok(near((await at(".chart g.means > *"))[0], mean));
  // "time +3.1 %, error ×2.50"
  const ratio = (text) => (text.startsWith("×") ? Number(text.slice(1)) : 1 + Number(text.replace("−", "-").replace(" %", "")) / 100);
  await page.locator(".chart").focus();
  for (const place of places) {
    await page.keyboard.press("ArrowRight");
    const [, time, error] = /time (.*), error (.*)$/.exec(await page.locator(".tip").innerText());
    const told = { timeRatio: ratio(time), errorRatio: ratio(error) };
    assert.ok(near(place, told), `${JSON.stringify(told)} at ${place}`);
  }
});

test("methods, time, metric and scene change them", async () => {
  const page = await open("front", { hash: "v=knobs" });
  await page.getByLabel("mfis", { exact: true }).uncheck();
  await checkMeans(page, expected("smape", "method", (m) => m !== "mfis"));
  await page.getByRole("button", { name: "All", exact: true }).click();
  await page.locator("#time").selectOption("frame");
  await checkMeans(page, expected("smape", "frame"));
  await checkPairs(page, expected("smape", "frame"), " (%)");
  const other = front.analysis.groups.findIndex((g) => g.scene === "sponza");
  await page.locator("#group").selectOption(String(other));
  await page.locator("#metric").selectOption("rmse");
  const wanted = expected("rmse", "frame", () => true, front.analysis.groups[other]);
  await checkMeans(page, wanted);
  await checkPairs(page, wanted, "");
});

test("no name of a ring covers another, however narrow", async () => {
  for (const width of [400, 1280]) {
    const page = await open("front", { hash: "v=knobs", width });
    await page.waitForSelector(".chart g.name text");
    const boxes = await page.locator(".chart g.name text").evaluateAll((all) => all.map((e) => ({ name: e.textContent, ...e.getBoundingClientRect().toJSON() })));
    assert.deepEqual(boxes.map((b) => b.name).sort(), keys);
    for (const a of boxes) for (const b of boxes)
      assert.ok(a === b || a.right < b.left || b.right < a.left || a.bottom - 2 < b.top || b.bottom - 2 < a.top, `${width} px: ${a.name} and ${b.name}`);
    for (const b of boxes) assert.ok(b.left >= 0 && b.right <= width, `${width} px: ${b.name} from ${b.left} to ${b.right}`);
  }
});
