// The report's pages as people use them.
import { readFileSync, writeFileSync, mkdirSync } from "node:fs";
import path from "node:path";
import { assert, axe, data, equal, finish, pages, test } from "./browser.mjs";

const gyroscope = data("en").documents[0];
const count = (verdict) => gyroscope.equations.filter((e) => e.verdict === verdict).length;
const shown = (page) => page.locator(".equation:visible").count();
const status = (page) => page.getByRole("status").textContent();

// Filtering

await test("one verdict is filtered by a click, and all are shown again", "en/gyroscope.html", async (page) => {
  equal(await shown(page), gyroscope.equations.length, "equations at first");
  await page.getByRole("checkbox", { name: "fails" }).click();
  equal(await shown(page), count("fails"), "failing equations");
  equal(await page.locator(".equation:visible:not(.fails)").count(), 0, "others");
  equal(await status(page), `${count("fails")} of ${gyroscope.equations.length} equations shown`, "status");
  assert(!(await page.locator("#summary").isVisible()), "the overview gives way to what was found");
  equal(await page.locator("main > .section:visible").filter({ hasNot: page.locator(".equation:visible") }).count(), 0, "empty sections");
  await page.getByRole("checkbox", { name: "definition" }).click();
  equal(await shown(page), count("fails") + count("definition"), "two verdicts");
  await page.getByRole("button", { name: "Show all" }).click();
  equal(await shown(page), gyroscope.equations.length, "all again");
  equal(await status(page), "", "status");
  equal(await page.evaluate(() => document.activeElement.id), "find~text", "the focus stays in the form");
});

await test("a section is filtered", "en/gyroscope.html", async (page) => {
  const section = gyroscope.equations[20].section;
  await page.getByLabel("Section").selectOption({ label: section });
  equal(await shown(page), gyroscope.equations.filter((e) => e.section === section).length, section);
  equal(await page.locator("main > .section:visible").count(), 1, "sections");
});

await test("a label and LaTeX are searched", "ja/gyroscope.html", async (page) => {
  const search = page.getByRole("searchbox");
  await search.fill("(56)");
  equal(await shown(page), 1, "label");
  equal(await page.locator(".equation:visible h3").textContent(), "(56)", "label");
  await search.fill("I_0\\sin^3");
  const found = await page.locator(".equation:visible").evaluateAll((all) => all.map((e) => e.querySelectorAll("code").length > 0
    && [...e.querySelectorAll("code")].some((code) => code.textContent.replace(/\s/g, "").includes("I_0\\sin^3"))));
  assert(found.length > 0 && found.every(Boolean), `LaTeX: ${found}`);
  await search.fill("no such thing");
  equal(await shown(page), 0, "nothing");
  equal(await status(page), `${gyroscope.equations.length} 個の式のうち 0 個を表示`, "status");
});

await test("search, verdict and section are filtered together", "en/gyroscope.html", async (page) => {
  await page.getByRole("searchbox").fill("\\theta");
  await page.getByRole("checkbox", { name: "fails" }).check();
  const both = await shown(page);
  assert(both > 0 && both < count("fails"), `${both} of ${count("fails")}`);
});

await test("a link to what is hidden shows it", "en/gyroscope.html", async (page) => {
  await page.getByRole("checkbox", { name: "definition" }).check();
  const cell = page.locator(".cell.holds").first();
  const id = (await cell.getAttribute("href")).slice(1);
  assert(!(await page.locator(`[id="${id}"]`).isVisible()), "hidden at first");
  await cell.click();
  await page.locator(`[id="${id}"]`).waitFor({ state: "visible" });
  assert(await page.locator(`[id="${id}"]`).evaluate((e) => e.getBoundingClientRect().top < innerHeight), "in view");
});

// Copying

for (const [language, button] of [["en", "Copy the corrected LaTeX"], ["ja", "訂正後の LaTeX をコピー"]]) {
  await test(`the corrected LaTeX is copied (${language})`, `${language}/gyroscope.html`, async (page, context) => {
    await context.grantPermissions(["clipboard-read", "clipboard-write"]);
    const wanted = gyroscope.equations.find((e) => e.label === "56").correction.latex;
    await page.locator("#gyroscope-56").getByRole("button", { name: button }).click();
    await page.getByRole("button", { name: language === "en" ? "Copied" : "コピーしました" }).waitFor();
    equal(await page.evaluate(() => navigator.clipboard.readText()), wanted, "clipboard");
    await page.locator("#gyroscope-56").getByRole("button", { name: button }).waitFor();
  });
}

