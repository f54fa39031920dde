// The history, with figures that are known: series i has 10 (i + 1) ms, but for the steps.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { after, test } from "node:test";
import { close, open, saved } from "./harness.mjs";
import { made, madeHistory } from "./made.mjs";
import { assertSound } from "./sound.mjs";

after(close);

// Series 0, 2, 4 are of cornell, 1, 3, 5 of ring514; methods mfis, fis, vpl in turn.
const steps = [[2, 20, 1.1], [4, 30, 0.9, false], [2, 40, 0.95]];
const few = () => madeHistory({ reports: 50, series: 6, steps, refused: [25] });
const page = (history, options) => open(made("front", (d) => { d.history = history; }), { ...options, hash: `v=history${options?.hash ?? ""}` });
const tip = (p) => p.locator(".history-tip:not([hidden])");

// A point of a chart: its report as a share of those shown, its height as a share of the frame's.
async function at(p, frame, share, height = 0.4) {
  await frame.scrollIntoViewIfNeeded();
  const box = await frame.boundingBox();
  return { x: box.x + 64 + share * (box.width - 64 - 20), y: box.y + height * box.height };
}
async function hover(p, frame, share, height) {
  const { x, y } = await at(p, frame, share, height);
  await p.mouse.move(x, y);
}

test("the persistent changes lead to their series, with its figures", async () => {
  const p = await page(few());
  const lists = p.locator("section.table");
  assert.equal(await lists.nth(0).locator("tbody tr").count(), 2);
  assert.equal(await lists.nth(1).locator("tbody tr").count(), 3);
  const first = await lists.nth(0).locator("tbody tr").first().locator("th, td").allTextContents();
  assert.deepEqual(first.slice(0, 8), ["41", "▼ faster", "−5.0 %", "−5.9 %", "−4.1 %", "method time", "cornell", "vpl N=2"]);
  await lists.nth(0).locator("tbody tr").nth(1).click();
  const opened = p.locator("#hi-opened");
  assert.match(await opened.locator("h3").textContent(), /cornell · vpl N=2/);
  const text = await opened.locator(".opened-figures").innerText();
  assert.match(text, /method time 33 ms \[32\.67 … 33\.33\]/);
  assert.match(text, /since the report before \+10 %/);
  assert.match(text, /▲ slower \+10 % \[\+8\.9 % … \+11 %\], persistent/);
  assert.match(text, /report 21 of 50: 0015001500, 2026-01-21/);
  assert.match(text, /A\/A noise ± 2 %/);
  assert.match(p.url(), /hi\.s=2&hi\.r=20/);
  await assertSound(p);
});

// The page of 300 made reports, by the programme's own verdicts.
test("of 300 reports the two steps and what crept are found, with their report and size", async () => {
  const { steps: known, crept } = JSON.parse(readFileSync(join(process.env.VSGLBENCH_DASHBOARD_PAGES, "history/steps.json"), "utf8"));
  const p = await open("history", { hash: "v=history" });
  const rows = (await saved(p, "Persistent changes")).filter((r) => r.of === "method time");
  const of = (id) => rows.filter((r) => r.case === id);
  for (const s of known) {
    const [step] = of(s.case);
    assert.deepEqual([of(s.case).length, Number(step.report), step["crept until"]], [1, s.report + 1, ""]);
    assert.ok(Math.abs(Number(step.by) / s.ratio - 1) < 0.01, `${step.by}: ${s.ratio}`);
  }
  const [creep] = of(crept.case);
  assert.deepEqual([of(crept.case).length, creep.change], [1, "slower"]);
  assert.ok(Math.abs(Number(creep.by) / crept.ratio - 1) < 0.005, creep.by);
  // A quarter and three quarters of the way.
  for (const [share, report] of [[0.25, creep.report], [0.75, creep["crept until"]]]) assert.ok(Math.abs(Number(report) - 1 - (crept.from + share * (crept.to - crept.from))) < 10, report);
  assert.equal(rows.length, 3, JSON.stringify(rows.map((r) => [r.case, r.report, r.by])));
});

