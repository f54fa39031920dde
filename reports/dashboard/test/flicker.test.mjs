// The flicker view against the report: figures, series, what hovering tells, filters, pictures.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, test } from "node:test";
import { close, open, report } from "./harness.mjs";
import { assertSound } from "./sound.mjs";

const told = report("flicker");
const scene = told.cases.find((c) => c.temporal).scene;
const cases = told.cases.filter((c) => c.temporal && c.scene === scene);

after(close);

const number = (text) => Number(text.replace("−", "-"));
const near = (got, want, share, what) => assert.ok(Math.abs(got - want) <= share * Math.abs(want), `${what}: ${got}, not ${want}`);
function clean(page) {
  assert.deepEqual(page.errors, []);
  assert.deepEqual(page.requests, []);
}
const look = async (hash = "", options = {}) => {
  const page = await open("flicker", { hash: "v=flicker" + hash, ...options });
  await page.waitForSelector(".chart svg");
  return page;
};
// Of a table's CSV: a row by column title; titles that come again have a number: "p99", "p99 2".
async function saved(page, label) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: `Save as CSV: ${label}` }).click()]);
  const [head, ...lines] = readFileSync(await download.path(), "utf8").trim().split("\r\n").map((l) => l.split(","));
  const titles = head.map((t, i) => (head.indexOf(t) === i ? t : `${t} ${head.slice(0, i + 1).filter((u) => u === t).length}`));
  return lines.map((l) => Object.fromEntries(titles.map((t, i) => [t, l[i]])));
}

test("the table has the report's figures", async () => {
  const page = await look();
  const rows = await saved(page, "Flicker and detail");
  assert.equal(rows.length, cases.length);
  cases.forEach(({ id, temporal: t }, i) => {
    const row = rows[i];
    const same = (title, want) => (want === undefined ? assert.equal(row[title], "", `${id} ${title}`) : near(Number(row[title]), want, 1e-6, `${id} ${title}`));
    same("derivative", t.derivative?.value), same("from", t.derivative?.ci95?.[0]), same("to", t.derivative?.ci95?.[1]), same("p99", t.derivative?.p99);
    assert.equal(row["worst frame"], String(t.derivative.worst_frame));
    same("static", t.static?.value), same("from 2", t.static?.ci95?.[0]), same("to 2", t.static?.ci95?.[1]), same("p99 2", t.static?.p99);
    same("detail", t.detail?.value), same("from 3", t.detail?.ci95?.[0]), same("to 3", t.detail?.ci95?.[1]), same("gain", t.detail?.gain);
    same("noise floor", t.noise_floor), same("black image", t.unlit);
  });
  // Shown in three digits.
  const shown = await page.locator(".table").first().locator("tbody tr").first().locator("td").allTextContents();
  near(number(shown[0]), cases[0].temporal.derivative.value, 6e-3, "shown");
  clean(page);
});

test("the series is the report's, its worst frame marked", async () => {
  const page = await look();
  await page.getByText("Figures of the series").click();
  const rows = await saved(page, "derivative of each frame");
  const want = cases.flatMap((c) => c.temporal.derivative.series.map((v, i) => [i + 1, v, i + 1 === c.temporal.derivative.worst_frame]));
  assert.equal(rows.length, want.length);
  rows.forEach((row, i) => {
    assert.equal(Number(row.frame), want[i][0]);
    near(Number(row.derivative), want[i][1], 1e-6, `row ${i}`);
    assert.equal(row.worst, want[i][2] ? "worst" : "");
  });
  // The worst is the largest of its series.
  for (const c of cases) assert.equal(Math.max(...c.temporal.derivative.series), c.temporal.derivative.series[c.temporal.derivative.worst_frame - 1]);
  clean(page);
});

// Marks are where they stand for the reader: found by their place in the picture, asked by the mouse.
async function hover(page, chart, places) {
  const texts = [];
  for (const [x, y] of places) {
    await page.mouse.move(x, y);
    await page.waitForTimeout(60);
    texts.push((await page.locator(".chart").nth(chart).locator("g:is([aria-label='tip'], [data-mark='tip'])").textContent()) ?? "");
  }
  return texts;
}
// Middles of the marks of the n-th group of dots on the screen.
const marks = (page, chart, group) => page.locator(".chart").nth(chart).locator("g[data-mark='dot']").nth(group).locator("path, circle").evaluateAll((all) => all.map((e) => {
  const b = e.getBoundingClientRect();
  return [b.x + b.width / 2, b.y + b.height / 2];
}));

