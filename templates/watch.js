// Loads the report anew when the notes have changed, and leaves the reader where they were.
"use strict";

const status = document.getElementById("status");
const frame = document.getElementById("report");

// By ids, as the page around them grows and shrinks: details by the equation they are of, controls by what they filter.
const details = (page) => {
  const seen = new Map();
  return Array.from(page.document.querySelectorAll("details"), (element) => {
    const of = element.closest("[id]")?.id ?? "";
    seen.set(of, (seen.get(of) ?? 0) + 1);
    return [`${of} ${seen.get(of)}`, element];
  });
};
const controls = (page) => Array.from(page.document.querySelectorAll("#find input, #find select"), (c) => [c.id || c.value, c]);

// Where the reader is: the equation at the top of the window, what is open, what is filtered, what has the focus.
function place(page) {
  const inWindow = (e) => e.getBoundingClientRect().bottom > 0 && e.getBoundingClientRect().top < page.innerHeight;
  const equation = page.scrollY > 0 ? Array.from(page.document.querySelectorAll(".equation[id]")).find(inWindow) : undefined;
  return {
    scroll: [page.scrollX, page.scrollY],
    equation: equation && { id: equation.id, top: equation.getBoundingClientRect().top },
    open: new Map(details(page).map(([key, d]) => [key, d.open])),
    filter: new Map(controls(page).map(([key, c]) => [key, c.type === "checkbox" ? c.checked : c.value])),
    focus: page.document.hasFocus() ? page.document.activeElement?.id : "",
  };
}

function restore(page, was) {
  for (const [key, d] of details(page)) d.open = was.open.get(key) ?? d.open;
  for (const [key, control] of controls(page)) {
    const value = was.filter.get(key);
    if (control.type === "checkbox") control.checked = value ?? false;
    else if (control.type === "search" || Array.from(control.options, (o) => o.value).includes(value)) control.value = value ?? "";
  }
  page.document.getElementById("find~text")?.dispatchEvent(new Event("input"));
  if (was.focus) page.document.getElementById(was.focus)?.focus({ preventScroll: true });
  page.scrollTo(...was.scroll);
  const equation = was.equation && page.document.getElementById(was.equation.id);
  if (equation && !equation.closest("[hidden]")) align(page, equation, was.equation.top, 10);
}

// What lies outside the window has guessed heights, which change as it comes into it: so in a few frames.
function align(page, equation, top, frames) {
  page.scrollBy(0, equation.getBoundingClientRect().top - top);
  if (frames > 0) page.requestAnimationFrame(() => align(page, equation, top, frames - 1));
}

function reload() {
  const was = place(frame.contentWindow);
  frame.addEventListener("load", () => {
    restore(frame.contentWindow, was);
    document.title = frame.contentDocument.title;
  }, { once: true });
  // Else the browser scrolls to where the old page was, and the new one may be longer above.
  frame.contentWindow.history.scrollRestoration = "manual";
  frame.contentWindow.location.reload();
}

async function follow() {
  let number = 0;
  for (;;) {
    try {
      const news = await (await fetch(`changed?after=${number}`)).json();
      status.textContent = news.status;
      status.classList.remove("lost");
      if (number !== 0 && news.number !== number) reload();
      number = news.number;
    } catch {
      status.textContent = "kenzan watch has ended; the report stays as it was";
      status.classList.add("lost");
      await new Promise((done) => setTimeout(done, 2000));
    }
  }
}

follow();
