// The page of a run: steps through its moves, lists its blocks and errors, turns the view.
"use strict";

window.onerror = (message, source, line) => {
  const fault = document.getElementById("fault");
  fault.textContent += message + " (line " + line + ")\n";
  fault.hidden = false;
};

(() => {
  const byId = (id) => document.getElementById(id);
  const data = JSON.parse(byId("data").textContent);

  // Moves come as kind, probe on, block, x, y, z; each begins where the one before it ended, but for `jumps`.
  const isDrawn = (p) => p.every((v) => v !== null && Math.abs(v) <= 1e6);
  const jumps = new Map(data.jumps.map((j) => [j[0], j.slice(1)]));
  const moves = [];
  for (let i = 0; i < data.way.length; i += 6) {
    const n = i / 6, to = data.way.slice(i + 3, i + 6);
    const from = jumps.get(n) || (n > 0 ? moves[n - 1].to : to);
    moves.push({ kind: data.way[i], on: data.way[i + 1] === 1, block: data.way[i + 2], from, to,
      drawn: isDrawn(from) && isDrawn(to), number: data.numbers ? data.numbers[n] : n });
  }
  data.moves = moves;
  data.contacts = data.contacts.map((c) => ({ point: c.slice(0, 3), move: c[3], drawn: isDrawn(c.slice(0, 3)) }));
  data.errors = data.errors.map((e) => ({ at: e.slice(0, 3), move: e[3], text: e[4], drawn: isDrawn(e.slice(0, 3)) }));

  const canvas = byId("view"), slider = byId("slider"), list = byId("blocks");
  const view = makeView(canvas, data);
  const contactOf = new Map(), errorOf = new Map();
  data.contacts.forEach((c, i) => contactOf.set(c.move, i));
  data.errors.forEach((e, i) => { if (!errorOf.has(e.move)) errorOf.set(e.move, i); });
  const firstMove = new Array(data.blocks.length).fill(-1), badBlocks = new Set();
  moves.forEach((m, i) => { if (firstMove[m.block] === -1) firstMove[m.block] = i; });
  data.errors.forEach((e) => { if (moves[e.move]) badBlocks.add(moves[e.move].block); });

  let current = 0, waiting = false;
  const number = (v) => v === null ? "?" : v.toFixed(6);

  function redraw() {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      view.draw(current);
    });
  }

  // ---- the list of blocks: only the rows in sight exist
  const kRow = 22;
  const rows = document.createElement("div");
  rows.style.height = data.blocks.length * kRow + "px";
  list.append(rows);
  function layRows() {
    const first = Math.max(0, Math.floor(list.scrollTop / kRow) - 5);
    const last = Math.min(data.blocks.length, first + Math.ceil((list.clientHeight || 600) / kRow) + 10);
    const here = moves[current] ? moves[current].block : -1;
    rows.replaceChildren();
    for (let i = first; i < last; ++i) {
      const row = document.createElement("div"), line = document.createElement("span");
      row.className = "row" + (i === here ? " current" : "") + (firstMove[i] === -1 ? " still" : "") + (badBlocks.has(i) ? " bad" : "");
      row.style.top = i * kRow + "px";
      row.dataset.block = i;
      row.title = data.blocks[i][1];
      line.className = "line";
      line.textContent = data.blocks[i][1].split(":").pop();
      row.append(line, data.blocks[i][0]);
      rows.append(row);
    }
  }
  list.addEventListener("scroll", layRows);
  rows.addEventListener("click", (event) => {
    const row = event.target.closest(".row");
    if (row && firstMove[row.dataset.block] !== -1) go(firstMove[row.dataset.block]);
  });
  function showBlock() {
    const top = (moves[current] ? moves[current].block : 0) * kRow;
    if (top < list.scrollTop || top + kRow > list.scrollTop + list.clientHeight)
      list.scrollTop = Math.max(0, top - list.clientHeight / 2);
    layRows();
  }

  // ---- steps
  function state() {
    const move = moves[current];
    if (!move) return { index: -1, count: 0 };
    return { index: current, count: moves.length, position: move.to, text: move.to.map(number), kind: data.kinds[move.kind].name,
      probeOn: move.on, block: move.block, place: (data.blocks[move.block] || ["", ""])[1], drawnAt: move.drawn ? view.where(move.to) : null };
  }
  function go(index) {
    if (moves.length === 0) return;
    current = Math.max(0, Math.min(moves.length - 1, Math.round(Number(index)) || 0));
    const move = moves[current];
    slider.value = current;
    ["x", "y", "z"].forEach((name, i) => {
      byId(name).textContent = number(move.to[i]);
      byId("gauge-" + name).textContent = move.to[i] === null ? "?" : number(move.to[i] + (i === 2 && data.probe ? data.probe.length : 0));
    });
    byId("kind").textContent = data.kinds[move.kind].name;
    byId("power").textContent = move.on ? "on" : "off";
    byId("count").textContent = "move " + (move.number + 1) + " of " + data.count;
    const here = byId("here"), contact = contactOf.get(current), error = errorOf.get(current);
    here.textContent = contact === undefined ? "" : "contact " + (contact + 1) + " at " + ["X", "Y", "Z"].map((a, i) => a + number(data.contacts[contact].point[i])).join(" ");
    if (error !== undefined) {
      const red = document.createElement("div");
      red.className = "error";
      red.textContent = "E" + (error + 1) + ": " + data.errors[error].text;
      here.append(red);
    }
    showBlock();
    redraw();
  }
  if (data.probe === null) { // the path is the machine's own
    byId("what").textContent = "machine";
    byId("gauge").hidden = true;
  }
  slider.max = Math.max(0, moves.length - 1);
  slider.addEventListener("input", () => go(slider.value));
  byId("back").addEventListener("click", () => go(current - 1));
  byId("next").addEventListener("click", () => go(current + 1));
  document.addEventListener("keydown", (event) => {
    const to = { ArrowLeft: current - 1, ArrowRight: current + 1, Home: 0, End: moves.length - 1 }[event.key];
    if (to === undefined || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    go(to);
  });
  let timer = null;
  byId("play").addEventListener("click", () => {
    if (timer === null && current === moves.length - 1) go(0);
    timer = timer === null ? setInterval(() => {
      go(current + 1);
      if (current === moves.length - 1) byId("play").click();
    }, Math.max(60, Math.min(500, 20000 / moves.length))) : clearInterval(timer) || null;
    byId("play").textContent = timer === null ? "Play" : "Stop";
  });
  for (const id of ["slider", "back", "next", "play"]) byId(id).disabled = moves.length === 0;
  if (moves.length === 0) byId("count").textContent = "no moves";

  // ---- errors
  data.errors.forEach((error, i) => {
    const item = document.createElement("li"), button = document.createElement("button");
    button.textContent = "E" + (i + 1) + "  " + (moves[error.move] ? (data.blocks[moves[error.move].block] || ["", ""])[1] + ": " : "") + error.text;
    button.addEventListener("click", () => go(error.move));
    item.append(button);
    byId("errors").append(item);
  });
  byId("errors-box").hidden = data.errors.length === 0;

  // ---- the view
  let drag = null;
  canvas.addEventListener("pointerdown", (event) => {
    drag = { x: event.clientX, y: event.clientY, shift: event.shiftKey || event.button !== 0 };
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (drag === null) return;
    const dx = event.clientX - drag.x, dy = event.clientY - drag.y, camera = view.camera;
    drag.x = event.clientX, drag.y = event.clientY;
    if (drag.shift) view.change({ x: camera.x + dx, y: camera.y + dy });
    else view.change({ turn: camera.turn - dx * 0.008, tilt: camera.tilt + dy * 0.008 });
    redraw();
  });
  for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, () => { drag = null; });
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    const box = canvas.getBoundingClientRect(), lines = event.deltaMode === 1 ? 30 : 1;
    view.zoomAt(Math.exp(-Math.max(-300, Math.min(300, event.deltaY * lines)) * 0.0016), event.clientX - box.left, event.clientY - box.top);
    redraw();
  }, { passive: false });
  const sides = { "view-3d": [-0.62, 0.62], "view-xy": [0, Math.PI / 2], "view-xz": [0, 0], "view-yz": [Math.PI / 2, 0] };
  for (const [id, [turn, tilt]] of Object.entries(sides)) {
    byId(id).addEventListener("click", () => {
      view.change({ turn, tilt });
      view.fit();
      redraw();
    });
  }
  for (const what of ["part", "probe"]) {
    byId("show-" + what).addEventListener("change", (event) => {
      view.show[what] = event.target.checked;
      view.redoPart();
      redraw();
    });
  }
  let isFitted = false;
  new ResizeObserver(() => {
    view.resize();
    if (!isFitted) view.fit();
    isFitted = true;
    layRows();
    view.draw(current); // before the page is painted, so that nothing flickers
  }).observe(canvas);

  window.dotek = { moves, go, state };
  view.resize();
  view.fit();
  const wanted = () => { const match = /^#go=(\d+)$/.exec(location.hash); return match ? Number(match[1]) : 0; };
  window.addEventListener("hashchange", () => go(wanted()));
  layRows();
  go(wanted());
  view.draw(current); // at once: what prints or photographs the page waits for no frame
})();
