// Put after a page of `--html` by page-in-chromium.sh: uses the page as a reader would and writes what it found
// into #result. What the page shows is held against the data in its file, not against its own variables.
"use strict";

(async () => {
  const byId = (id) => document.getElementById(id);
  const data = JSON.parse(byId("data").textContent);
  const count = data.way.length / 6, faults = [], shown = [], pixels = new Set();
  const expect = (holds, what) => { if (!holds) faults.push(what); };
  const painted = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
  const numbers = () => ["x", "y", "z"].map((id) => byId(id).textContent);
  // At the end of the move, of the one that failed at the place of that.
  const failed = data.fails === null || data.errors[data.fails].slice(0, 3).includes(null) ? null : data.errors[data.fails];
  const wanted = (i) => failed !== null && failed[3] === i ? failed.slice(0, 3) : data.way.slice(i * 6 + 3, i * 6 + 6);
  // With the decimals of the control, and as near as they allow.
  const isNumber = (text, value) => new RegExp("^-?[0-9]+" + (data.decimals > 0 ? "[.][0-9]{" + data.decimals + "}" : "") + "$").test(text) &&
    Math.abs(Number(text) - value) <= 0.5 * 10 ** -data.decimals + 1e-9 && !/^-0[.]?0*$/.test(text);
  const frameOf = (i) => {
    const found = data.framed.find(([first, length]) => i >= first && i < first + length);
    return found === undefined ? undefined : data.frames[found[2]];
  };
  const check = (i, how) => {
    const unknown = frameOf(i) === undefined ? 0 : frameOf(i)[4];
    const fits = (text, value, k) => value === null || Number.isNaN(value) || (unknown >> k & 1) === 1 ? text === "?" : isNumber(text, value);
    expect(numbers().every((text, k) => fits(text, wanted(i)[k], k)), how + ": move " + i + " shows " + numbers() + ", not " + wanted(i));
    const frame = frameOf(i);
    if (frame !== undefined) {
      const work = ["x", "y", "z"].map((id) => byId("work-" + id).textContent);
      const span = data.spindle.find((s) => i >= s[0] && i < s[0] + s[1]); // another tool
      const length = span !== undefined ? data.tools[span[2]][1] : data.probe === null ? 0 : data.probe.length;
      const meant = wanted(i).map((v, k) => v === null || frame[k + 1] === null ? null : v + (k === 2 ? length : 0) - frame[k + 1]);
      expect(work.every((text, k) => fits(text, meant[k], k)), how + ": work coordinates " + work + ", not " + meant);
      expect(byId("work-name").textContent.endsWith(frame[0]), how + ": name of the work coordinates");
    }
    expect(byId("kind").textContent === data.kinds[data.way[i * 6]].name, how + ": kind of move " + i);
    expect(byId("power").textContent === (data.way[i * 6 + 1] ? "on" : "off"), how + ": probe at move " + i);
    expect((byId("position-name").textContent === "Position") === (failed === null || failed[3] !== i), how + ": " + byId("position-name").textContent);
    const row = document.querySelector("#blocks .current");
    expect(row !== null && Number(row.dataset.block) === data.way[i * 6 + 2], how + ": block of move " + i);
  };
  const hash = () => {
    const canvas = byId("view"), dots = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
    let sum = 0;
    for (let i = 0; i < dots.length; ++i) sum = (sum * 31 + dots[i]) % 4294967291;
    return sum;
  };
  try {
    expect(count > 3, "the page has no moves to step through");
    expect(window.dotek.moves.length === count, "dotek.moves");
    expect(Number(byId("slider").max) === count - 1, "the slider's end");
    await painted();

    // As it opens: at the end, or at the miss it ended with, with how the run went, nothing wider than the window, the path in full colour.
    const opens = data.opens === null ? count - 1 : data.opens;
    check(opens, "opening");
    expect(Number(byId("slider").value) === opens, "the page does not open at the end of the run, or at its last miss");
    const widest = document.documentElement.scrollWidth;
    expect(widest <= window.innerWidth, "the page is " + widest + " px wide in a window of " + window.innerWidth);
    const banner = byId("banner");
    if (banner !== null) {
      const box = banner.getBoundingClientRect();
      expect(box.top >= 0 && box.top < 5 && box.height > 30 && box.width > window.innerWidth - 40, "the banner is not at the top");
      expect(banner.querySelector("strong").textContent.length > 3, "the banner says nothing");
      expect(getComputedStyle(banner).color === "rgb(255, 255, 255)", "colour of the banner's text");
    }
    expect(byId("projection").textContent.startsWith("parallel projection"), "the projection is not named");
    const root = getComputedStyle(document.documentElement);
    const hasColour = (name) => {
      const hex = root.getPropertyValue("--" + name).trim(), wantedColour = [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
      const canvas = byId("view"), dots = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
      for (let i = 0; i < dots.length; i += 4)
        if (wantedColour.every((c, k) => Math.abs(dots[i + k] - c) < 24)) return true;
      return false;
    };
    const tickProbe = (checked) => { byId("show-probe").checked = checked; byId("show-probe").dispatchEvent(new Event("change")); };
    tickProbe(false);
    for (const past of [true, false]) {
      window.dotek.go(past ? count - 1 : 0);
      await painted();
      for (const kind of new Set(window.dotek.moves.filter((m) => m.drawn).map((m) => m.kind))) {
        const length = Math.max(...window.dotek.moves.filter((m) => m.kind === kind && m.drawn).map((m) => Math.hypot(...m.to.map((v, k) => v - m.from[k]))));
        if (length * window.dotek.camera.zoom > 30)
          expect(hasColour(data.kinds[kind].name), data.kinds[kind].name + " moves are not in full colour " + (past ? "at the end" : "at the start"));
      }
    }
    tickProbe(true);
    const zoomed = window.dotek.camera.zoom;
    byId("zoom-in").click();
    expect(window.dotek.camera.zoom > zoomed * 1.2, "+ does not zoom in");
    byId("zoom-out").click(); byId("zoom-out").click();
    expect(window.dotek.camera.zoom < zoomed * 0.9, "- does not zoom out");
    byId("fit").click();
    expect(Math.abs(window.dotek.camera.zoom / zoomed - 1) < 1e-6 && window.dotek.camera.x === 0, "Fit does not bring the view back");
    const programs = [...document.querySelectorAll("#blocks .program")].map((row) => row.textContent);
    if (data.blocks[0][2] !== "") {
      byId("blocks").scrollTop = 0;
      byId("blocks").dispatchEvent(new Event("scroll"));
      expect(document.querySelector("#blocks .program") !== null, "the list of blocks has no names of programs: " + programs);
    }

    let places = 0, before = null;
    const steps = Math.min(count, 40);
    for (let k = 0; k < steps; ++k) {
      const i = Math.floor(k * (count - 1) / (steps - 1));
      byId("slider").value = i;
      byId("slider").dispatchEvent(new Event("input"));
      check(i, "slider");
      shown.push([i, ...numbers(), ...["x", "y", "z"].map((id) => byId("gauge-" + id).textContent)]);
      const place = window.dotek.state().drawnAt;
      if (before !== null && place !== null && Math.hypot(place[0] - before[0], place[1] - before[1]) > 0.5) ++places;
      before = place;
      await painted();
      pixels.add(hash());
    }
    expect(places > 0, "the slider does not move the probe");
    expect(pixels.size > steps / 3, "the slider does not change the view: " + pixels.size + " views of " + steps);

    window.dotek.go(1);
    document.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight" }));
    check(2, "key right");
    document.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft" }));
    check(1, "key left");
    byId("last").click();
    check(count - 1, "button End");
    window.dotek.go(0);
    const last = data.way[count * 6 - 4], row = document.querySelector('#blocks .row[data-block="' + last + '"]');
    if (row !== null) { // in sight
      row.click();
      let first = 0;
      while (data.way[first * 6 + 2] !== last) ++first;
      check(first, "click on a block");
    }
    expect(byId("errors").children.length === data.errors.length, "the list of errors");
    if (data.errors.length > 0) {
      window.dotek.go(0);
      byId("errors").querySelector("button").click();
      check(data.errors[0][3], "click on an error");
    }

    for (const button of [...document.querySelectorAll("#measured button")].slice(0, 10)) {
      button.click();
      check(Number(button.dataset.move), "click on a measured feature");
    }

    const canvas = byId("view"), still = hash();
    const pointer = (name, x, y) => canvas.dispatchEvent(new PointerEvent(name, { clientX: x, clientY: y, pointerId: 1, button: 0 }));
    canvas.setPointerCapture = () => {}; // of a pointer that is none
    pointer("pointerdown", 300, 300); pointer("pointermove", 360, 320); pointer("pointerup", 360, 320);
    await painted();
    const turned = hash();
    expect(turned !== still, "dragging does not turn the view");
    canvas.dispatchEvent(new WheelEvent("wheel", { deltaY: -240, clientX: 300, clientY: 300 }));
    await painted();
    expect(hash() !== turned, "the wheel does not zoom");
    const finger = (name, id, x, y) => canvas.dispatchEvent(new PointerEvent(name, { clientX: x, clientY: y, pointerId: id, button: 0, pointerType: "touch" }));
    const apart = window.dotek.camera.zoom, turn = window.dotek.camera.turn;
    finger("pointerdown", 7, 250, 300); finger("pointerdown", 8, 350, 300);
    finger("pointermove", 7, 200, 300); finger("pointermove", 8, 400, 300);
    finger("pointerup", 7, 200, 300); finger("pointerup", 8, 400, 300);
    expect(Math.abs(window.dotek.camera.zoom / apart - 2) < 0.01, "two fingers twice as far apart zoom by " + window.dotek.camera.zoom / apart);
    expect(window.dotek.camera.turn === turn, "two fingers turn the view");

    // The ball, lit while the probe is on: near by, and with nothing before it.
    const box = canvas.getBoundingClientRect();
    const isInSight = (i) => {
      window.dotek.go(i);
      const at = window.dotek.state().drawnAt;
      return at !== null && at[0] > 0 && at[1] > 0 && at[0] < box.width && at[1] < box.height;
    };
    let on = data.probe === null ? count : 0;
    while (on < count && !(data.way[on * 6 + 1] === 1 && isInSight(on))) ++on;
    if (on < count) {
      const tick = (id, checked) => { byId(id).checked = checked; byId(id).dispatchEvent(new Event("change")); };
      tick("show-part", false);
      window.dotek.go(on);
      for (let i = 0; i < 5; ++i) {
        const [x, y] = window.dotek.state().drawnAt;
        canvas.dispatchEvent(new WheelEvent("wheel", { deltaY: -300, clientX: box.left + x, clientY: box.top + y }));
      }
      const lit = () => {
        const { data: dots, width } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
        let sum = 0, x = 0, y = 0;
        for (let i = 0; i < dots.length; i += 4) {
          if (dots[i] < 205 || dots[i + 1] < 110 || dots[i + 2] > 80) continue;
          ++sum;
          x += i / 4 % width;
          y += Math.floor(i / 4 / width);
        }
        return { sum, x: x / sum * box.width / canvas.width, y: y / sum * box.width / canvas.width };
      };
      await painted();
      const ball = lit(), at = window.dotek.state().drawnAt;
      expect(ball.sum > 20, "the ball is not drawn: " + ball.sum + " dots of it");
      const off = Math.hypot(ball.x - at[0], ball.y - at[1]);
      expect(off < 2 + 2 * Math.sqrt(ball.sum), "the ball is drawn " + off + " px from its place");
      tick("show-probe", false);
      await painted();
      expect(lit().sum < ball.sum / 4, "the probe cannot be hidden");
    }
    expect(byId("fault").textContent === "", "script error: " + byId("fault").textContent);
  } catch (error) {
    faults.push(String(error.stack));
  }
  const result = document.createElement("pre");
  result.id = "result";
  result.textContent = JSON.stringify({ faults, width: window.innerWidth, views: pixels.size, shown });
  document.body.append(result);
  if (window.parent !== window) window.parent.postMessage(result.textContent, "*");
})();