test("what crept is told with the reports between which it did, and a dashed line joins them", async () => {
  const p = await page(madeHistory({ reports: 60, series: 3, scenes: ["cornell"], crept: [[1, 10, 40, 1.2]], steps: [[0, 30, 1.1]] }), { hash: "&hi.s=1&hi.r=10&hi.b=absolute" });
  assert.match(await p.locator("#hi-opened .opened-figures").innerText(), /crept: ▲ slower \+20 % \[\+19 % … \+21 %\], from report 11 to 41/);
  const rows = p.locator("section.table").first().locator("tbody tr");
  assert.deepEqual((await rows.locator("td:nth-child(9)").allTextContents()), ["–", "41"]);
  const chart = p.locator(".history-panels .history-frame").first();
  assert.equal(await chart.locator("line.crept").count(), 1);
  const place = async (selector) => chart.locator(selector).evaluate((e) => { const r = e.getBoundingClientRect(); return [r.x, r.y, r.right, r.bottom]; });
  const [x0, , x1] = await place("line.crept"), box = await chart.boundingBox();
  const at = (report) => box.x + 64 + (report / 59) * (box.width - 64 - 20);
  assert.ok(Math.abs(x0 - at(10)) < 2 && Math.abs(x1 - at(40)) < 2, `${x0} to ${x1}: ${at(10)} to ${at(40)}`);
  await assertSound(p);
});

test("hovering gives commit, date, settings and the figure with its interval", async () => {
  const p = await page(few(), { hash: "&hi.s=2" });
  const frame = p.locator("#hi-opened .history-frame");
  await hover(p, frame, 1);
  const text = await tip(p).innerText();
  assert.match(text, /method time 31\.35 ms \[31\.04 … 31\.66\]/); // 30 × 1.1 × 0.95
  assert.match(text, /since the first \+4\.5 %/);
  assert.match(text, /report 50 of 50: 0032003200, 2026-02-19/);
  assert.match(text, /settings nightly, llvmpipe/);
  await hover(p, frame, 25 / 49);
  assert.match(await tip(p).innerText(), /not compared: the references differ/);
  assert.equal(await frame.locator(".cross title").textContent(), "001a001 was not compared: the references differ");
});

test("changes are marked on their line: by direction, and whether they lasted", async () => {
  const p = await page(few(), { hash: "&hi.scene=cornell&hi.b=absolute" });
  const marks = await p.locator(".history-panels .marks path").evaluateAll((paths) => paths.map((m) => ({ d: m.getAttribute("d"), kind: m.getAttribute("class"), fill: getComputedStyle(m).fill })));
  assert.deepEqual(marks.map((m) => m.kind).sort(), ["change-better", "change-better passing", "change-worse"]);
  const of = (kind) => marks.find((m) => m.kind === kind);
  assert.notEqual(of("change-worse").d, of("change-better").d);
  assert.notEqual(of("change-better").fill, of("change-better passing").fill);
});

test("noise lies round the level between two changes, twice as wide as the intervals", async () => {
  const p = await page(few(), { hash: "&hi.s=2&hi.r=20&hi.b=absolute" });
  const bands = await p.locator("#hi-opened .noise").evaluateAll((rects) => rects.map((r) => r.getBoundingClientRect().toJSON()));
  const whisker = await p.locator("#hi-opened .whisker").evaluate((l) => l.getBoundingClientRect().height);
  assert.equal(bands.length, 3); // 30, 33 and 31.35 ms
  assert.ok(Math.abs(bands[1].height / whisker - 2) < 0.03, `${bands[1].height} and ${whisker}`);
  assert.ok(bands[1].height > bands[0].height && bands[0].width > bands[2].width);
  assert.ok(bands[0].right < bands[1].left && bands[1].right < bands[2].left, "a band ends where the next begins");
});

test("the mean of a method takes steps with its series, none where one begins late", async () => {
  const history = madeHistory({ reports: 30, series: 4, methods: ["mfis"], scenes: ["cornell"], steps: [[1, 10, 1.21]] });
  for (const name of ["value", "lo", "hi"]) history.series[3].values.method[name].fill(null, 0, 15);
  const p = await page(history, { hash: "&hi.l=mean" });
  const frame = p.locator(".history-frame").first();
  const since = async (share) => {
    await hover(p, frame, share);
    return (await tip(p).innerText()).match(/since the first (.*)/)[1];
  };
  assert.equal(await since(5 / 29), "0 %");
  assert.equal(await since(12 / 29), "+6.6 %"); // one of three by 1.21: the cube root of it
  assert.equal(await since(1), "+6.6 %");
  // Nor does the one that begins with the step take part in it.
  const joined = structuredClone(history);
  for (const name of ["value", "lo", "hi"]) joined.series[3].values.method[name].fill(40, 10, 15);
  const q = await page(joined, { hash: "&hi.l=mean" });
  await hover(q, q.locator(".history-frame").first(), 12 / 29);
  assert.match(await tip(q).innerText(), /since the first \+6\.6 %/);
  await hover(p, frame, 10 / 29);
  assert.match(await tip(p).innerText(), /changed most: mfis N=1 \+21 %/);
});

