// No serious fault of accessibility, in any view, light and dark, wide and narrow.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { after, test } from "node:test";
import { close, open } from "./harness.mjs";

after(close);
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

for (const name of ["front", "flicker", "history", "images", "pair"]) {
  for (const [dark, width] of [[false, 1280], [true, 1280], [false, 400]]) {
    test(`${name}, ${dark ? "dark" : "light"}, ${width} px`, async () => {
      const page = await open(name, { dark, width });
      await page.evaluate(axe);
      for (const tab of await page.getByRole("tab").all()) {
        await tab.click();
        await page.waitForTimeout(200);
        const found = await page.evaluate(() => globalThis.axe.run(document, { resultTypes: ["violations"] }));
        const serious = found.violations.filter((v) => ["serious", "critical"].includes(v.impact));
        const told = serious.flatMap((v) => v.nodes.slice(0, 3).map((n) => `${v.id}: ${n.html.slice(0, 160)} ${n.failureSummary.split("\n").slice(0, 3).join(" ")}`));
        assert.deepEqual(told, [], `${name}: ${await tab.textContent()}`);
      }
    });
  }
}
