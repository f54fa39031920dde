// Error budgets: each part is the error of a case of report.json, an increment a difference of two.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { errorOf, intervalOf } from "./figures.mjs";
import { axisOf, close, isFigure, numbers, open, report, rowsOf, saved } from "./harness.mjs";

after(close);
const told = report("budget");
const byId = new Map(told.cases.map((c) => [c.id, c]));
const groups = (metric) => told.analysis.groups.filter((g) => g.metric === metric);

// The cases that switch one approximation after the other, found by their settings.
function partsOf(c, metric) {
  const { visibility, light_clearance: _, ...settings } = c.parameters;
  const there = told.cases.filter((k) => k.status === "ok" && k.scene === c.scene && k.accuracy?.[metric]);
  const steersLobes = ["bias_reduction", "shading", "lobe_filter", "diffuse", "lobes", "variance", "receiver", "lambert_sharpness"];
  const texels = (shading) => there.find((k) => k.method === "all-texels" && k.parameters.visibility === "none" && (k.parameters.shading ?? "exact") === shading &&
    Object.entries(k.parameters).every(([key, v]) => ["visibility", "light_clearance", "shading"].includes(key) || c.parameters[key] === undefined || (shading === "exact" && steersLobes.includes(key)) || c.parameters[key] === v));
  const seen = (by) => there.find((k) => k.method === c.method && k.parameters.visibility === by && Object.entries(settings).every(([key, v]) => k.parameters[key] === v) &&
    (by === "none" || k.parameters.light_clearance === c.parameters.light_clearance));
  const shading = c.parameters.shading ?? "exact";
  const parts = [["RSM resolution", texels("exact")]];
  if (shading !== "exact") parts.push(["SG lobes", texels(shading)]);
  if (c.method !== "all-texels") parts.push(["clustering", seen("none")]);
  if (visibility !== "none") parts.push(["visibility test", seen("exact")]);
  if (!["none", "exact"].includes(visibility)) parts.push(["shadow maps", c]);
  let above = null;
  return parts.map(([name, of], i) => {
    const error = of ? errorOf(of, metric) : null;
    const increment = error === null ? null : above !== null ? error - above : i === 0 ? error : null;
    if (error !== null) above = error;
    return { name, of, error, increment };
  });
}
const expectedOf = (group, methods = () => true) => group.front.map((p) => byId.get(p.case)).filter((c) => methods(c.method)).map((c) => ({ c, parts: partsOf(c, group.metric) }));

const close6 = (got, want) => (want === null ? got === "" : Math.abs(Number(got) - want) <= 1e-5 * Math.abs(want) + 1e-6);
async function checkTable(page, budgets, title) {
  const rows = await saved(page, "Parts of the budgets");
  const wanted = budgets.flatMap(({ c, parts }) => parts.map((p) => ({ c, ...p })));
  assert.equal(rows.length, wanted.length);
  rows.forEach((row, i) => {
    const w = wanted[i], what = `${w.c.id} ${w.name}`;
    assert.equal(row.part, w.name, what);
    assert.ok(close6(row[title], w.error), `${what}: ${row[title]}, not ${w.error}`);
    assert.ok(close6(row.increment ?? row["increment (%)"], w.increment), `${what}: ${row.increment ?? row["increment (%)"]}, not ${w.increment}`);
    assert.equal(row["told by"].startsWith("not run: "), w.error === null, what);
  });
}

test("the table has the error of each part's case, and what it adds", async () => {
  const group = groups("smape").find((g) => g.front.some((p) => partsOf(byId.get(p.case), "smape").every((q) => q.of))) ?? groups("smape")[0];
  const page = await open("budget", { hash: `v=budget&g=${groups("smape").indexOf(group)}` });
  await page.waitForSelector(".grid svg");
  const budgets = expectedOf(group);
  await checkTable(page, budgets, "SMAPE (%)");
  const shown = await rowsOf(page, "Parts of the budgets");
  budgets.flatMap((b) => b.parts).forEach((p, i) => {
    if (!p.of) return;
    const interval = intervalOf(p.of, "smape") ?? [];
    [p.error, ...interval].forEach((v, k) => k < numbers(shown[i]["SMAPE, %"]).length && assert.ok(isFigure(numbers(shown[i]["SMAPE, %"])[k], v), `${p.of.id}: ${shown[i]["SMAPE, %"]}`));
  });
  assert.deepEqual([page.errors, page.requests], [[], []]);
});

