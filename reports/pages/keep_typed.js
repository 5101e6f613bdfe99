// Keeps what is typed and ticked half a second later, so that a browser that dies loses nothing. One keep after the
// other, and before the form goes, so that no older one comes last.
"use strict";
const form = document.querySelector("form[data-keeps]");
if (form) {
  const told = document.querySelector("[data-kept]");
  let timer = 0, under_way = 0, last = Promise.resolve();
  const keep = () => {
    clearTimeout(timer);
    timer = 0;
    const body = new URLSearchParams(new FormData(form));
    body.set("go", "keep");
    ++under_way;
    last = last
      .then(() => fetch(form.getAttribute("action"), { method: "POST", body, keepalive: true, redirect: "error" }))
      .then((answer) => { told.textContent = answer.status === 204 ? told.dataset.kept : told.dataset.lost; })
      .catch(() => { told.textContent = told.dataset.lost; })
      .then(() => { --under_way; });
  };
  form.addEventListener("input", () => {
    clearTimeout(timer);
    timer = setTimeout(keep, 500);
  });
  addEventListener("pagehide", () => { if (timer) keep(); });
  form.addEventListener("submit", (event) => {
    clearTimeout(timer);
    timer = 0;
    if (!under_way) return;
    event.preventDefault();
    last.then(() => form.requestSubmit(event.submitter));
  });
}
