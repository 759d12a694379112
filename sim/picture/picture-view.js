// The 3D view: parallel projection, drawn without a graphics processor. Part and probe are filled into a depth
// buffer; the path is drawn over them as lines in full colour, dotted where they are before it, thinner where
// it is still to come.
"use strict";

function makeView(canvas, data) {
  const paint = canvas.getContext("2d");
  const camera = { turn: -0.62, tilt: 0.62, zoom: 1, x: 0, y: 0 }; // zoom: px per mm; x, y: shift in px
  const middle = [0, 1, 2].map((i) => (data.region[i] + data.region[i + 3]) / 2);
  const show = { part: true, probe: true };
  const part = readMesh(data.mesh);
  let width = 1, height = 1, dots = 1; // of the canvas in px, its dots per px
  let image = null, partIsDrawn = false, isFitted = false;
  let partColours, partDepths;           // of the part alone; kept until the camera moves
  let frameColours, frameDepths;         // with the probe
  let colours, depths;                   // the two that are being filled
  let right, up, front; // of the camera, in the machine
  let theme = readTheme();

  // The colours are those of the style sheet, light or dark.
  function readTheme() {
    const style = getComputedStyle(document.documentElement), out = {};
    for (const name of ["paper", "ink", "dim", "part-least", "part-most", "part-edge", "note", "error", "contact"])
      out[name] = style.getPropertyValue("--" + name).trim();
    out.kinds = data.kinds.map((kind) => style.getPropertyValue("--" + kind.name).trim());
    return out;
  }
  const rgb = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
  const packed = ([r, g, b]) => (255 << 24 | b << 16 | g << 8 | r) >>> 0;

  function readMesh(mesh) {
    const count = mesh.vertices.length / 3;
    const points = new Float64Array(mesh.vertices.length);
    for (let i = 0; i < points.length; ++i) points[i] = data.region[i % 3] + mesh.vertices[i] * mesh.unit;
    const triangles = Uint32Array.from(mesh.triangles);
    const normals = new Float64Array(triangles.length);
    const ends = new Map(); // of an edge: the triangles beside it
    for (let t = 0; t < triangles.length; t += 3) {
      const [a, b, c] = [triangles[t] * 3, triangles[t + 1] * 3, triangles[t + 2] * 3];
      const u = [0, 1, 2].map((i) => points[b + i] - points[a + i]);
      const v = [0, 1, 2].map((i) => points[c + i] - points[a + i]);
      const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
      const size = Math.hypot(...n);
      if (size < 1e-9) continue; // flat: it has no side
      for (let i = 0; i < 3; ++i) normals[t + i] = n[i] / size;
      for (let i = 0; i < 3; ++i) {
        const from = triangles[t + i], to = triangles[t + (i + 1) % 3];
        const key = Math.min(from, to) * count + Math.max(from, to);
        if (ends.has(key)) ends.get(key).push(t);
        else ends.set(key, [t]);
      }
    }
    const edges = [], borders = []; // sharp ones; of an open cut
    for (const [key, faces] of ends) {
      if (faces.length === 1 && data.open) borders.push(Math.floor(key / count) * 3, (key % count) * 3);
      if (faces.length !== 2) continue;
      const [s, t] = faces;
      const cosine = normals[s] * normals[t] + normals[s + 1] * normals[t + 1] + normals[s + 2] * normals[t + 2];
      if (cosine < 0.82) edges.push(Math.floor(key / count) * 3, (key % count) * 3);
    }
    return { points, triangles, normals, edges, borders };
  }

  // A body of revolution about Z: a list of [radius, z] from below to above.
  function turned(profile, colour) {
    const steps = 28, points = [], triangles = [];
    for (const [radius, z] of profile)
      for (let i = 0; i < steps; ++i) points.push(radius * Math.cos(2 * Math.PI * i / steps), radius * Math.sin(2 * Math.PI * i / steps), z);
    for (let k = 0; k + 1 < profile.length; ++k)
      for (let i = 0; i < steps; ++i) {
        const a = k * steps + i, b = k * steps + (i + 1) % steps;
        triangles.push(a, b, a + steps, b, b + steps, a + steps);
      }
    return { points, triangles, colour };
  }
  function makeProbe() {
    const probe = data.probe, out = [], ball = [];
    if (probe === null) return out;
    for (let i = 0; i <= 14; ++i) ball.push([probe.ball * Math.sin(Math.PI * i / 14), -probe.ball * Math.cos(Math.PI * i / 14)]);
    out.push(turned(ball, null));
    const [stemRadius, stemLength] = probe.stem, [bodyRadius, bodyLength] = probe.body;
    if (stemRadius > 0 && stemLength > 0)
      out.push(turned([[0, 0], [stemRadius, 0], [stemRadius, stemLength], [0, stemLength]], [168, 176, 186]));
    if (bodyRadius > 0 && bodyLength > 0) {
      const low = stemLength, high = stemLength + bodyLength, bevel = Math.min(bodyRadius, bodyLength) * 0.15;
      out.push(turned([[0, low], [bodyRadius - bevel, low], [bodyRadius, low + bevel], [bodyRadius, high - bevel],
        [bodyRadius - bevel, high], [0, high]], [128, 141, 156]));
    }
    return out;
  }
  const probeBodies = makeProbe(), toolBodies = new Map(); // by number
  function bodiesOf(tool) {
    if (tool === undefined) return probeBodies;
    if (!tool.listed) return []; // what it looks like is not known
    if (!toolBodies.has(tool.number))
      toolBodies.set(tool.number, [turned([[0, 0], [tool.radius, 0], [tool.radius, tool.length], [0, tool.length]], [148, 158, 170])]);
    return toolBodies.get(tool.number);
  }

  function aim() {
    const { turn, tilt } = camera;
    right = [Math.cos(turn), Math.sin(turn), 0];
    front = [Math.sin(turn) * Math.cos(tilt), -Math.cos(turn) * Math.cos(tilt), Math.sin(tilt)];
    up = [front[1] * right[2] - front[2] * right[1], front[2] * right[0] - front[0] * right[2], front[0] * right[1] - front[1] * right[0]];
  }
  // To px of the canvas and a depth, greater is nearer.
  function project(x, y, z) {
    const a = x - middle[0], b = y - middle[1], c = z - middle[2];
    return [
      width / 2 + camera.x + (a * right[0] + b * right[1] + c * right[2]) * camera.zoom,
      height / 2 + camera.y - (a * up[0] + b * up[1] + c * up[2]) * camera.zoom,
      a * front[0] + b * front[1] + c * front[2],
    ];
  }

  function shade(nx, ny, nz, colour) {
    const facing = nx * front[0] + ny * front[1] + nz * front[2];
    const above = nx * up[0] + ny * up[1] + nz * up[2], beside = nx * right[0] + ny * right[1] + nz * right[2];
    const light = Math.max(0, Math.min(1, 0.12 + 0.72 * Math.max(0, facing) + 0.3 * above - 0.2 * beside));
    return packed(colour[0].map((least, i) => Math.round(least + (colour[1][i] - least) * light)));
  }

  // Fills one triangle; corners in dots and depth.
  function fill(ax, ay, az, bx, by, bz, cx, cy, cz, colour) {
    const area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
    if (!(area < 0)) return; // seen from after
    const w = image.width, h = image.height;
    const left = Math.max(0, Math.ceil(Math.min(ax, bx, cx) - 0.5)), last = Math.min(w - 1, Math.floor(Math.max(ax, bx, cx) + 0.5));
    const top = Math.max(0, Math.ceil(Math.min(ay, by, cy) - 0.5)), low = Math.min(h - 1, Math.floor(Math.max(ay, by, cy) + 0.5));
    const slack = 1e-7 * area;
    for (let y = top; y <= low; ++y) {
      for (let x = left; x <= last; ++x) {
        const u = (cx - bx) * (y - by) - (cy - by) * (x - bx), v = (ax - cx) * (y - cy) - (ay - cy) * (x - cx);
        const t = area - u - v;
        if (u > -slack || v > -slack || t > -slack) continue;
        const z = (az * u + bz * v + cz * t) / area, at = y * w + x;
        if (z > depths[at]) {
          depths[at] = z;
          colours[at] = colour;
        }
      }
    }
  }

  function drawPart() {
    if (partIsDrawn) return;
    partIsDrawn = true;
    colours = partColours;
    depths = partDepths;
    colours.fill(packed(rgb(theme.paper)));
    depths.fill(-Infinity);
    if (!show.part) return;
    const { points, triangles, normals } = part, count = points.length / 3;
    const surface = [rgb(theme["part-least"]), rgb(theme["part-most"])]; // darkest and lightest
    const seen = new Float64Array(points.length);
    for (let i = 0; i < count; ++i) {
      const p = project(points[i * 3], points[i * 3 + 1], points[i * 3 + 2]);
      seen[i * 3] = p[0] * dots, seen[i * 3 + 1] = p[1] * dots, seen[i * 3 + 2] = p[2];
    }
    for (let t = 0; t < triangles.length; t += 3) {
      const a = triangles[t] * 3, b = triangles[t + 1] * 3, c = triangles[t + 2] * 3;
      if (data.open) // what is seen through the cut: the inside
        fill(seen[a], seen[a + 1], seen[a + 2], seen[c], seen[c + 1], seen[c + 2], seen[b], seen[b + 1], seen[b + 2], packed(surface[0]));
      fill(seen[a], seen[a + 1], seen[a + 2], seen[b], seen[b + 1], seen[b + 2], seen[c], seen[c + 1], seen[c + 2],
        shade(normals[t], normals[t + 1], normals[t + 2], surface));
    }
  }

  function drawProbe(at, on, tool) {
    for (const body of bodiesOf(tool)) {
      const { points, triangles } = body, own = body.colour || (on ? [240, 166, 20] : [84, 92, 102]);
      const colour = [own.map((c) => c * 0.6), own];
      for (let t = 0; t < triangles.length; t += 3) {
        const [a, b, c] = [0, 1, 2].map((k) => [0, 1, 2].map((i) => points[triangles[t + k] * 3 + i]));
        const u = b.map((v, i) => v - a[i]), v = c.map((w, i) => w - a[i]);
        const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        const size = Math.hypot(...n);
        if (size < 1e-12) continue;
        const [p, q, r] = [a, b, c].map((w) => project(at[0] + w[0], at[1] + w[1], at[2] + w[2]));
        fill(p[0] * dots, p[1] * dots, p[2], q[0] * dots, q[1] * dots, q[2], r[0] * dots, r[1] * dots, r[2],
          shade(n[0] / size, n[1] / size, n[2] / size, colour));
      }
    }
  }

  // Whether part or probe is before a place.
  function isHidden(x, y, z) {
    const column = Math.round(x * dots), row = Math.round(y * dots);
    if (column < 0 || row < 0 || column >= image.width || row >= image.height) return false;
    return depths[row * image.width + column] > z + 2.5 / camera.zoom;
  }

  // From the first corner from which the part does not hide the place; from none: as it was.
  function turnTo(point) {
    const first = camera.turn;
    for (let k = 0; k < 4; ++k) {
      change({ turn: first + k * Math.PI / 2 });
      fit();
      aim();
      drawPart();
      depths = partDepths;
      if (!isHidden(...project(...point))) return;
    }
    change({ turn: first });
    fit();
  }

  // A line in pieces, dotted where it is hidden.
  function line(p, q) {
    const length = Math.hypot(q[0] - p[0], q[1] - p[1]);
    if (length > 20000) { // one end is far outside: no pieces
      paint.beginPath(); paint.moveTo(p[0], p[1]); paint.lineTo(q[0], q[1]); paint.stroke();
      return;
    }
    const steps = Math.max(1, Math.ceil(length / 5)), dashes = paint.getLineDash(), wide = paint.lineWidth;
    const place = (k) => p.map((v, i) => v + (q[i] - v) * k / steps);
    for (let begin = 0; begin < steps;) {
      const hidden = isHidden(...place(begin + 0.5));
      let end = begin + 1;
      while (end < steps && isHidden(...place(end + 0.5)) === hidden) ++end;
      const a = place(begin), b = place(end);
      paint.setLineDash(hidden ? [4, 3.5] : dashes);
      paint.lineWidth = hidden ? 2.4 : wide;
      paint.lineDashOffset = length * begin / steps;
      paint.beginPath(); paint.moveTo(a[0], a[1]); paint.lineTo(b[0], b[1]); paint.stroke();
      begin = end;
    }
    paint.setLineDash(dashes);
    paint.lineWidth = wide;
    paint.lineDashOffset = 0;
  }

  function setStyle(kind, past) {
    const style = data.kinds[kind];
    paint.globalAlpha = 1;
    paint.strokeStyle = theme.kinds[kind];
    paint.lineWidth = past ? style.width : Math.max(2.4, style.width * 0.5);
    paint.setLineDash(style.dashes);
  }

  // Very many moves: one path a kind, moves below a px joined.
  function drawMany(current) {
    for (const past of [false, true]) {
      for (let kind = 0; kind < 4; ++kind) {
        setStyle(kind, past);
        paint.setLineDash([]);
        paint.lineWidth = 1;
        paint.beginPath();
        let last = null;
        for (let i = past ? 0 : current + 1; i < (past ? current + 1 : data.moves.length); ++i) {
          const move = data.moves[i];
          if (move.kind !== kind || !move.drawn) { last = null; continue; }
          const q = project(...move.to);
          if (last === null) {
            const p = project(...move.from);
            paint.moveTo(p[0], p[1]);
            last = p;
          }
          if (Math.abs(q[0] - last[0]) + Math.abs(q[1] - last[1]) < 1) continue;
          paint.lineTo(q[0], q[1]);
          last = q;
        }
        paint.stroke();
      }
    }
  }

  function drawWay(current) {
    if (data.moves.length > 6000) return drawMany(current);
    for (const past of [false, true]) {
      for (const kind of [3, 2, 1, 0]) {
        setStyle(kind, past);
        data.moves.forEach((move, i) => {
          if (move.kind === kind && move.drawn && (i <= current) === past) line(project(...move.from), project(...move.to));
        });
      }
    }
    const move = data.moves[current];
    if (move && move.drawn) { // the one that ends here
      setStyle(move.kind, true);
      paint.setLineDash([]);
      paint.lineWidth = 6;
      paint.globalAlpha = 0.35;
      const p = project(...move.from), q = project(...move.to);
      paint.beginPath(); paint.moveTo(p[0], p[1]); paint.lineTo(q[0], q[1]); paint.stroke();
    }
  }

  const taken = new Set();
  function text(what, x, y, colour) {
    for (const [dx, dy] of [[9, -7], [-9, -7], [9, 15], [-9, 15], [9, -21], [-9, -21]]) {
      const cell = Math.round((x + dx) / 15) + " " + Math.round((y + dy) / 13);
      if (taken.has(cell)) continue;
      taken.add(cell);
      paint.textAlign = dx > 0 ? "left" : "right";
      paint.lineWidth = 3.5;
      paint.strokeStyle = theme.paper;
      paint.strokeText(what, x + dx, y + dy);
      paint.fillStyle = colour;
      paint.fillText(what, x + dx, y + dy);
      return;
    }
  }
  // The disc of the tool setter: its face, and as high as half its width below.
  function drawSetter() {
    if (data.setter === null) return;
    const { at: [x, y, z], radius } = data.setter;
    paint.lineWidth = 1.6;
    paint.strokeStyle = theme.ink;
    for (const down of [0, radius]) {
      paint.beginPath();
      for (let i = 0; i <= 36; ++i) {
        const angle = i * Math.PI / 18;
        const [px, py] = project(x + radius * Math.cos(angle), y + radius * Math.sin(angle), z - down);
        if (i === 0) paint.moveTo(px, py); else paint.lineTo(px, py);
      }
      paint.stroke();
    }
    const [px, py] = project(x, y, z - radius);
    text("tool setter", px, py, theme.ink);
  }
  function drawMarks(current) {
    taken.clear();
    paint.setLineDash([]);
    paint.globalAlpha = 1;
    paint.font = "bold 12.5px Helvetica, Arial, sans-serif";
    paint.lineJoin = "round";
    const numbered = []; // marks that fall on one another share a label
    const mark = (x, y, number, letter, colour) => {
      const same = numbered.find((m) => m.letter === letter && Math.hypot(m.x - x, m.y - y) < 4);
      if (same === undefined) numbered.push({ x, y, letter, colour, numbers: [number] });
      else same.numbers.push(number);
    };
    data.contacts.forEach((contact, i) => {
      if (!contact.drawn) return;
      const [x, y] = project(...contact.point);
      const past = contact.move <= current; // else hollow
      paint.beginPath(); paint.arc(x, y, 3.6, 0, 7); paint.fillStyle = past ? theme.contact : theme.paper; paint.fill();
      paint.lineWidth = 1.2; paint.strokeStyle = past ? theme.paper : theme.contact; paint.stroke();
      if (data.contacts.length <= 400) mark(x, y, i + 1, "", theme.contact);
    });
    data.errors.forEach((error, i) => {
      if (!error.drawn) return;
      const [x, y] = project(...error.at);
      if (i === data.fails) { // seen at a glance
        paint.globalAlpha = 0.22;
        paint.fillStyle = theme.error;
        paint.beginPath(); paint.arc(x, y, 24, 0, 7); paint.fill();
        paint.globalAlpha = 1;
      }
      paint.lineWidth = 3; paint.strokeStyle = theme.error;
      paint.beginPath();
      if (error.miss) {
        paint.lineWidth = 2;
        paint.moveTo(x - 6.5, y); paint.lineTo(x, y - 6.5); paint.lineTo(x + 6.5, y); paint.lineTo(x, y + 6.5); paint.closePath();
        paint.fillStyle = error.used ? theme.error : theme.paper; paint.fill();
      } else {
        paint.moveTo(x - 6, y - 6); paint.lineTo(x + 6, y + 6); paint.moveTo(x + 6, y - 6); paint.lineTo(x - 6, y + 6);
      }
      paint.stroke();
      if (i < 100) mark(x, y, error.number, error.letter, theme.error);
    });
    for (const { x, y, letter, colour, numbers } of numbered) text(letter + spans(numbers), x, y, colour);
    drawSetter();
  }

  // "1,2", "3-6": of ascending numbers, six parts at most.
  function spans(numbers) {
    const parts = [];
    for (let i = 0; i < numbers.length; ++i) {
      const first = i;
      while (i + 1 < numbers.length && numbers[i + 1] === numbers[i] + 1) ++i;
      if (i - first >= 2) parts.push(numbers[first] + "-" + numbers[i]);
      else for (let k = first; k <= i; ++k) parts.push(numbers[k]);
    }
    return parts.length > 6 ? parts.slice(0, 6).join(",") + ",\u2026" : parts.join(",");
  }

  // The axes of the machine, and a length.
  function drawScale() {
    const x = 48, y = height - 52;
    paint.globalAlpha = 1;
    paint.setLineDash([]);
    paint.font = "bold 12.5px Helvetica, Arial, sans-serif";
    paint.textAlign = "center";
    ["X", "Y", "Z"].forEach((name, i) => {
      const dx = right[i] * 30, dy = -up[i] * 30;
      paint.lineWidth = 1.8; paint.strokeStyle = paint.fillStyle = theme.dim;
      paint.beginPath(); paint.moveTo(x, y); paint.lineTo(x + dx, y + dy); paint.stroke();
      if (Math.hypot(dx, dy) > 6) paint.fillText(name, x + dx * 1.36, y + dy * 1.36 + 4);
    });
    const most = 150 / camera.zoom, power = 10 ** Math.floor(Math.log10(most)), share = most / power;
    const length = power * (share >= 5 ? 5 : share >= 2 ? 2 : 1), px = length * camera.zoom;
    paint.lineWidth = 1.6; paint.strokeStyle = theme.ink;
    paint.beginPath();
    paint.moveTo(110, height - 24); paint.lineTo(110, height - 16); paint.lineTo(110 + px, height - 16); paint.lineTo(110 + px, height - 24);
    paint.stroke();
    paint.textAlign = "left"; paint.fillStyle = theme.ink;
    paint.fillText(Number(length.toPrecision(3)) + " mm", 118 + px, height - 15);
  }

  // The error that the page is about, while its move is shown; undefined: another move.
  function failureAt(current) {
    const failed = data.fails === null ? undefined : data.errors[data.fails];
    return failed !== undefined && failed.move === current && failed.drawn ? failed : undefined;
  }
  // Where the probe stands: at the end of the move, and where the run failed at the place of that.
  function placeAt(current) {
    const failed = failureAt(current);
    return failed !== undefined ? failed.at : data.moves[current] && data.moves[current].to;
  }

  function draw(current) {
    if (width < 2 || height < 2) return;
    aim();
    drawPart();
    colours = frameColours;
    depths = frameDepths;
    colours.set(partColours);
    depths.set(partDepths);
    const move = data.moves[current];
    const stands = placeAt(current);
    if (show.probe && move !== undefined && move.drawn) drawProbe(stands, move.on, move.tool);
    paint.setTransform(1, 0, 0, 1, 0, 0);
    paint.putImageData(image, 0, 0);
    paint.setTransform(dots, 0, 0, dots, 0, 0);
    if (show.part) {
      paint.strokeStyle = theme["part-edge"]; paint.lineWidth = 0.9; paint.setLineDash([]);
      const p = part.points;
      const edges = part.edges.concat(part.borders);
      for (let i = 0; i < edges.length; i += 2) {
        const a = edges[i], b = edges[i + 1];
        const from = project(p[a], p[a + 1], p[a + 2]), to = project(p[b], p[b + 1], p[b + 2]);
        if (isHidden((from[0] + to[0]) / 2, (from[1] + to[1]) / 2, (from[2] + to[2]) / 2)) continue;
        paint.strokeStyle = i < part.edges.length ? theme["part-edge"] : theme.note;
        paint.globalAlpha = 1;
        paint.beginPath(); paint.moveTo(from[0], from[1]); paint.lineTo(to[0], to[1]); paint.stroke();
      }
    }
    drawWay(current);
    drawMarks(current);
    if (show.probe && move !== undefined && move.drawn) { // where the ball is, even behind the part
      const p = project(...stands);
      const radius = move.tool !== undefined ? move.tool.radius : data.probe === null ? 0 : data.probe.ball;
      paint.globalAlpha = radius === 0 || isHidden(p[0], p[1], p[2] + radius) ? 0.9 : 0.25;
      paint.setLineDash([]);
      paint.lineWidth = 1.6;
      paint.strokeStyle = move.on && move.tool === undefined ? "#b87400" : theme.dim;
      paint.beginPath(); paint.arc(p[0], p[1], Math.max(3, radius * camera.zoom), 0, 7); paint.stroke();
    }
    drawScale();
  }
  // Where a place of the machine is on the canvas, px.
  function where(point) {
    aim();
    return project(...point).slice(0, 2);
  }

  function resize() {
    const box = canvas.getBoundingClientRect();
    dots = Math.min(2, window.devicePixelRatio || 1);
    const w = Math.max(1, Math.round(box.width * dots)), h = Math.max(1, Math.round(box.height * dots));
    if (image !== null && image.width === w && image.height === h) return;
    canvas.width = w; canvas.height = h;
    width = w / dots; height = h / dots;
    image = paint.createImageData(w, h);
    partColours = new Uint32Array(w * h);
    partDepths = new Float32Array(w * h);
    frameColours = new Uint32Array(image.data.buffer);
    frameDepths = new Float32Array(w * h);
    if (isFitted) fit();
    partIsDrawn = false;
  }
  // The whole region in the window; as long as nobody zooms or moves, in that of another size, too.
  function fit() {
    aim();
    camera.x = camera.y = 0;
    camera.zoom = 1;
    let x = 1e-9, y = 1e-9;
    for (let i = 0; i < 8; ++i) {
      const p = project(...[0, 1, 2].map((k) => data.region[k + (i >> k & 1) * 3]));
      x = Math.max(x, Math.abs(p[0] - width / 2)); y = Math.max(y, Math.abs(p[1] - height / 2));
    }
    camera.zoom = Math.max(1e-6, Math.min((width / 2 - 24) / x, (height / 2 - 40) / y));
    isFitted = true;
    partIsDrawn = false;
  }
  function change(by) {
    Object.assign(camera, by);
    isFitted = isFitted && by.zoom === undefined && by.x === undefined;
    camera.tilt = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, camera.tilt));
    camera.zoom = Math.max(1e-6, Math.min(1e6, camera.zoom));
    partIsDrawn = false;
  }
  // Zooms by a factor about a place of the canvas.
  function zoomAt(factor, x, y) {
    const before = camera.zoom;
    change({ zoom: before * factor });
    const f = camera.zoom / before, dx = x - width / 2, dy = y - height / 2;
    change({ x: dx - (dx - camera.x) * f, y: dy - (dy - camera.y) * f });
  }
  function retheme() {
    theme = readTheme();
    partIsDrawn = false;
  }
  return { camera, show, draw, where, placeAt, failureAt, turnTo, resize, fit, change, zoomAt, retheme, redoPart: () => { partIsDrawn = false; } };
}