test("hovering tells the report's figures", async () => {
  const page = await look();
  await page.locator(".chart").first().scrollIntoViewIfNeeded();
  const first = await hover(page, 0, await marks(page, 0, 0));
  cases.forEach((c, i) => {
    const [, value, lo, hi] = /derivative (\S+) \((\S+) to (\S+)\)/.exec(first[i]) ?? assert.fail(first[i]);
    near(number(value), c.temporal.derivative.value, 6e-3, c.id), near(number(lo), c.temporal.derivative.ci95[0], 6e-3, c.id), near(number(hi), c.temporal.derivative.ci95[1], 6e-3, c.id);
  });
  await page.locator(".chart").nth(1).scrollIntoViewIfNeeded();
  const worst = await hover(page, 1, await marks(page, 1, 1));
  const known = cases.map((c) => c.temporal.derivative).map((d) => [d.worst_frame, d.series[d.worst_frame - 1]]);
  assert.equal(worst.length, known.length);
  worst.forEach((text) => {
    const [, frame, before, value] = /frame (\d+) against (\d+): (\S+?), the worst/.exec(text) ?? assert.fail(text);
    assert.equal(Number(before), Number(frame) - 1);
    assert.ok(known.some(([f, v]) => f === Number(frame) && Math.abs(v - number(value)) <= 6e-3 * v), text);
  });
  clean(page);
});

test("ground lines stand for noise floor and black image", async () => {
  const page = await look();
  const x = (g) => page.locator(".chart").first().locator(g).evaluateAll((all) => all.map((e) => e.getBoundingClientRect()).map((b) => b.x + b.width / 2));
  const lines = await x("g[data-mark='rule'] line[stroke-dasharray], g[data-mark='rule'][stroke-dasharray] line");
  const dots = (await marks(page, 0, 0)).map(([left]) => left);
  // Places grow evenly with values: two dots tell where the lines must be.
  const v = cases.map((c) => c.temporal.derivative.value);
  const [i, j] = [v.indexOf(Math.min(...v)), v.indexOf(Math.max(...v))];
  const place = (value) => dots[i] + ((value - v[i]) / (v[j] - v[i])) * (dots[j] - dots[i]);
  const wanted = [cases[0].temporal.noise_floor, cases[0].temporal.unlit].filter((w) => w !== undefined);
  wanted.forEach((w) => assert.ok(lines.some((l) => Math.abs(l - place(w)) < 3), `no line at ${w}: ${lines}, ${place(w)}`));
  clean(page);
});

test("filters and the URL", async () => {
  const page = await look();
  const method = cases[0].method;
  await page.locator(`[id="method-${method}"]`).uncheck();
  assert.equal(await page.locator(".table").first().locator("tbody tr").count(), cases.filter((c) => c.method !== method).length);
  await page.locator("#fl-measure").selectOption("static");
  assert.match(await page.evaluate(() => location.hash), /fl\.m=static/);
  const again = await look("&fl.m=static");
  await again.getByText("Figures of the series").click();
  const rows = await saved(again, "static of each seed");
  const want = cases.flatMap((c) => c.temporal.static?.series ?? []);
  assert.equal(rows.length, want.length);
  rows.forEach((row, i) => near(Number(row.static), want[i], 1e-6, `seed ${row.seed}`));
  clean(page), clean(again);
});

test("pictures of the worst crop, where the page has them", async (t) => {
  const page = await look();
  const pictures = page.locator(".flicker-pictures img");
  if (!cases.some((c) => c.images?.flicker || c.images?.profile)) assert.equal(await pictures.count(), 0);
  if ((await pictures.count()) === 0) return t.skip("the page has no such pictures");
  await page.waitForFunction(() => [...document.querySelectorAll(".flicker-pictures img")].every((i) => i.complete && i.naturalWidth > 0));
  await page.getByRole("button", { name: "Stop" }).first().click();
  assert.equal(await page.locator(".flicker-pictures canvas").first().isVisible(), true);
  assert.equal(await pictures.first().isVisible(), false);
  clean(page);
});

test("no serious accessibility fault", async () => {
  for (const dark of [false, true]) await assertSound(await look("", { dark }));
});
