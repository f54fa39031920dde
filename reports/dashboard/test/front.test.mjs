// Error against time: figures are those of the report, filters change the front, the URL brings a view back.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, downloaded, isFigure, numbers, open, report, rowsOf } from "./harness.mjs";
import { made } from "./made.mjs";

after(close);
const front = report("front");
const groups = (metric) => front.analysis.groups.filter((g) => g.metric === metric);
const cases = (group) => front.cases.filter((c) => c.scene === group.scene && c.accuracy?.reference.hash === group.reference);

// Pixels of a value on an axis of the chart, from two of its labelled ticks.
async function axisOf(page, axis) {
  const ticks = await page.$$eval(`.plot g[data-mark="${axis}-axis tick label"] text`, (texts) => texts.map((t) => ({ value: Number(t.textContent), at: /translate\(([\d.]+),([\d.]+)\)/.exec(t.getAttribute("transform")).slice(1).map(Number) })));
  const at = (t) => t.at[axis === "x" ? 0 : 1], a = ticks[0], b = ticks.at(-1);
  return (v) => at(a) + ((at(b) - at(a)) * Math.log(v / a.value)) / Math.log(b.value / a.value);
}

// Where a case of the chart is, in pixels of the window.
async function place(page, ms, error) {
  const [x, y] = [await axisOf(page, "x"), await axisOf(page, "y")];
  await page.locator(".plot").scrollIntoViewIfNeeded();
  const box = await page.locator(".plot").boundingBox();
  return [box.x + x(ms), box.y + y(error)];
}

const facts = (page) => page.$$eval(".details dl.list > div", (rows) => Object.fromEntries(rows.map((r) => [r.children[0].textContent, r.children[1].textContent])));

test("hovering a point of the front gives its figures, passes, settings and neighbours", async () => {
  const group = groups("smape")[0];
  const page = await open("front");
  await page.waitForSelector(".plot svg");
  const at = group.front.length - 2; // with neighbours on both sides
  const point = group.front[at], next = group.front[at + 1], before = group.front[at - 1];
  await page.mouse.move(...(await place(page, point.ms, point.error)));
  const shown = await facts(page);
  const [ms, msLo, msHi] = numbers(shown.method), [error, errorLo, errorHi] = numbers(shown.SMAPE);
  for (const [figure, exact] of [[ms, point.ms], [msLo, point.ms_ci95[0]], [msHi, point.ms_ci95[1]], [error, point.error], [errorLo, point.error_ci95[0]], [errorHi, point.error_ci95[1]]]) {
    assert.ok(isFigure(figure, exact), `${figure} is not ${exact}`);
  }
  const of = front.cases.find((c) => c.id === point.case);
  assert.equal(shown.N, String(of.parameters.N));
  const slowest = of.passes.reduce((a, b) => (a.median_ms > b.median_ms ? a : b));
  assert.ok(isFigure(numbers(shown[slowest.name])[0], slowest.median_ms));
  const steps = await page.$$eval(".details .step strong", (s) => s.map((e) => e.textContent));
  assert.match(steps[0], /^\+.* ms buys −.* % SMAPE$/);
  assert.match(steps[1], /^−.* ms costs \+.* % SMAPE$/);
  for (const [step, to] of [[steps[0], next], [steps[1], before]]) {
    const [more, brings] = numbers(step);
    assert.ok(isFigure(more, to.ms - point.ms), `${step}: ${to.ms - point.ms}`);
    assert.ok(isFigure(brings, to.error - point.error), `${step}: ${to.error - point.error}`);
  }
  assert.deepEqual([page.errors, page.requests], [[], []]);
});

test("a dominated point says by what", async () => {
  const group = groups("smape")[0];
  const page = await open("front");
  await page.waitForSelector(".plot svg");
  const rows = await rowsOf(page, "All points of the chart");
  assert.equal(rows.length, group.points);
  const count = (standing) => rows.filter((r) => r.standing === standing).length;
  assert.equal(count("front"), group.front.length);
  for (const standing of ["dominated", "ambiguous"]) assert.equal(count(standing), group.others.filter((o) => o.standing === standing).length, standing);
});

