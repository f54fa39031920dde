// Error and time over a setting: curves join cases of report.json that differ in it alone.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { casesOf, errorOf, intervalOf, sameRows, series, timeOf } from "./figures.mjs";
import { axisOf, close, isFigure, numbers, open, report, saved } from "./harness.mjs";

after(close);
const front = report("front");
const group = front.analysis.groups[0];

// Each sample with the one before it on its curve.
function samplesOf(cases, key, figure) {
  return series(cases, key).flatMap((list) => {
    const curve = [...list].sort((a, b) => a.parameters[key] - b.parameters[key]);
    return curve.map((c, i) => {
      const value = figure(c), before = i > 0 ? figure(curve[i - 1]) : null;
      const order = before === null ? null : Math.log(value / before) / Math.log(c.parameters[key] / curve[i - 1].parameters[key]);
      return { c, key: c.parameters[key], value, before, order };
    });
  });
}
const row = (title, key) => (r) => [r.method, Number(r[key]), Number(r[title]), r[title.replace(/^[^(]*/, "before ").trim()], r.order].map((v, i) => (i < 3 ? v : v === "" ? "" : Number(v)));
const wanted = (s) => [s.c.method, s.key, s.value, s.before ?? "", s.order ?? ""];
async function check(page, caption, title, key, samples) {
  const rows = await saved(page, caption);
  assert.equal(rows.length, samples.length);
  assert.equal(sameRows(rows, row(title, key), samples, wanted, 2e-5), "");
}

test("the table has each sample's error, the one before and the order", async () => {
  const page = await open("front", { hash: "v=convergence" });
  await page.waitForSelector(".chart svg");
  const samples = samplesOf(casesOf(front, group), "N", (c) => errorOf(c, "smape"));
  assert.ok(samples.length > 30);
  await check(page, "SMAPE over N", "SMAPE (%)", "N", samples);
  assert.match(await page.locator(".note").first().textContent(), new RegExp(`^${samples.filter((s) => s.before === null).length} curves`));
  assert.deepEqual([page.errors, page.requests], [[], []]);
});

test("points stand at their figures, and reading tells them with their intervals", async () => {
  const page = await open("front", { hash: "v=convergence" });
  await page.waitForSelector(".chart svg");
  const samples = samplesOf(casesOf(front, group), "N", (c) => errorOf(c, "smape"));
  const [x, y] = [await axisOf(page, ".chart", "x"), await axisOf(page, ".chart", "y")];
  const places = await page.locator(".chart g[data-mark='dot'] > *").evaluateAll((all) => all.map((e) => e.getBoundingClientRect()).map((b) => [b.x + b.width / 2, b.y + b.height / 2]));
  assert.equal(places.length, samples.length);
  const left = [...samples];
  await page.locator(".chart").focus();
  for (const [px, py] of places) {
    await page.keyboard.press("ArrowRight");
    const [label, figures] = (await page.locator(".tip").innerText()).split("\n");
    const [key, ...shown] = numbers(figures.replace("N = ", ""));
    const at = left.findIndex((s) => label.startsWith(s.c.method) && s.key === key && isFigure(shown[0], s.value) && Math.abs(py - y(s.value)) < 3);
    assert.ok(at >= 0, `no case has ${label}, ${figures}`);
    const [s] = left.splice(at, 1);
    assert.ok(Math.abs(px - x(s.key)) < 3, s.c.id);
    if (shown.length > 1) intervalOf(s.c, "smape").forEach((v, i) => assert.ok(isFigure(shown[i + 1], v), `${s.c.id}: ${figures}, not ${v}`));
  }
  assert.equal(left.length, 0);
});

test("time, setting, methods and scene change the curves", async () => {
  const page = await open("front", { hash: "v=convergence" });
  await page.locator("#co-of").selectOption("time");
  await check(page, "method time over N", "method time (ms)", "N", samplesOf(casesOf(front, group), "N", (c) => timeOf(c, "method")));
  await page.locator("#time").selectOption("frame");
  await page.locator("#co-key").selectOption("importance_lights");
  await page.getByLabel("mfis", { exact: true }).uncheck();
  const left = (g) => casesOf(front, g).filter((c) => c.method !== "mfis");
  await check(page, "frame time over importance_lights", "frame time (ms)", "importance_lights", samplesOf(left(group), "importance_lights", (c) => timeOf(c, "frame")));
  const other = front.analysis.groups.findIndex((g) => g.scene === "ring514" && g.visibility === "full");
  await page.locator("#group").selectOption(String(other));
  await page.locator("#co-of").selectOption("error");
  await page.locator("#metric").selectOption("rmse");
  await check(page, "RMSE over importance_lights", "RMSE", "importance_lights", samplesOf(left(front.analysis.groups[other]), "importance_lights", (c) => errorOf(c, "rmse")));
});
