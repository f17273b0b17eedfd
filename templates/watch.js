// Loads the report anew when the notes have changed, and leaves the reader where they were.
"use strict";

const status = document.getElementById("status");
const frame = document.getElementById("report");

function reload() {
  const page = frame.contentWindow;
  const [x, y] = [page.scrollX, page.scrollY];
  const open = Array.from(page.document.querySelectorAll("details"), (d) => d.open);
  frame.addEventListener("load", () => {
    const all = frame.contentDocument.querySelectorAll("details");
    if (all.length === open.length) all.forEach((d, k) => { d.open = open[k]; });
    frame.contentWindow.scrollTo(x, y);
    document.title = frame.contentDocument.title;
  }, { once: true });
  page.location.reload();
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
