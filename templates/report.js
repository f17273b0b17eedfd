"use strict";
// Filtering, searching and copying. The page is whole without this script.
(() => {
  const page = document.documentElement;
  const byId = (id) => document.getElementById(id);
  const [text, section, status, all] = ["text", "section", "status", "all"].map((name) => byId("find~" + name));
  const boxes = [...document.querySelectorAll("#find input[type=checkbox]")];
  const sections = [...document.querySelectorAll("main > .section")];
  const equations = [...document.querySelectorAll(".equation")];
  page.classList.add("with-script");

  const plain = (latex) => latex.toLowerCase().replace(/\s+/g, "");
  // Made at the first search: the labels and all LaTeX of each equation.
  let texts;
  const known = () => texts ??= new Map(equations.map((equation) => {
    const sources = [...equation.querySelectorAll("code")].map((code) => code.textContent);
    return [equation, [equation.querySelector("h3").textContent, ...sources].map(plain)];
  }));
  // How an equation is asked for: by its label alone, `(52)`, where there is one of that label; else by what it contains.
  const search = (wanted) => {
    if (wanted === "") return () => true;
    const labels = equations.filter((equation) => known().get(equation)[0] === wanted);
    if (labels.length > 0) return (equation) => labels.includes(equation);
    return (equation) => known().get(equation).some((source) => source.includes(wanted));
  };

  function filter() {
    const wanted = plain(text.value);
    const verdicts = boxes.filter((box) => box.checked).map((box) => box.value);
    const filtering = wanted !== "" || verdicts.length > 0 || section.value !== "";
    const found = search(wanted);
    let shown = 0;
    for (const part of sections) {
      let any = false;
      for (const equation of part.querySelectorAll(".equation")) {
        const keep = (section.value === "" || part.id === section.value)
          && (verdicts.length === 0 || verdicts.some((verdict) => equation.classList.contains(verdict)))
          && found(equation);
        equation.hidden = !keep;
        any ||= keep;
        shown += keep ? 1 : 0;
      }
      part.hidden = filtering && !any;
    }
    for (const part of document.querySelectorAll(".overview")) part.hidden = filtering;
    all.hidden = !filtering;
    status.textContent = filtering ? status.dataset.text.replace("{n}", shown).replace("{m}", equations.length) : "";
  }

  function showAll() {
    text.value = section.value = "";
    for (const box of boxes) box.checked = false;
    filter();
  }

  // A link may lead to what is hidden at the moment.
  function reveal() {
    let id = location.hash.slice(1);
    try { id = decodeURIComponent(id); } catch { /* as it is */ }
    const target = id && byId(id);
    if (target && target.closest("[hidden]")) {
      showAll();
      target.scrollIntoView();
    }
  }

  async function copy(button) {
    const code = button.closest(".latex").querySelector("code");
    const said = button.textContent;
    let done = true;
    try {
      await navigator.clipboard.writeText(code.textContent);
    } catch {
      // Without leave to use the clipboard: as a person would, by selecting.
      code.closest("details").open = true;
      getSelection().selectAllChildren(code);
      done = document.execCommand("copy");
    }
    button.textContent = done ? status.dataset.copied : status.dataset.failed;
    setTimeout(() => { button.textContent = said; }, 2000);
  }

  text.addEventListener("input", filter);
  section.addEventListener("change", filter);
  for (const box of boxes) box.addEventListener("change", filter);
  all.addEventListener("click", () => { showAll(); text.focus(); });
  addEventListener("hashchange", reveal);
  document.addEventListener("click", (event) => {
    const link = event.target.closest("a[href^='#']");
    const button = event.target.closest(".copy");
    if (button) copy(button);
    // The same link again changes no hash.
    else if (link && link.hash === location.hash) reveal();
  });
  // What a browser has kept of the form from before.
  filter();
  reveal();
})();
