// Every view of every page: no error, nothing leaves the page; large reports are fast enough; light, dark and keys.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, has, open, report } from "./harness.mjs";
import { made } from "./made.mjs";

after(close);
const names = ["front", "flicker", "history", "images", "pair"].filter(has);

for (const name of names) {
  for (const width of [1280, 400]) {
    test(`${name}, ${width} px: every view draws, without error or request, and fits the width`, async () => {
      const page = await open(name, { width });
      const tabs = await page.getByRole("tab").all();
      assert.ok(tabs.length >= 2);
      for (const tab of tabs) {
        await tab.click();
        await page.waitForTimeout(150);
        const title = await tab.textContent();
        assert.equal(await tab.getAttribute("aria-selected"), "true", title);
        assert.ok((await page.locator("#view > *").count()) > 0, title);
        assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${title} is wider than the window`);
      }
      assert.deepEqual([page.errors, page.requests], [[], []]);
    });
  }
}

test("the head says what was measured, on what", async () => {
  const of = report("front");
  const page = await open("front");
  const text = await page.locator("header").textContent();
  for (const part of [of.config.name, of.environment.device.name, of.git.commit.slice(0, 10), `${of.cases.length}`]) assert.ok(text.includes(part), part);
});

test("arrow keys move along the tabs, the URL keeps the view", async () => {
  const page = await open("front");
  await page.getByRole("tab").first().focus();
  await page.keyboard.press("ArrowRight");
  const title = await page.locator("[role=tab][aria-selected=true]").textContent();
  assert.equal(await page.evaluate(() => document.activeElement.textContent), title);
  assert.equal(title, await page.getByRole("tab").nth(1).textContent());
  const again = await open("front", { hash: new URL(page.url()).hash.slice(1) });
  assert.equal(await again.locator("[role=tab][aria-selected=true]").textContent(), title);
});

test("dark by the system's choice, and by the button", async () => {
  const ground = (page) => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const [light, dark] = [await ground(await open("front")), await ground(await open("front", { dark: true }))];
  assert.notEqual(light, dark);
  const page = await open("front");
  await page.getByRole("button", { name: "Dark" }).click();
  assert.equal(await ground(page), dark);
  assert.match(page.url(), /d=dark/);
});

// Every case 20 times, each with other figures.
function many({ reports: [r] }) {
  const count = r.cases.id.length, times = Math.ceil(10000 / count);
  const again = (column, f = (v) => v) => Array.from({ length: count * times }, (_, i) => f(column[i % count], 1 + Math.floor(i / count) * 0.013, i));
  const scaled = (v, by) => (v === null ? null : v * by);
  const estimates = (e) => Object.assign(e, { value: again(e.value, scaled), lo: again(e.lo, scaled), hi: again(e.hi, scaled) });
  for (const key of ["label", "group", "scene", "method", "status", "message", "passes"]) r.cases[key] = again(r.cases[key]);
  r.cases.id = again(r.cases.id, (v, _, i) => `${v},copy=${i}`);
  for (const key of Object.keys(r.cases.parameters)) r.cases.parameters[key] = again(r.cases.parameters[key]);
  for (const key of Object.keys(r.cases.extra)) r.cases.extra[key] = again(r.cases.extra[key]);
  Object.values(r.cases.times).forEach(estimates);
  for (const e of Object.values(r.cases.errors)) {
    estimates(e);
    Object.assign(e, { heavy: again(e.heavy), seeds: again(e.seeds, (v, by) => v?.map((s) => s * by) ?? null) });
  }
}

test("10,000 cases: the first view within 3 s, a filter within 1 s", async () => {
  const file = made("front", many);
  const begun = Date.now();
  const page = await open(file);
  await page.waitForSelector(".plot svg circle, .plot svg path", { state: "attached" }); // the first is a tick, which has no area
  const first = Date.now() - begun;
  assert.ok(first < 3000, `first view after ${first} ms`);
  const timed = (act) => page.evaluate(async (code) => {
    const begun = performance.now();
    new Function(code)();
    await new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
    return performance.now() - begun;
  }, act);
  const spans = {};
  spans.method = await timed(`document.getElementById("method-vpl").click()`);
  spans.metric = await timed(`const s = document.getElementById("metric"); s.value = "rmse"; s.dispatchEvent(new Event("change"))`);
  for (const id of ["passes", "budget", "knobs", "convergence", "cases"]) spans[id] = await timed(`document.getElementById("tab-${id}").click()`);
  spans.words = await timed(`const s = document.querySelector("#view input[type=search]"); s.value = "sponza kmeans"; s.dispatchEvent(new Event("input"))`);
  spans.sort = await timed(`document.querySelectorAll("#view thead button")[4].click()`);
  console.log(`# 10,000 cases: first view ${first} ms, ` + Object.entries(spans).map(([k, v]) => `${k} ${v.toFixed(0)}`).join(", "));
  for (const [what, ms] of Object.entries(spans)) assert.ok(ms < 1000, `${what}: ${ms} ms`);
  assert.deepEqual(page.errors, []);
});