test("a filter changes the front to that of the cases left", async () => {
  const group = groups("smape")[0];
  const gone = cases(group).find((c) => c.id === group.front.at(-1).case).method;
  const left = cases(group).filter((c) => c.method !== gone).map((c) => [c.frame.method.median_ms, c.accuracy.smape.value]);
  const expected = left.filter(([ms, error]) => !left.some(([m, e]) => m <= ms && e <= error && (m < ms || e < error))).sort((a, b) => a[0] - b[0]);
  const page = await open("front");
  const whole = await rowsOf(page, "The front");
  assert.equal(whole.length, group.front.length);
  await page.getByLabel(gone, { exact: true }).uncheck();
  const rows = await rowsOf(page, "The front");
  assert.equal(rows.length, expected.length);
  expected.forEach(([ms, error], i) => {
    assert.ok(isFigure(numbers(rows[i]["method, ms"])[0], ms));
    assert.ok(isFigure(numbers(rows[i]["SMAPE, %"])[0], error));
  });
  assert.match(page.url(), new RegExp(`x=${gone}`));
});

test("metric, time and scene choose other columns of the report", async () => {
  const group = groups("rmse").find((g) => g.scene === "sponza" && g.visibility === "full");
  const page = await open("front");
  await page.getByLabel("Scene").selectOption({ label: "sponza, with occlusion" });
  await page.locator("#metric").selectOption("rmse");
  const rows = await rowsOf(page, "The front");
  assert.equal(rows.length, group.front.length);
  group.front.forEach((p, i) => assert.ok(isFigure(numbers(rows[i].RMSE)[0], p.error), `${rows[i].RMSE}: ${p.error}`));
  await page.locator("#time").selectOption("frame");
  const fastest = Math.min(...cases(group).map((c) => c.frame.span.median_ms));
  assert.ok(isFigure(numbers((await rowsOf(page, "The front"))[0]["frame, ms"])[0], fastest));
});

