// Two reports compared, with rows that are known.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, open, report } from "./harness.mjs";
import { digestOf, made } from "./made.mjs";
import { assertSound } from "./sound.mjs";

after(close);

const row = (name, what, base, ratio, half, noise, change) => ({ case: name, method: /\/(.*)| of (.*)|$/.exec(name || what).slice(1).join(""), what, base, now: base === null ? null : base * ratio, ratio, lo: ratio * (1 - half), hi: ratio * (1 + half), noise, change });
const rows = [
  row("cornell/mfis", "method", 10, 1.2, 0.02, 0.03, "slower"), row("cornell/fis", "method", 20, 0.8, 0.02, 0.03, "faster"), row("cornell/vpl", "method", 30, 1.001, 0.01, 0.03, "same"),
  row("cornell/vsl", "method", 40, 1.05, 0.08, 0.03, "ambiguous"), row("cornell/mfis", "smape", 5, 1.4, 0.001, null, "worse"), row("", "pass shade", null, 1.04, 0.01, 0.02, "slower"),
];
const page = (options, change = {}) => open(made("front", (d) => {
  d.reports = [d.reports[0], { ...d.reports[0], commit: "abcdef0123456789" }];
  d.comparison = { base: 0, now: 1, refusal: "", exit_code: 4, summary: "slower  cornell/mfis: +20.0 %\n", rows, ...change };
}), { hash: "v=compare", ...options });

const chart = (p) => p.locator(".ratios tbody tr").evaluateAll((trs) => trs.map((tr) => [...tr.cells].slice(1).map((c) => c.textContent)));

test("regressions come first, what is the same is hidden, figures are the comparison's", async () => {
  const p = await page();
  assert.deepEqual(await chart(p), [
    ["+40 % [+40 % … +40 %]", "▲ worse", "cornell/mfis · smape"], ["+20 % [+18 % … +22 %]", "▲ slower", "cornell/mfis · method"], ["+4.0 % [+3.0 % … +5.0 %]", "▲ slower", "pass shade"],
    ["−20 % [−22 % … −18 %]", "▼ faster", "cornell/fis · method"], ["+5.0 % [−3.4 % … +13 %]", "◇ ambiguous", "cornell/vsl · method"]]);
  assert.match(await p.locator(".verdict").innerText(), /exit code 4: a regression/);
  assert.match(await p.locator(".verdict pre").textContent(), /slower {2}cornell\/mfis: \+20\.0 %/);
  await assertSound(p);
});

test("dots lie on their side of 1, and intervals are as long as they say", async () => {
  const p = await page();
  const marks = await p.locator(".ratios tbody svg").evaluateAll((svgs) => svgs.map((s) => {
    const box = (name) => s.querySelector(name)?.getBoundingClientRect();
    const middle = (b) => (b.left + b.right) / 2;
    return { off: middle(box(".point")) - middle(box(".rule")), length: box(".whisker").width, noise: box(".noise")?.width ?? 0 };
  }));
  const [worse, slower, pass, faster] = marks;
  const px = slower.off / Math.log(1.2); // a unit of the logarithm
  [[worse.off, Math.log(1.4)], [pass.off, Math.log(1.04)], [faster.off, Math.log(0.8)], [slower.length, Math.log(1.02 / 0.98)], [slower.noise, 2 * Math.log(1.03)]]
    .forEach(([is, was]) => assert.ok(Math.abs(is - px * was) < 1, `${is} px for ${px * was}`));
  assert.equal(worse.noise, 0);
});

test("boxes, order and words choose rows, and the URL holds them", async () => {
  const p = await page();
  await p.getByLabel("● same 1").check();
  assert.equal((await chart(p)).length, 6);
  for (const name of ["▲ slower 2", "◇ ambiguous 1", "▲ worse 1"]) await p.getByLabel(name).uncheck();
  await p.getByLabel("Order").selectOption("size");
  const left = ["cornell/fis · method", "cornell/vpl · method"];
  assert.deepEqual((await chart(p)).map((r) => r[2]), left);
  await p.reload();
  await p.waitForSelector(".ratios");
  assert.deepEqual((await chart(p)).map((r) => r[2]), left);
  const cells = await p.locator("section.table tbody tr").first().locator("th, td").allTextContents();
  assert.deepEqual(cells, ["cornell/fis", "method", "▼ faster", "20", "16", "0.8000", "0.7840", "0.8160", "3"]);
  await p.getByLabel("Case", { exact: true }).fill("vpl");
  await p.locator(".ratios h3, h3", { hasText: "1 rows" }).waitFor();
});

test("boxes of methods leave out their cases and passes, not what is over all of them", async () => {
  const p = await page({}, { rows: [...rows, row("", "pass shade of mfis", null, 1.08, 0.01, 0.02, "slower")] });
  const names = async () => (await chart(p)).map((r) => r[2]).sort();
  const all = await names();
  assert.ok(all.includes("pass shade of mfis"));
  await p.getByLabel("mfis", { exact: true }).uncheck();
  assert.deepEqual(await names(), all.filter((n) => !n.includes("mfis")));
  assert.ok((await names()).includes("pass shade"));
  assert.equal(await p.locator("section.table tbody tr").count(), all.length - 3);
  await p.getByRole("button", { name: "Only fis", exact: true }).click();
  assert.deepEqual(await names(), ["cornell/fis · method", "pass shade"]);
  await p.reload();
  await p.waitForSelector(".ratios");
  assert.deepEqual(await names(), ["cornell/fis · method", "pass shade"]);
});

test("of two real reports every row knows its method", async () => {
  const now = report("pair");
  const { comparison } = digestOf("pair");
  assert.ok(comparison.rows.length > 20);
  for (const r of comparison.rows) {
    const wanted = r.case === "" ? (/ of (.*)$/.exec(r.what)?.[1] ?? "") : now.cases.find((c) => c.id === r.case).method;
    assert.equal(r.method, wanted, `${r.case} ${r.what}`);
  }
});

test("a refusal says why, and no figures follow", async () => {
  const p = await page({}, { refusal: "the devices differ: 'a' and 'b'", exit_code: 5, rows: [], summary: "not compared" });
  assert.match(await p.locator(".verdict").innerText(), /exit code 5: refused\s+Not compared: the devices differ: 'a' and 'b'/);
  assert.equal(await p.locator(".ratios").count(), 0);
  await assertSound(p);
});

test("narrow, a row's figures and change are seen whole, and the axis stands over its marks", async () => {
  const p = await page({ width: 400 });
  const inside = await p.locator(".ratios").evaluate((e) => e.scrollWidth <= e.clientWidth);
  assert.ok(inside, "the rows are wider than their frame");
  const middle = (selector) => p.locator(selector).first().evaluate((e) => { const b = e.getBoundingClientRect(); return (b.left + b.right) / 2; });
  const zero = await p.locator(".ratios thead text", { hasText: /^0 %$/ }).evaluate((e) => { const b = e.getBoundingClientRect(); return (b.left + b.right) / 2; });
  const rule = await middle(".ratios tbody .rule");
  assert.ok(Math.abs(zero - rule) < 1.5, `${zero}: ${rule}`);
});

test("dark and narrow are sound", async () => {
  await assertSound(await page({ dark: true, width: 400 }));
});
