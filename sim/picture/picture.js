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
  data.errors = data.errors.map((e) => ({ at: e.slice(0, 3), move: e[3], text: e[4], block: e[5], miss: e[6] > 0, used: e[6] === 2, drawn: isDrawn(e.slice(0, 3)) }));
  // As the SVG names them: errors and misses count apart.
  const many = { E: 0, M: 0 };
  for (const error of data.errors) error.number = ++many[error.letter = error.miss ? "M" : "E"];
  const frames = data.frames, frameOf = []; // of each move
  for (const [first, count, frame] of data.framed) for (let i = 0; i < count; ++i) frameOf[first + i] = frame;

  for (const [first, count, tool] of data.spindle)
    for (let i = first; i < first + count; ++i) moves[i].tool = { number: data.tools[tool][0], length: data.tools[tool][1], radius: data.tools[tool][2], listed: data.tools[tool][3] === 1 };

  const canvas = byId("view"), slider = byId("slider"), list = byId("blocks");
  const view = makeView(canvas, data);
  const contactOf = new Map(), errorOf = new Map();
  data.contacts.forEach((c, i) => contactOf.set(c.move, i));
  data.errors.forEach((e, i) => { if (!errorOf.has(e.move)) errorOf.set(e.move, i); });
  const firstMove = new Array(data.blocks.length).fill(-1), badBlocks = new Set(), doubtful = new Set();
  moves.forEach((m, i) => { if (firstMove[m.block] === -1) firstMove[m.block] = i; });
  data.errors.forEach((e) => { if (data.blocks[e.block]) (e.miss && !e.used ? doubtful : badBlocks).add(e.block); });

  let current = 0, waiting = false;
  // As the control rounds: half away from zero, no "-0".
  const number = (v) => {
    if (v === null || !Number.isFinite(v)) return "?";
    const scale = 10 ** data.decimals, whole = Math.floor(Math.abs(v) * scale + 0.5 + 1e-6);
    return (v < 0 && whole > 0 ? "-" : "") + (whole / scale).toFixed(data.decimals);
  };
  const point = (p) => ["X", "Y", "Z"].map((a, i) => a + number(p[i])).join(" ");
  const reachOf = (move) => moves[move] !== undefined && moves[move].tool !== undefined ? moves[move].tool.length : data.probe === null ? 0 : data.probe.length;
  // What is not known of a place during a move is null.
  const knownOf = (p, move) => {
    const frame = frames[frameOf[move]], unknown = frame === undefined ? 0 : frame[4];
    return p.map((v, i) => (unknown >> i & 1) === 1 ? null : v);
  };
  const gaugeOf = (p, move) => knownOf([p[0], p[1], p[2] === null ? null : p[2] + reachOf(move)], move);
  // Of a position of the gauge line during a move; nothing: not known.
  const workOf = (gauge, move) => {
    const frame = frames[frameOf[move]];
    return frame === undefined ? null : gauge.map((v, i) => v === null || frame[i + 1] === null ? null : v - frame[i + 1]);
  };
  const nameOf = (move) => frames[frameOf[move]] === undefined ? "work" : frames[frameOf[move]][0];

  // A text of which no number breaks at its sign.
  const say = (node, text) => {
    text.split(/((?:^|(?<= ))[A-Z]?-[0-9][0-9.]*)/).forEach((part, i) => {
      if (i % 2 === 0) return node.append(part);
      const whole = document.createElement("span");
      whole.className = "n";
      whole.textContent = part;
      node.append(whole);
    });
  };

  function redraw() {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      view.draw(current);
    });
  }

  // ---- the list of blocks, under the names of their programs: only the rows in sight exist
  const kRow = 22, rowOf = [], lines = []; // a line: a block, or the name of a program
  let program = null;
  data.blocks.forEach((block, i) => {
    const name = [block[2], block[1].replace(/:[0-9]+$/, "")].filter((part) => part !== "").join("  ");
    if (name !== program && name !== "") lines.push(name);
    program = name;
    rowOf.push(lines.length);
    lines.push(i);
  });
  const rows = document.createElement("div");
  rows.style.height = lines.length * kRow + "px";
  list.append(rows);
  function layRows() {
    const first = Math.max(0, Math.floor(list.scrollTop / kRow) - 5);
    const last = Math.min(lines.length, first + Math.ceil((list.clientHeight || 600) / kRow) + 10);
    const here = moves[current] ? moves[current].block : -1;
    rows.replaceChildren();
    for (let at = first; at < last; ++at) {
      const row = document.createElement("div"), i = lines[at];
      row.style.top = at * kRow + "px";
      rows.append(row);
      if (typeof i === "string") {
        row.className = "row program";
        row.textContent = i;
        continue;
      }
      const line = document.createElement("span");
      row.className = "row" + (i === here ? " current" : "") + (firstMove[i] === -1 ? " still" : "") + (badBlocks.has(i) ? " bad" : doubtful.has(i) ? " doubtful" : "");
      row.dataset.block = i;
      row.title = data.blocks[i][1];
      line.className = "line";
      line.textContent = data.blocks[i][1].split(":").pop();
      row.append(line, data.blocks[i][0]);
    }
  }
  list.addEventListener("scroll", layRows);
  rows.addEventListener("click", (event) => {
    const row = event.target.closest(".row");
    if (row && row.dataset.block !== undefined && firstMove[row.dataset.block] !== -1) go(firstMove[row.dataset.block]);
  });
  function showBlock() {
    let top = (moves[current] ? rowOf[moves[current].block] : 0) * kRow;
    // What stopped the run is in sight with the last move.
    if (current === moves.length - 1 && badBlocks.has(data.blocks.length - 1)) top = rowOf[data.blocks.length - 1] * kRow;
    if (top < list.scrollTop || top + kRow > list.scrollTop + list.clientHeight)
      list.scrollTop = Math.max(0, top - list.clientHeight / 2);
    layRows();
  }

  // ---- steps
  const kindOf = (move) => data.still ? "none" : data.kinds[move.kind].name;
  function state() {
    const move = moves[current];
    if (!move) return { index: -1, count: 0 };
    const at = view.placeAt(current), gauge = gaugeOf(at, current), work = workOf(gauge, current);
    return { index: current, count: data.still ? 0 : moves.length, position: at, text: knownOf(at, current).map(number), machine: gauge.map(number),
      work: work === null ? null : work.map(number), system: nameOf(current), kind: kindOf(move), probeOn: move.on, block: move.block,
      place: (data.blocks[move.block] || ["", ""])[1], drawnAt: move.drawn ? view.where(at) : null };
  }
  function go(index) {
    if (moves.length === 0) return;
    current = Math.max(0, Math.min(moves.length - 1, Math.round(Number(index)) || 0));
    const move = moves[current];
    slider.value = current;
    const at = view.placeAt(current), gauge = gaugeOf(at, current), work = workOf(gauge, current), failed = view.failureAt(current);
    byId("position-name").textContent = "Position" + (data.still ? " at the start" : failed === undefined ? "" : " at " + failed.letter + failed.number);
    ["x", "y", "z"].forEach((name, i) => {
      byId(name).textContent = number(knownOf(at, current)[i]);
      byId("gauge-" + name).textContent = number(gauge[i]);
      byId("work-" + name).textContent = work === null ? "?" : number(work[i]);
    });
    byId("work-name").textContent = nameOf(current) === "work" ? "work" : "work " + nameOf(current);
    byId("what").textContent = move.tool === undefined ? "ball's centre" : move.tool.listed ? "end of tool " + move.tool.number :
      "tool " + move.tool.number + ", in no list: " + (move.tool.length > 0 ? "its end by the length in force, " + number(move.tool.length) : "the gauge line");
    byId("kind").textContent = kindOf(move);
    byId("power").textContent = move.tool !== undefined ? "not in the spindle" : move.on ? "on" : "off";
    byId("count").textContent = data.still ? "no moves" : "move " + (move.number + 1) + " of " + data.count;
    const here = byId("here"), contact = contactOf.get(current), error = errorOf.get(current);
    here.textContent = "";
    if (contact !== undefined) {
      const at = data.contacts[contact].point, tip = gaugeOf(at, current);
      if (tip[2] !== null && data.probe !== null && move.tool === undefined) tip[2] += data.probe.ball; // the place that the tip has there
      const inWork = workOf(tip, current);
      here.textContent = "contact " + (contact + 1) + (inWork === null ? "" : " at " + nameOf(current) + " " + point(inWork)) + "; machine " + point(at);
    }
    if (error !== undefined) {
      const red = document.createElement("div");
      red.className = "error";
      say(red, data.errors[error].letter + data.errors[error].number + ": " + data.errors[error].text);
      here.append(red);
    }
    const end = gaugeOf(move.to, current), meant = workOf(end, current) || end;
    if (failed !== undefined && point(meant) !== point(work || gauge)) {
      const line = document.createElement("div");
      line.id = "move-end";
      say(line, "end of the move: " + (work === null ? "machine" : nameOf(current)) + " " + point(meant));
      here.append(line);
    }
    showBlock();
    redraw();
  }
  if (data.probe === null && data.tools.length === 0) byId("what").parentNode.hidden = true; // the path is the machine's own
  if (frames.length === 0) byId("work").hidden = true;
  slider.max = Math.max(0, moves.length - 1);
  slider.addEventListener("input", () => go(slider.value));
  byId("back").addEventListener("click", () => go(current - 1));
  byId("next").addEventListener("click", () => go(current + 1));
  byId("last").addEventListener("click", () => go(moves.length - 1));
  document.addEventListener("keydown", (event) => {
    const factor = { "+": 1.4, "-": 1 / 1.4 }[event.key];
    if (factor !== undefined && !event.ctrlKey && !event.metaKey) return zoom(factor);
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
  for (const id of ["slider", "back", "next", "last", "play"]) byId(id).disabled = moves.length === 0 || data.still;
  if (moves.length === 0) byId("count").textContent = "no moves";

  // ---- errors: those before misses
  [false, true].flatMap((miss) => data.errors.filter((error) => error.miss === miss)).forEach((error) => {
    const item = document.createElement("li"), button = document.createElement("button");
    say(button, error.letter + error.number + "  " + (data.blocks[error.block] ? data.blocks[error.block][1] + ": " : "") + error.text);
    button.addEventListener("click", () => go(error.move));
    item.append(button);
    byId("errors").append(item);
  });
  byId("errors-box").hidden = data.errors.length === 0;
  byId("errors-name").textContent = [many.E > 0 ? "Errors (" + many.E + ")" : "", many.M > 0 ? "Misses (" + many.M + ")" : ""].filter((s) => s !== "").join(", ");
  for (const button of document.querySelectorAll("#measured button")) button.addEventListener("click", () => go(button.dataset.move));

  // ---- the view: one finger or the mouse turns, two fingers zoom and move
  const pointers = new Map();
  const middleOf = () => {
    const all = [...pointers.values()], box = canvas.getBoundingClientRect();
    return { x: (all[0].x + all[1].x) / 2 - box.left, y: (all[0].y + all[1].y) / 2 - box.top,
      apart: Math.max(1, Math.hypot(all[0].x - all[1].x, all[0].y - all[1].y)) };
  };
  canvas.addEventListener("pointerdown", (event) => {
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY, shift: event.shiftKey || event.button !== 0 });
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    const drag = pointers.get(event.pointerId), camera = view.camera;
    if (drag === undefined || pointers.size > 2) return;
    const before = pointers.size === 2 ? middleOf() : null;
    const dx = event.clientX - drag.x, dy = event.clientY - drag.y;
    drag.x = event.clientX, drag.y = event.clientY;
    if (before !== null) {
      const after = middleOf();
      view.zoomAt(after.apart / before.apart, before.x, before.y);
      view.change({ x: camera.x + after.x - before.x, y: camera.y + after.y - before.y });
    } else if (drag.shift) view.change({ x: camera.x + dx, y: camera.y + dy });
    else view.change({ turn: camera.turn - dx * 0.008, tilt: camera.tilt + dy * 0.008 });
    nameProjection();
    redraw();
  });
  for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, (event) => { pointers.delete(event.pointerId); });
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    const box = canvas.getBoundingClientRect(), lines = event.deltaMode === 1 ? 30 : 1;
    view.zoomAt(Math.exp(-Math.max(-300, Math.min(300, event.deltaY * lines)) * 0.0016), event.clientX - box.left, event.clientY - box.top);
    redraw();
  }, { passive: false });
  const sides = { "view-3d": [-0.62, 0.62], "view-xy": [0, Math.PI / 2], "view-xz": [0, 0], "view-yz": [Math.PI / 2, 0] };
  const seen = { "view-xy": "XY, seen from above (+Z)", "view-xz": "XZ, seen from the front (-Y)", "view-yz": "YZ, seen from the right (+X)" };
  function nameProjection() {
    const { turn, tilt } = view.camera, close = (a, b) => Math.abs(a - b) < 1e-6;
    const side = Object.keys(seen).find((id) => close(turn, sides[id][0]) && close(tilt, sides[id][1]));
    byId("projection").textContent = "parallel projection" + (side === undefined ? "" : ": " + seen[side]);
  }
  for (const [id, [turn, tilt]] of Object.entries(sides)) {
    byId(id).addEventListener("click", () => {
      view.change({ turn, tilt });
      view.fit();
      nameProjection();
      redraw();
    });
  }
  function zoom(factor) {
    view.zoomAt(factor, canvas.clientWidth / 2, canvas.clientHeight / 2);
    redraw();
  }
  byId("zoom-in").addEventListener("click", () => zoom(1.4));
  byId("zoom-out").addEventListener("click", () => zoom(1 / 1.4));
  byId("fit").addEventListener("click", () => {
    view.fit();
    redraw();
  });
  for (const what of ["part", "probe"]) {
    byId("show-" + what).addEventListener("change", (event) => {
      view.show[what] = event.target.checked;
      view.redoPart();
      redraw();
    });
  }
  new ResizeObserver(() => {
    view.resize();
    layRows();
    view.draw(current); // before the page is painted, so that nothing flickers
  }).observe(canvas);

  // The colours of the page are those of the view, on paper the light ones.
  function retheme() {
    view.retheme();
    view.draw(current); // at once: paper waits for no frame
  }
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", retheme);
  for (const [name, on] of [["beforeprint", true], ["afterprint", false]]) {
    window.addEventListener(name, () => {
      document.documentElement.classList.toggle("on-paper", on);
      retheme();
    });
  }

  window.dotek = { moves, go, state, camera: view.camera };
  view.resize();
  view.fit();
  nameProjection();
  const opens = data.opens === null ? moves.length - 1 : data.opens;
  const wanted = () => { const match = /^#go=(\d+)$/.exec(location.hash); return match ? Number(match[1]) : opens; };
  window.addEventListener("hashchange", () => go(wanted()));
  layRows();
  if (data.opens !== null && moves[opens] !== undefined && moves[opens].drawn) view.turnTo(view.placeAt(opens));
  go(wanted());
  view.draw(current); // at once: what prints or photographs the page waits for no frame
})();