await test("without leave for the clipboard it is copied by selecting", "en/gyroscope.html", async (page) => {
  await page.evaluate(() => { navigator.clipboard.writeText = () => Promise.reject(new Error("no leave")); });
  await page.locator("#gyroscope-56").getByRole("button", { name: "Copy the corrected LaTeX" }).click();
  const wanted = gyroscope.equations.find((e) => e.label === "56").correction.latex;
  await page.waitForFunction((text) => String(getSelection()).trim() === text.trim(), wanted);
});

// Without a script

await test("everything is readable without the script", "en/gyroscope.html", async (page) => {
  equal(await shown(page), gyroscope.equations.length, "equations");
  equal(await page.locator(".scripted:visible").count(), 0, "controls that need the script");
  const summary = page.locator("#gyroscope-56 summary").first();
  await summary.click();
  assert(await page.locator("#gyroscope-56 code").first().isVisible(), "details open without it");
  for (const part of ["#summary", "#errata", "#legend"]) assert(await page.locator(part).isVisible(), part);
}, { javaScriptEnabled: false });

// Keyboard

await test("the keyboard reaches everything, and one sees where one is", "en/gyroscope.html", async (page) => {
  await page.keyboard.press("Tab");
  equal(await page.evaluate(() => document.activeElement.className), "skip", "first the skip link");
  assert(await page.locator(".skip").evaluate((e) => e.getBoundingClientRect().left >= 0), "which is seen");
  await page.keyboard.press("Enter");
  equal(await page.evaluate(() => location.hash), "#main", "and leads to the report");
  await page.reload();
  await page.evaluate(() => { history.replaceState(null, "", location.pathname); scrollTo(0, 0); });
  await page.reload();
  const seen = new Set();
  for (let step = 0; step < 60; step += 1) {
    await page.keyboard.press("Tab");
    const at = await page.evaluate(() => {
      const e = document.activeElement;
      const style = getComputedStyle(e);
      const box = e.getBoundingClientRect();
      return {
        key: e.id || e.getAttribute("href") || e.value || e.textContent,
        outlined: style.outlineStyle !== "none" && parseFloat(style.outlineWidth) >= 1,
        inside: box.bottom > 0 && box.top < innerHeight && box.width > 0,
      };
    });
    assert(at.outlined, `no outline on ${at.key}`);
    assert(at.inside, `${at.key} is out of sight`);
    seen.add(at.key);
  }
  assert(seen.size >= 55, `${seen.size} places in 60 steps`);
  for (const wanted of ["find~text", "find~section", "fails"]) assert(seen.has(wanted), `${wanted} is not reached`);
});

await test("filtering by keyboard alone", "ja/gyroscope.html", async (page) => {
  await page.locator("#find\\~text").focus();
  await page.keyboard.type("(57)");
  equal(await shown(page), 1, "typed");
  await page.keyboard.press("Control+A");
  await page.keyboard.press("Delete");
  await page.locator("#find input[value=fails]").focus();
  await page.keyboard.press("Space");
  equal(await shown(page), count("fails"), "space on a verdict");
});

// The map