test("bars run from the error above to the part's own, with what it adds", async () => {
  const group = groups("smape")[0];
  const page = await open("budget", { hash: "v=budget" });
  await page.waitForSelector(".grid svg");
  const budgets = expectedOf(group);
  const figures = page.locator(".grid figure");
  assert.equal(await figures.count(), budgets.length);
  for (const [i, { c, parts }] of budgets.entries()) {
    const x = await axisOf(page, `.grid figure:nth-of-type(${i + 1})`, "x", "linear");
    const bars = await figures.nth(i).locator("g[data-mark='bar'] rect").evaluateAll((all) => all.map((e) => e.getBoundingClientRect()).map((b) => [b.left, b.right]));
    const texts = await figures.nth(i).locator("g[data-mark='text'] text").allTextContents();
    const there = parts.filter((p) => p.of);
    assert.equal(bars.length, there.length, c.id);
    there.forEach((p, k) => {
      const from = k === 0 ? 0 : there[k - 1].error, ends = [x(from), x(p.error)].sort((a, b) => a - b);
      bars[k].forEach((v, e) => assert.ok(Math.abs(v - ends[e]) < 2, `${c.id} ${p.name}: ${v}, not ${ends[e]}`));
      const text = texts[there.length + k];
      assert.ok(isFigure(numbers(text)[0], k === 0 ? p.error : p.increment), `${c.id} ${p.name}: ${text}`);
      // A bar's name begins with what was not run before it.
      const before = parts.slice(k === 0 ? 0 : parts.indexOf(there[k - 1]) + 1, parts.indexOf(p) + 1).map((q) => q.name).join(" + ");
      assert.equal(texts[k], before);
    });
    const lost = 1 - c.generate.flux.value, caption = await figures.nth(i).locator("figcaption").allTextContents();
    if (Math.abs(lost) >= 5e-5) assert.ok(isFigure(numbers(caption[0])[0], 100 * Math.abs(lost)) && caption[0].includes(lost > 0 ? "lost" : "gained"), `${c.id}: ${caption}`);
    else assert.deepEqual(caption, []);
  }
});

test("what was not run is listed, by part, with how many cases lack it", async () => {
  const all = groups("smape").map((g) => expectedOf(g));
  const at = all.findIndex((b) => b.some((k) => k.parts.some((p) => !p.of)));
  assert.ok(at >= 0);
  const page = await open("budget", { hash: `v=budget&g=${at}` });
  await page.waitForSelector(".grid svg");
  const counts = new Map();
  for (const line of await page.locator(".missing li").allTextContents()) {
    const [, name, count] = /^(.*?) of (one case|\d+ cases): /.exec(line) ?? assert.fail(line);
    counts.set(name, (counts.get(name) ?? 0) + (count === "one case" ? 1 : parseInt(count)));
  }
  const wanted = new Map();
  for (const p of all[at].flatMap((b) => b.parts)) if (!p.of) wanted.set(p.name, (wanted.get(p.name) ?? 0) + 1);
  assert.deepEqual([...counts].sort(), [...wanted].sort());
});

test("scene, metric and methods change them", async () => {
  const group = groups("rmse").at(-1);
  const page = await open("budget", { hash: "v=budget" });
  await page.locator("#group").selectOption(String(groups("rmse").length - 1));
  await page.locator("#metric").selectOption("rmse");
  await page.waitForSelector(".grid svg");
  await checkTable(page, expectedOf(group), "RMSE");
  const methods = [...new Set(group.front.map((p) => byId.get(p.case).method))];
  await page.getByLabel(methods[0], { exact: true }).uncheck();
  if (methods.length === 1) assert.match(await page.locator("#view").textContent(), /No case shown has a budget/);
  else await checkTable(page, expectedOf(group, (m) => m !== methods[0]), "RMSE");
});
