// A film of pictures that stand in the page: played at the pace at which it was, paused, or led by the slider.
"use strict";
for (const film of document.querySelectorAll("[data-film]")) {
  const frames = [...film.querySelectorAll("[data-t]")];
  const times = frames.map((frame) => Number(frame.dataset.t));
  const play = film.querySelector("[data-play]"), slider = film.querySelector("[data-moment]");
  const pace = film.querySelector("[data-pace]"), told = film.querySelector("[data-told]");
  const last = times.length - 1;
  let shown = 0, at = times[0], before = null;
  const show = (next) => {
    frames[shown].classList.remove("shown");
    shown = next;
    frames[shown].classList.add("shown");
    slider.value = shown;
    slider.setAttribute("aria-valuetext", times[shown].toFixed(1) + " s");
    told.textContent = times[shown].toFixed(1) + " of " + times[last].toFixed(1) + " s";
  };
  const pause = () => {
    before = null;
    play.textContent = "Play";
  };
  const step = (now) => {
    if (before === null) return;
    at += ((now - before) / 1000) * Number(pace.value);
    before = now;
    let next = shown;
    while (next < last && times[next + 1] <= at) ++next;
    if (next !== shown) show(next);
    if (shown === last) pause();
    else requestAnimationFrame(step);
  };
  play.addEventListener("click", () => {
    if (before !== null) return pause();
    if (shown === last) show(0);
    at = times[shown];
    before = performance.now();
    play.textContent = "Pause";
    requestAnimationFrame(step);
  });
  slider.addEventListener("input", () => {
    show(Number(slider.value));
    at = times[shown];
  });
  show(0);
  film.hidden = false;
}
