// How large and how fast large reports are. Prints figures; asserts nothing.
import { readFileSync, statSync } from "node:fs";
import path from "node:path";
import { gzipSync } from "node:zlib";
import { pathToFileURL } from "node:url";
import { browser, pages } from "./browser.mjs";

const RUNS = 7;
const middle = (values) => values.sort((a, b) => a - b)[Math.floor(values.length / 2)];

for (const equations of [200, 2000]) {
  for (const suffix of ["", "-errata", "-map"]) {
    const file = path.join(pages, `load-${equations}`, `notes-${equations}${suffix}.html`);
    const parsed = [], painted = [], loaded = [], filtered = [], searched = [];
    for (let run = 0; run < RUNS; run += 1) {
      const context = await browser.newContext({ viewport: { width: 1280, height: 900 } });
      const page = await context.newPage();
      await page.goto(pathToFileURL(file).href);
      await page.waitForFunction(() => performance.getEntriesByName("first-contentful-paint").length > 0);
      const times = await page.evaluate(() => {
        const [navigation] = performance.getEntriesByType("navigation");
        const [paint] = performance.getEntriesByName("first-contentful-paint");
        return [navigation.domContentLoadedEventEnd, paint.startTime, navigation.loadEventEnd];
      });
      [parsed, painted, loaded].forEach((list, k) => list.push(times[k]));
      if (suffix === "") {
        // From the event to the next picture, layout included.
        const timed = (act) => page.evaluate(async (act) => {
          const begin = performance.now();
          const [box, text] = [document.querySelector("#find input[value=fails]"), document.getElementById("find~text")];
          if (act === "click") box.click();
          else { text.value = "\\sin"; text.dispatchEvent(new Event("input")); }
          await new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
          return performance.now() - begin;
        }, act);
        filtered.push(await timed("click"));
        await page.evaluate(() => document.getElementById("find~all").click());
        searched.push(await timed("search"));
      }
      await context.close();
    }
    const text = readFileSync(file);
    const size = (bytes) => `${(bytes / 1e6).toFixed(2)} MB`;
    const ms = (list) => `${middle(list).toFixed(0)} ms`;
    const acts = suffix === "" ? `, filter ${ms(filtered)}, first search ${ms(searched)}` : "";
    console.log(`${equations} equations${suffix}: ${size(statSync(file).size)} (gzip ${size(gzipSync(text).length)}), DOMContentLoaded ${ms(parsed)}, first contentful paint ${ms(painted)}, load ${ms(loaded)}${acts}; medians of ${RUNS}`);
  }
}
await browser.close();
