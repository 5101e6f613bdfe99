// Sends the files of an import piece by piece, and tells how far a job is. A page without this script tells it when it
// is asked again.
"use strict";
const job = document.querySelector("[data-job]");
const words = job.querySelector("[data-words]"), doing = job.querySelector("[data-doing]");
const bar = job.querySelector("progress"), address = job.dataset.job;
const token = job.querySelector("input[name=token]").value;
const kPiece = 45000;  // of a file; a request holds 64 KiB with its letters

const tell = (state, text, share) => {
  words.textContent = state;
  doing.textContent = text;
  if (share >= 0) bar.value = share;
  else bar.removeAttribute("value");
};

// Looks every second until it has ended, then shows what came of it.
async function watch() {
  for (;;) {
    try {
      const answer = await fetch(address + "/job.json", { redirect: "error" });
      if (!answer.ok) return location.reload();
      const now = await answer.json();
      if (now.ended) return location.reload();
      tell(now.state_words, now.doing, now.share_done === null ? -1 : now.share_done);
    } catch {
      doing.textContent = "The server does not answer.";
    }
    await new Promise((done) => setTimeout(done, 1000));
  }
}

const post = (path, fields) =>
  fetch(address + path, { method: "POST", body: new URLSearchParams({ token, ...fields }), redirect: "error" });

// A proxy's page, or one of ours, is no line.
const why = async (answer) =>
  (answer.headers.get("Content-Type") || "").startsWith("text/plain") ? await answer.text() : "";

const base64url = (bytes) => {
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
};

// Slices are often named by numbers alone; what else has letters for an ending, a README.md say, is none.
const ending = (name) => {
  const small = name.toLowerCase();
  const known = [".nii.gz", ".nii", ".nrrd", ".mha"].find((one) => small.endsWith(one))?.slice(1);
  return known || (/\.(?!dcm$|ima$|img$|dicom$)[a-z]+$/.test(small) ? "other" : "dcm");
};

async function send(chosen) {
  const files = [...chosen].filter((one) => one.size > 0);
  const all = files.reduce((sum, one) => sum + one.size, 0);
  let sent = 0;
  for (const [number, file] of files.entries()) {
    for (let at = 0; at < file.size; at += kPiece) {
      const piece = new Uint8Array(await file.slice(at, at + kPiece).arrayBuffer());
      const answer = await post("/files", { number, ending: ending(file.name), at, data: base64url(piece) });
      if (!answer.ok) return tell("Not sent.", await why(answer), 0);
      sent += piece.length;
      tell("Sending", `file ${number + 1} of ${files.length}`, sent / all);
    }
  }
  const begun = await post("/start", {});
  if (begun.ok) location.reload();
  else tell("Not sent.", await why(begun), 0);
}

if (job.dataset.state === "waiting" || job.dataset.state === "running") watch();
const chooser = document.querySelector("[data-send]");
if (chooser) {
  chooser.hidden = false;
  for (const input of chooser.querySelectorAll("[data-files]"))
    input.addEventListener("change", () => {
      if (input.files.length === 0) return;
      chooser.hidden = true;
      send(input.files).catch(() => tell("Not sent.", "The server does not answer.", 0));
    });
}