test("arrow keys go from report to report and line to line, Enter opens", async () => {
  const p = await page(few(), { hash: "&hi.scene=cornell&hi.b=absolute" });
  await p.locator(".history-frame").first().focus();
  await p.keyboard.press("ArrowLeft");
  assert.match(await tip(p).innerText(), /mfis N=0[\s\S]* 10 ms[\s\S]*report 50 of 50/);
  await p.keyboard.press("ArrowLeft");
  await p.keyboard.press("ArrowUp");
  assert.match(await tip(p).innerText(), /vpl N=2[\s\S]* 31\.35 ms[\s\S]*report 49 of 50/);
  assert.match(await p.locator(".history-panel [aria-live]").first().textContent(), /vpl N=2/);
  await p.keyboard.press("Enter");
  assert.match(await p.locator("#hi-opened h3").textContent(), /vpl N=2/);
});

test("dragging zooms, a button shows all again, and filters last in the URL", async () => {
  const p = await page(few(), { hash: "&hi.scene=cornell" });
  const frame = p.locator(".history-frame").first();
  const from = await at(p, frame, 10 / 49), to = await at(p, frame, 30 / 49);
  await p.mouse.move(from.x, from.y);
  await p.mouse.down();
  await p.mouse.move(to.x, to.y, { steps: 4 });
  await p.mouse.up();
  assert.match(p.url(), /hi\.from=10&hi\.to=30/);
  await p.getByRole("searchbox", { name: "Series" }).focus();
  await p.keyboard.type("N=4", { delay: 260 }); // slower than the filter waits: the caret must stay where it is
  await p.locator(".history-panel h3", { hasText: "1 series" }).waitFor();
  await p.getByLabel("Column").selectOption("smape");
  await p.reload();
  await p.waitForSelector(".history-panel");
  assert.match(await p.locator(".history-panel h3").first().textContent(), /cornell: SMAPE, 1 series/);
  await hover(p, p.locator(".history-frame").first(), 1);
  assert.match(await tip(p).innerText(), /fis N=4[\s\S]*SMAPE 9 %[\s\S]*report 31 of 50/);
  await p.locator(".history-frame").first().focus();
  await p.keyboard.press("+");
  assert.match(p.url(), /hi\.from=25&hi\.to=35/); // half as many round the last
  await p.getByRole("button", { name: "All 50 reports" }).click();
  assert.doesNotMatch(p.url(), /hi\.from/);
  assert.deepEqual(p.errors, []);
});

test("the figures of the lines are a table, too", async () => {
  const p = await page(few(), { hash: "&hi.s=2" });
  await p.getByText("Figures of vpl N=2 as a table").click();
  const rows = p.locator("details.later tbody tr");
  assert.equal(await rows.count(), 50);
  assert.deepEqual((await rows.nth(20).locator("th, td").allTextContents()).slice(4, 8), ["vpl N=2", "33", "32.67", "33.33"]);
});

test("boxes are of all methods of the history, those of the newest report or not", async () => {
  const p = await page(madeHistory({ reports: 5, series: 4, methods: ["mfis", "gone"] }));
  await p.getByLabel("gone", { exact: true }).uncheck();
  assert.equal(await p.locator(".history-panel h3", { hasText: "gone" }).count(), 0);
  assert.match(await p.locator(".history-panel h3").first().textContent(), /, 2 series$/);
  assert.match(p.url(), /x=gone/);
});

test("on paper all is light, whatever the page is", async () => {
  const p = await page(few(), { dark: true });
  const ink = () => p.locator(".history-frame canvas").first().evaluate((c) => {
    const data = c.getContext("2d").getImageData(0, 0, c.width, c.height).data;
    const seen = new Map();
    for (let i = 0; i < data.length; i += 4) if (data[i + 3] === 255) seen.set(data.slice(i, i + 3).join(), (seen.get(data.slice(i, i + 3).join()) ?? 0) + 1);
    return [...seen].sort((a, b) => b[1] - a[1]).slice(0, 3).map(([colour]) => colour).sort().join(" ");
  });
  const dark = await ink();
  await p.evaluate(() => window.dispatchEvent(new Event("beforeprint")));
  const paper = await ink();
  assert.notEqual(paper, dark);
  await p.evaluate(() => window.dispatchEvent(new Event("afterprint")));
  assert.equal(await ink(), dark);
  await p.emulateMedia({ colorScheme: "light" });
  await p.waitForTimeout(100);
  assert.equal(await ink(), paper);
});

test("dark and narrow are sound", async () => {
  await assertSound(await page(few(), { dark: true, width: 400, hash: "&hi.s=2" }));
});
