// An attempt in three dimensions: needle, probe, target and skin as they were recorded, to be turned, played and
// searched; what mentors said stands beneath at its moment.
// Drawn with lines on a canvas: an orthographic view needs no library. Without this script the page has the same
// course as a chart and a table.
"use strict";
const root = document.querySelector("[data-replay]");
if (root) fetch(root.dataset.replay).then((answer) => (answer.ok ? answer.json() : Promise.reject())).then(show).catch(() => {
  root.hidden = true;
});

function show(replay) {
  const canvas = root.querySelector("canvas"), slider = root.querySelector("input[type=range]");
  const told = root.querySelector("[data-told]"), play = root.querySelector("[data-play]");
  const speed = root.querySelector("select");
  const views = { front: [0, 0], side: [90, 0], slice: [0, -90] };
  let yaw = -35, pitch = 20, zoom = 1, index = 0, playing = false, last = 0;
  const times = replay.t_s, count = times.length, target = replay.target.center_mm;
  const comments = [...document.querySelectorAll(".comments [data-at-s]")].map((moment) => ({
    at: Number(moment.dataset.atS), words: moment.nextElementSibling.firstChild.textContent.trim(),
    author: moment.nextElementSibling.querySelector("bdi").textContent }));
  const said = root.querySelector("[data-said]"), field = document.getElementById("at");
  let typed = false, net = null;
  root.hidden = false;
  slider.max = count - 1;

  const add = (a, b, f) => [a[0] + f * b[0], a[1] + f * b[1], a[2] + f * b[2]];
  const gap = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  // Large enough for the picture and for most of the path; the way to the skin may begin beyond the edge.
  const gaps = replay.tip_mm.map((tip) => gap(tip, target)).sort((a, b) => a - b);
  const reach = Math.max(30, replay.target.radius_mm * 2, gaps[Math.floor(gaps.length * 0.6)], (replay.picture_mm || [0, 0])[1] * 0.7) * 1.1;

  // LPS to the page: x to the right, y down, as somebody sees it who stands before the patient.
  const project = (point) => {
    const turn = (yaw * Math.PI) / 180, tilt = (pitch * Math.PI) / 180;
    const [x, y, z] = [point[0] - target[0], point[1] - target[1], point[2] - target[2]];
    const right = x * Math.cos(turn) + y * Math.sin(turn);
    const away = y * Math.cos(turn) - x * Math.sin(turn);
    const up = z * Math.cos(tilt) + away * Math.sin(tilt);
    const scale = (zoom * Math.min(canvas.width, canvas.height)) / (2 * reach);
    return [canvas.width / 2 + right * scale, canvas.height / 2 - up * scale, scale];
  };
  const colour = (name) => getComputedStyle(root).getPropertyValue(name).trim();
  const clock = (t) => Math.floor(t / 60) + ":" + String(Math.floor(t % 60)).padStart(2, "0");

  function line(pen, points, stroke, width, dash) {
    pen.beginPath();
    points.forEach((point, i) => {
      const [x, y] = project(point);
      if (i === 0) pen.moveTo(x, y);
      else pen.lineTo(x, y);
    });
    pen.strokeStyle = stroke;
    pen.lineWidth = width * devicePixelRatio;
    pen.setLineDash((dash || []).map((one) => one * devicePixelRatio));
    pen.stroke();
  }
  // The skin as a net, its outline from here more strongly: there one side of an edge faces us and the other does not.
  function skin(pen) {
    if (!net) return;
    const points = net.vertices.map(project);
    const faces = net.triangles.map(([a, b, c]) => (points[b][0] - points[a][0]) * (points[c][1] - points[a][1]) -
      (points[b][1] - points[a][1]) * (points[c][0] - points[a][0]) > 0);
    pen.setLineDash([]);
    pen.strokeStyle = colour("--skin");
    pen.lineWidth = devicePixelRatio;
    for (const outline of [false, true]) {
      pen.globalAlpha = outline ? 0.8 : 0.18;
      pen.beginPath();
      for (const [a, b, one, other] of net.edges) {
        if ((other === undefined || faces[one] !== faces[other]) !== outline) continue;
        pen.moveTo(points[a][0], points[a][1]);
        pen.lineTo(points[b][0], points[b][1]);
      }
      pen.stroke();
    }
    pen.globalAlpha = 1;
  }
  // Which way is right, front and head, in the corner.
  function compass(pen) {
    const centre = project(target), unit = 26 * devicePixelRatio, at = [2 * unit, canvas.height - 2 * unit];
    pen.fillStyle = pen.strokeStyle = colour("--soft");
    pen.font = 13 * devicePixelRatio + "px sans-serif";
    pen.textAlign = "center";
    pen.textBaseline = "middle";
    pen.lineWidth = devicePixelRatio;
    pen.setLineDash([]);
    for (const [way, text] of [[[-1, 0, 0], "R"], [[0, -1, 0], "A"], [[0, 0, 1], "H"]]) {
      const end = project(add(target, way, 1)), to = [(end[0] - centre[0]) / centre[2], (end[1] - centre[1]) / centre[2]];
      pen.beginPath();
      pen.moveTo(at[0], at[1]);
      pen.lineTo(at[0] + to[0] * unit, at[1] + to[1] * unit);
      pen.stroke();
      pen.fillText(text, at[0] + to[0] * unit * 1.4, at[1] + to[1] * unit * 1.4);
    }
  }

  function draw() {
    const box = canvas.getBoundingClientRect();
    canvas.width = Math.round(box.width * devicePixelRatio);
    canvas.height = Math.round(box.height * devicePixelRatio);
    const pen = canvas.getContext("2d");
    pen.clearRect(0, 0, canvas.width, canvas.height);
    skin(pen);
    compass(pen);
    const [x, y, scale] = project(target);
    pen.beginPath();
    pen.arc(x, y, Math.max(2, replay.target.radius_mm * scale), 0, 2 * Math.PI);
    pen.fillStyle = colour("--good");
    pen.globalAlpha = 0.35;
    pen.fill();
    pen.globalAlpha = 1;
    pen.strokeStyle = colour("--good");
    pen.setLineDash([]);
    pen.stroke();

    // The path so far: where the picture showed the tip, and where it did not.
    for (let from = 0; from < index; ) {
      const seen = replay.tip_seen[from];
      let to = from + 1;
      while (to < index && replay.tip_seen[to] === seen) ++to;
      line(pen, replay.tip_mm.slice(from, to + 1), colour(seen ? "--seen" : "--soft"), seen ? 2.5 : 1.2, seen ? [] : [4, 3]);
      from = to;
    }
    const tip = replay.tip_mm[index], way = replay.needle_direction[index];
    line(pen, [tip, add(tip, way, -replay.needle_mm)], colour("--text"), 2);
    const probe = replay.probe_mm[index], lateral = replay.probe_lateral[index], axial = replay.probe_axial[index];
    if (replay.picture_mm) {
      const [wide, deep] = replay.picture_mm;
      const left = add(probe, lateral, -wide / 2), right = add(probe, lateral, wide / 2);
      line(pen, [left, right, add(right, axial, deep), add(left, axial, deep), left], colour("--accent"), 1);
      line(pen, [left, right], colour("--accent"), 4);
    }
    const words = "At " + clock(times[index]) + " the tip is " + gap(tip, target).toFixed(1) + " mm from the target’s centre, " +
      (replay.tip_seen[index] ? "in the picture." : "not in the picture.");
    told.textContent = words;
    slider.value = index;
    slider.setAttribute("aria-valuetext", words);
    // A comment stays for six seconds, or until the next.
    const now = comments.filter((one) => one.at <= times[index] + 0.05 && times[index] < one.at + 6).pop();
    const saying = now ? now.author + ": “" + now.words + "”" : "";
    if (said.textContent !== saying) said.textContent = saying;
    if (field && !typed) field.value = times[index].toFixed(1);
  }
  function step(now) {
    if (!playing) return;
    const passed = ((now - last) / 1000) * Number(speed.value);
    const at = times[index] + passed;
    let next = index;
    while (next < count - 1 && times[next + 1] <= at) ++next;
    if (next !== index) {
      index = next;
      last = now;
      draw();
    }
    if (index === count - 1) pause();
    else requestAnimationFrame(step);
  }
  function pause() {
    playing = false;
    play.textContent = "Play";
  }
  play.addEventListener("click", () => {
    if (playing) return pause();
    if (index === count - 1) index = 0;
    playing = true;
    play.textContent = "Pause";
    last = performance.now();
    requestAnimationFrame(step);
  });
  slider.addEventListener("input", () => {
    index = Number(slider.value);
    last = performance.now();
    draw();
  });
  for (const button of root.querySelectorAll("[data-view]"))
    button.addEventListener("click", () => {
      [yaw, pitch] = views[button.dataset.view];
      draw();
    });
  for (const button of root.querySelectorAll("[data-zoom]"))
    button.addEventListener("click", () => {
      zoom = Math.min(12, Math.max(0.1, zoom * Number(button.dataset.zoom)));
      draw();
    });
  // A moment elsewhere on the page, told by its time, is shown here.
  for (const moment of document.querySelectorAll("[data-at-s]")) {
    const button = document.createElement("button");
    button.type = "button";
    button.className = "moment";
    button.title = "Show this moment in the replay";
    button.append(...moment.childNodes);
    button.addEventListener("click", () => {
      pause();
      index = times.findIndex((t) => t >= Number(moment.dataset.atS));
      if (index < 0) index = count - 1;
      draw();
      root.scrollIntoView({ block: "center" });
      slider.focus();
    });
    moment.append(button);
  }
  if (field) field.addEventListener("focus", () => { typed = true; });
  // Where the comments are, along the slider.
  if (comments.length > 0) {
    const marks = document.createElement("datalist");
    marks.id = "comment-marks";
    for (const one of comments) {
      const mark = document.createElement("option");
      mark.value = Math.max(0, times.findIndex((t) => t >= one.at));
      marks.append(mark);
    }
    slider.after(marks);
    slider.setAttribute("list", marks.id);
  }
  fetch(root.dataset.skin).then((answer) => answer.json()).then((skin) => {
    const vertices = [], triangles = [], edges = new Map();
    for (let i = 0; i < skin.vertices_mm.length; i += 3) vertices.push(skin.vertices_mm.slice(i, i + 3));
    for (let i = 0; i < skin.triangles.length; i += 3) triangles.push(skin.triangles.slice(i, i + 3));
    triangles.forEach((corners, t) => corners.forEach((a, i) => {
      const b = corners[(i + 1) % 3], key = Math.min(a, b) + " " + Math.max(a, b);
      if (edges.has(key)) edges.get(key).push(t);
      else edges.set(key, [a, b, t]);
    }));
    net = { vertices, triangles, edges: [...edges.values()] };
    draw();
  }).catch(() => {});  // without it there is a replay still
  let held = null;
  canvas.addEventListener("pointerdown", (event) => {
    held = [event.clientX, event.clientY];
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!held) return;
    yaw += (event.clientX - held[0]) * 0.5;
    pitch = Math.min(90, Math.max(-90, pitch + (event.clientY - held[1]) * 0.5));
    held = [event.clientX, event.clientY];
    draw();
  });
  canvas.addEventListener("pointerup", () => { held = null; });
  canvas.addEventListener("keydown", (event) => {
    const turned = { ArrowLeft: [-5, 0], ArrowRight: [5, 0], ArrowUp: [0, 5], ArrowDown: [0, -5] }[event.key];
    if (!turned) return;
    event.preventDefault();
    yaw += turned[0];
    pitch = Math.min(90, Math.max(-90, pitch + turned[1]));
    draw();
  });
  addEventListener("resize", draw);
  index = replay.fired_s === null ? count - 1 : times.findIndex((t) => t >= replay.fired_s);
  if (index < 0) index = count - 1;
  draw();
}