test("a dragged rectangle zooms, Escape and the button reset", async () => {
  const page = await open("front");
  await page.waitForSelector(".plot svg");
  const labels = () => page.$$eval(".plot g[data-mark$='tick label'] text", (t) => t.map((e) => e.textContent).join(" "));
  const whole = await labels();
  const box = await page.locator(".plot").boundingBox();
  const drag = async () => {
    await page.mouse.move(box.x + box.width * 0.6, box.y + 100);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width * 0.8, box.y + 300, { steps: 4 });
    await page.mouse.up();
  };
  await drag();
  assert.notEqual(await labels(), whole);
  assert.match(page.url(), /fr\.z=/);
  assert.doesNotMatch(page.url(), /[#&]c=/); // a drag selects nothing
  await page.locator(".plot").press("Escape");
  assert.equal(await labels(), whole);
  await drag();
  await page.getByRole("button", { name: "Reset zoom" }).click();
  assert.equal(await labels(), whole);
});

test("keys read and select points; the URL restores all that was chosen", async () => {
  const group = groups("smape")[1];
  const page = await open("front");
  await page.getByLabel("Scene").selectOption("1");
  await page.getByLabel("mfis", { exact: true }).uncheck();
  await page.locator(".plot").focus();
  for (const key of ["End", "Enter", "+", "+"]) await page.keyboard.press(key);
  const wanted = front.cases.findIndex((c) => c.id === group.front.at(-1).case);
  assert.match(page.url(), new RegExp(`[#&]c=${wanted}(&|$)`));
  await page.getByRole("button", { name: "SMAPE, %" }).first().click(); // sorts
  const look = async (p) => {
    await p.mouse.move(0, 0);
    await p.waitForSelector(".plot svg");
    return p.evaluate(() => [...document.querySelectorAll("#view table, .plot text, .details")].map((e) => e.textContent).join("|") + document.querySelectorAll(".over .selected circle").length + document.querySelector("th[aria-sort=ascending]")?.textContent);
  };
  const hash = new URL(page.url()).hash.slice(1);
  assert.ok(hash.length < 120, hash);
  await page.locator(".plot").blur();
  await page.evaluate(() => document.querySelector(".plot").dispatchEvent(new PointerEvent("pointerleave")));
  const again = await open("front", { hash });
  assert.equal(await look(again), await look(page));
  assert.equal(await again.getByLabel("mfis", { exact: true }).isChecked(), false);
  await again.getByRole("tab", { name: "Passes" }).click();
  const rows = await rowsOf(again, "Medians of the passes"); // of the selected case alone
  assert.equal(rows.length, 1);
});

test("the noise of the reference is drawn where it is", async () => {
  const of = cases(groups("smape")[0])[0].accuracy.reference.noise_floor_smape;
  const page = await open("front");
  const text = await page.locator(".plot text", { hasText: "noise of the reference" }).textContent();
  assert.ok(isFigure(numbers(text)[0], of), text);
});

test("the table sorts, filters and saves what it shows", async () => {
  const group = groups("smape")[0];
  const page = await open("front");
  const section = page.locator("section.table", { hasText: "All points of the chart" });
  const head = section.getByRole("columnheader", { name: "SMAPE" });
  await head.getByRole("button").click();
  assert.equal(await head.getAttribute("aria-sort"), "ascending");
  await head.getByRole("button").press("Enter");
  assert.equal(await head.getAttribute("aria-sort"), "descending");
  await section.getByRole("searchbox").fill("ambiguous");
  const { name, text } = await downloaded(page, () => section.getByRole("button", { name: "Save as CSV" }).click());
  assert.match(name, /\.csv$/);
  const lines = text.trim().split("\r\n");
  const expected = group.others.filter((o) => o.standing === "ambiguous").map((o) => front.cases.find((c) => c.id === o.case)).map((c) => c.accuracy.smape.value).sort((a, b) => b - a);
  assert.ok(expected.length > 0);
  assert.equal(lines.length, expected.length + 1);
  lines.slice(1).forEach((line, i) => assert.ok(line.split(",").some((cell) => Math.abs(Number(cell) / expected[i] - 1) < 1e-6), `${line}: ${expected[i]}`));
});

test("failed and skipped cases are listed, each with its reason", async () => {
  const page = await open(
    made("front", ({ reports: [r] }) => {
      const fail = (c, status, message) => {
        Object.assign(r.cases, { status: r.cases.status.with(c, status), message: r.cases.message.with(c, message), group: r.cases.group.with(c, -1) });
      };
      fail(0, "failed", "NaN in 3 pixels <b>of</b> the image");
      fail(1, "skipped", "took longer than 600 s");
    }),
  );
  const rows = await rowsOf(page, "Failed and skipped cases of the scene");
  assert.deepEqual(rows.map((r) => [r.status, r.why]), [["failed", "NaN in 3 pixels <b>of</b> the image"], ["skipped", "took longer than 600 s"]]);
  await page.getByRole("tab", { name: "Cases" }).click();
  assert.equal((await rowsOf(page, "All cases"))[0].why, "NaN in 3 pixels <b>of</b> the image");
  assert.deepEqual(page.errors, []);
});

test("a method keeps its colour whatever is hidden", async () => {
  const page = await open("front");
  const colours = () => page.$$eval(".method", (m) => Object.fromEntries(m.map((e) => [e.textContent, e.querySelector("path").outerHTML])));
  const before = await colours();
  await page.getByLabel("vpl", { exact: true }).uncheck();
  await page.getByLabel("fis", { exact: true }).uncheck();
  assert.deepEqual(await colours(), before);
  assert.ok(new Set(Object.values(before)).size === Object.keys(before).length);
});
