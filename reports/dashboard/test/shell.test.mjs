// Every view of every page: no error, nothing leaves the page; light, dark and keys.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, open, report, saved } from "./harness.mjs";

after(close);
const names = ["front", "flicker", "generation", "history", "images", "pair"];

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

test("a view that the page has not is said to be missing", async () => {
  const page = await open("front", { hash: "v=fornt" });
  assert.match(await page.locator("[role=status].warning").textContent(), /There is no view “fornt”: “Error against time” is shown instead/);
  await page.getByRole("tab", { name: "Passes" }).click();
  assert.equal(await page.locator("[role=status].warning").count(), 0);
  const without = await open("front", { hash: "v=flicker" });
  assert.match(await without.locator("[role=status].warning").textContent(), /nothing for the view “Flicker”/);
});

test("a head has no unit where every cell has its own, and the CSV has it", async () => {
  const page = await open("front", { hash: "v=cases" });
  assert.deepEqual((await page.locator("#view thead button").allTextContents()).filter((t) => t.startsWith("memory")), ["memory bytes"]);
  const rows = await saved(page, "All cases");
  assert.equal(Number(rows[0]["memory bytes (B)"]), report("front").cases[0].generate.memory_bytes);
});

test("choosing a row keeps focus and the rows that were asked for", async () => {
  const page = await open("front", { hash: "v=cases" });
  await page.getByRole("button", { name: /^Next / }).click();
  const rows = page.locator("#view tbody tr");
  const count = await rows.count();
  assert.ok(count > 200);
  const button = rows.nth(250).locator("button.row");
  await button.focus();
  await page.keyboard.press("Enter");
  assert.equal(await rows.count(), count);
  assert.equal(await button.evaluate((e) => e === document.activeElement), true);
  assert.equal(await button.getAttribute("aria-pressed"), "true");
  assert.match(page.url(), /[#&]c=250(&|$)/);
  await page.keyboard.press("Enter");
  assert.equal(await button.getAttribute("aria-pressed"), "false");
  assert.doesNotMatch(page.url(), /[#&]c=/);
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