await test("the map shows every link, and its nodes lead to the equations", "en/gyroscope-map.html", async (page) => {
  const labels = new Set(gyroscope.equations.map((e) => e.label));
  const edges = gyroscope.equations.flatMap((e) => e.given.filter((g) => labels.has(g) && g !== e.label));
  equal(await page.locator(".derivation:not(.whole) .edge.tip").count(), edges.length, "arrows");
  const linked = new Set(gyroscope.equations.flatMap((e) => [e.label, ...e.given].filter(() => e.given.some((g) => labels.has(g)))));
  equal(await page.locator(".node:not(.foreign)").count(), [...linked].filter((l) => labels.has(l)).length, "nodes");
  equal(await page.locator(".figure[id] tbody tr").count(), await page.locator(".node:not(.foreign)").count(), "rows of the tables");
  const failing = await page.locator(".node.fails:not(.foreign)").count();
  assert(failing > 5 && await page.locator(".node.endangered").count() > 5, "failing and endangered ones");
  const tight = await page.locator(".node").evaluateAll((all) => all.filter((node) => {
    const [box, text] = ["rect", "text"].map((name) => node.querySelector(name).getBBox());
    return text.width > box.width - 4 || text.x < box.x;
  }).map((node) => node.textContent));
  equal(tight, [], "labels that do not fit");
  const node = page.locator(".node.fails").first();
  await node.focus();
  const label = await node.getAttribute("aria-label");
  assert(/^\(.+\) fails/.test(label), label);
  await page.keyboard.press("Enter");
  await page.waitForURL(/gyroscope\.html#/);
  assert(await page.locator(".equation:target").evaluate((e) => e.classList.contains("fails")), "leads to a failing equation");
});

await test("the overview has each section, what rests on it, and leads to its map", "en/gyroscope-map.html", async (page) => {
  const sections = [...new Set(gyroscope.equations.map((e) => e.section))];
  equal(await page.locator(".whole .title").allTextContents(), sections, "rows");
  const section = new Map(gyroscope.equations.map((e) => [e.label, e.section]));
  const pairs = gyroscope.equations.flatMap((e) => e.given.filter((g) => section.has(g) && section.get(g) !== e.section)
    .map((g) => `${section.get(g)} > ${e.section}`));
  equal(await page.locator(".whole .edge.tip").count(), new Set(pairs).size, "arcs");
  const failing = gyroscope.equations.filter((e) => e.section === sections[0] && e.verdict === "fails").length;
  equal(await page.locator(".whole .failing").first().textContent(), `✗ ${failing}`, "failing ones");
  const out = await page.locator(".whole").evaluate((svg) => [...svg.querySelectorAll("text, path")].filter((e) => {
    const [box, own] = [svg.getBoundingClientRect(), e.getBoundingClientRect()];
    return own.left < box.left || own.right > box.right;
  }).length);
  equal(out, 0, "parts that stick out");
  const row = page.locator(".whole .row").nth(5);
  await row.focus();
  assert((await row.getAttribute("aria-label")).startsWith(`${sections[5]}: `), "what a row says");
  await page.keyboard.press("Enter");
  await page.waitForURL(/#/);
  equal(await page.locator(".figure:target h2").textContent(), sections[5], "leads to the section's map");
});

await test("formulas have their source as alternative text", "ja/gyroscope.html", async (page) => {
  const bare = await page.locator("math").evaluateAll((all) => all.filter((math) => math.textContent !== "" && !math.getAttribute("alttext")).length);
  equal(bare, 0, "formulas without");
  equal(await page.locator("math[alttext*=c0ffee]").count(), 0, "marks in the sources");
});

await test("the map of 566 equations stays legible", "en/celestial-mechanics-3-map.html", async (page) => {
  const sizes = await page.locator("svg.derivation").evaluateAll((all) => all.map((svg) => {
    const text = svg.querySelector("text").getBoundingClientRect();
    return { width: svg.getBoundingClientRect().width, letter: text.height };
  }));
  assert(sizes.every((s) => s.letter >= 12), "letters of 12 pixels at least");
  const wide = sizes.filter((s) => s.width > 2400).length;
  equal(wide, 0, `drawings wider than 2400 pixels; the widest is ${Math.max(...sizes.map((s) => s.width))}`);
});

// Print

const paper = async (page, file) => {
  const pdf = await page.pdf({ preferCSSPageSize: true, printBackground: true });
  mkdirSync(path.join(pages, "shown"), { recursive: true });
  writeFileSync(path.join(pages, "shown", file), pdf);
  const text = pdf.toString("latin1");
  const boxes = [...text.matchAll(/\/MediaBox\s*\[\s*([\d. ]+?)\s*\]/g)].map((m) => m[1].split(/\s+/).map(Number));
  return { boxes, sheets: (text.match(/\/Type\s*\/Page\b(?!s)/g) ?? []).length };
};

for (const language of ["en", "ja"]) {
  await test(`the errata sheet prints on A4, entries unbroken (${language})`, `${language}/gyroscope-errata.html`, async (page) => {
    const errata = gyroscope.equations.filter((e) => e.verdict === "fails");
    equal(await page.locator(".entry").count(), errata.length, "entries");
    const { boxes, sheets } = await paper(page, `errata-${language}.pdf`);
    assert(sheets >= 4 && sheets <= errata.length, `${sheets} sheets for ${errata.length} entries`);
    assert(boxes.length > 0 && boxes.every(([, , w, h]) => Math.abs(w - 595) < 2 && Math.abs(h - 842) < 2), `A4: ${boxes[0]}`);
    await page.emulateMedia({ media: "print" });
    await page.setViewportSize({ width: 672, height: 979 });
    const entries = await page.locator(".entry").evaluateAll((all) => all.map((e) => [getComputedStyle(e).breakInside, e.offsetHeight]));
    assert(entries.every(([rule]) => rule === "avoid"), "no break within an entry");
    assert(entries.every(([, height]) => height < 979), `each fits a page: ${Math.max(...entries.map((e) => e[1]))} pixels`);
    const wide = await page.locator(".entry .formula").evaluateAll((all) => all.filter((e) => e.scrollWidth > e.clientWidth + 1).length);
    equal(wide, 0, "formulas wider than the page");
    // What differs does not depend on colour.
    const marks = await page.locator(".entry .changed").evaluateAll((all) => all.map((e) => getComputedStyle(e).outlineStyle));
    assert(marks.length > 20 && marks.every((style) => style === "dashed" || style === "solid"), "marks with outlines");
    assert(await page.locator(".entry del").count() > 5 && await page.locator(".entry ins").count() > 5, "changes in the LaTeX");
  });
}

await test("the report prints without its controls", "en/gyroscope.html", async (page) => {
  const { sheets } = await paper(page, "report.pdf");
  await page.emulateMedia({ media: "print" });
  equal(await page.locator(".scripted:visible, .aside:visible").count(), 0, "controls");
  assert(sheets > 5, `${sheets} sheets`);
});

// Every kind of page

const kinds = ["report.html", "gyroscope.html", "gyroscope-errata.html", "gyroscope-map.html", "unannotated.html",
  "unannotated-errata.html", "unannotated-map.html", "speed.html", "stability.html"];
for (const language of ["en", "ja"]) {
  for (const scheme of ["light", "dark"]) {
    for (const kind of kinds) {
      await test(`axe: ${kind}, ${language}, ${scheme}`, `${language}/${kind}`, async (page) => {
        equal(await page.locator("html").getAttribute("lang"), language, "lang");
        await page.evaluate(() => { for (const d of document.querySelectorAll("details")) d.open = true; });
        const ground = await page.evaluate(() => getComputedStyle(document.body).backgroundColor.match(/\d+/g).map(Number)[0]);
        assert(scheme === "dark" ? ground < 60 : ground > 200, `the ground is ${ground}`);
        await page.evaluate(axe);
        const found = await page.evaluate(() => axe.run(document, { resultTypes: ["violations"] }));
        const violations = found.violations.map((v) => `${v.id} (${v.nodes.length}): ${v.nodes[0].html.slice(0, 160)} ${v.nodes[0].failureSummary}`);
        equal(violations, [], "violations");
      }, { colorScheme: scheme });
    }
  }
}

for (const kind of kinds) {
  await test(`on a narrow screen nothing sticks out: ${kind}`, `ja/${kind}`, async (page) => {
    const [page_, screen] = await page.evaluate(() => [document.scrollingElement.scrollWidth, innerWidth]);
    assert(page_ <= screen, `${page_} pixels on ${screen}`);
  }, { viewport: { width: 360, height: 740 } });
}

await test("with one document report.html is its page", "en-alone/report.html", async (page) => {
  equal(await page.locator(".equation").count(), 6, "equations");
  equal(await page.getByRole("heading", { level: 1 }).textContent(), "A pendulum, nothing declared", "title");
  equal(readFileSync(path.join(pages, "en-alone/report.html"), "utf8"), readFileSync(path.join(pages, "en-alone/unannotated.html"), "utf8"), "the same page");
});

await test("the index leads to every page and back", "en/report.html", async (page) => {
  equal(await page.locator(".documents tbody tr").count(), 3, "rows");
  await page.getByRole("link", { name: "Precession and nutation" }).click();
  await page.waitForURL(/gyroscope\.html$/);
  await page.getByRole("link", { name: "Errata sheet" }).click();
  await page.waitForURL(/gyroscope-errata\.html$/);
  await page.getByRole("link", { name: "(56)", exact: true }).click();
  await page.waitForURL(/gyroscope\.html#gyroscope-56$/);
  await page.getByRole("link", { name: "All documents" }).click();
  await page.waitForURL(/report\.html$/);
});

await test("what was assumed and suspected is shown", "en/unannotated.html", async (page) => {
  await page.locator("details.assumed summary").click();
  assert(await page.locator("details.assumed tbody tr").count() >= 3, "assumed symbols");
  assert(await page.locator(".suspect .formula").count() >= 1, "suspects");
  assert((await page.locator("#unannotated-3 .premises").textContent()).includes("premises found by Kenzan"), "premises");
});

await finish();
