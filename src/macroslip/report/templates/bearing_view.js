"use strict";
(() => {
  const SVG = "http://www.w3.org/2000/svg";
  const MISSING = 65535, TOP = 65534;

  const bytes = (text) => Uint8Array.from(atob(text), (one) => one.charCodeAt(0)).buffer;

  function element(name, options = {}, parent = null) {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(options)) {
      if (key === "text") made.textContent = value; else made.setAttribute(key, value);
    }
    if (parent) parent.append(made);
    return made;
  }

  function drawn(name, options = {}, parent = null) {
    const made = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(options)) {
      if (key === "text") made.textContent = value; else made.setAttribute(key, value);
    }
    if (parent) parent.append(made);
    return made;
  }

  function decode(data) {
    const scene = { ...data, travelled: new Float32Array(bytes(data.travelled)) };
    scene.quantities = data.quantities.map((one) => ({ ...one, codes: new Uint16Array(bytes(one.codes)) }));
    if (data.pockets) {
      const { codes, lead } = data.pockets;
      scene.pockets = { ...data.pockets, codes: new Uint16Array(bytes(codes)), lead: new Float32Array(bytes(lead)) };
    }
    return scene;
  }

  /** Three digits, never an exponent that a reader has to work out for an everyday size. */
  function shown(value) {
    const size = Math.abs(value);
    const sign = value < 0 ? "−" : "";
    if (size === 0) return "0";
    if (size >= 100) return sign + size.toFixed(0);
    if (size >= 0.001) return sign + String(Number(size.toPrecision(3)));
    return sign + size.toExponential(1);
  }

  function start(host) {
    const scenes = Object.entries(JSON.parse(host.querySelector("script.scenes").textContent));
    let scene = decode(scenes[0][1]);
    let at = scene.first, quantity = 0, chosen = { row: 0, roller: 0 }, playing = false, before = 0;

    // What the controls are.
    const controls = element("div", { class: "controls" }, host);
    const play = element("button", { type: "button", class: "play", text: "Play" }, controls);
    const label = (text, control) => { const made = element("label", { text }, controls); made.append(control); };
    const pick = element("select", { class: "scene" });
    scenes.forEach(([title], k) => element("option", { value: k, text: title }, pick));
    if (scenes.length > 1) label("Shown", pick);
    const colour = element("select", { class: "quantity" });
    scene.quantities.forEach((one, k) => element("option", { value: k, text: one.heading }, colour));
    label("Rollers coloured by", colour);
    const speed = element("select", { class: "speed" });
    [["0.01", "a hundredth"], ["0.1", "a tenth"], ["0.25", "a quarter"], ["1", "real time"], ["4", "four times"]].forEach(([value, text]) => {
      element("option", { value, text }, speed);
    });
    speed.value = "0.25";
    label("Speed", speed);
    const line = element("div", { class: "time" }, host);
    const slider = element("input", { type: "range", min: 0, step: 1, "aria-label": "time" }, line);
    const clock = element("output", {}, line);
    const scale = element("div", { class: "scale" }, host);
    const least = element("span", {}, scale);
    const bar = element("canvas", { width: 240, height: 1, "aria-hidden": "true" }, scale);
    const most = element("span", {}, scale);
    const rings = element("div", { class: "rings" }, host);
    const readout = element("p", { class: "readout", "aria-live": "polite" }, host);
    const charts = element("div", { class: "charts" }, host);
    const tip = element("div", { class: "tip", hidden: "", role: "status" }, document.body);
    let views = [], plots = [];

    const index = (row, roller, k) => (row * scene.rollers.length + roller) * scene.count + k;

    function value(q, row, roller, k) {
      const code = q.codes[index(row, roller, k)];
      if (code === MISSING) return NaN;
      const plain = q.low + (q.high - q.low) * code / TOP;
      return q.logarithmic ? 10 ** plain : plain;
    }

    function words(q, row, roller, k) {
      const code = q.codes[index(row, roller, k)];
      if (code === MISSING) return "not computed";
      if (code === 0 && q.low === 0) return `0 ${q.unit}`;
      if (q.logarithmic && code === 0) return `below ${shown(10 ** q.low)} ${q.unit}`;
      const resolution = (q.high - q.low) / TOP;
      const plain = q.low + (q.high - q.low) * code / TOP;
      if (!q.logarithmic && Math.abs(plain) < resolution) return `below ${shown(resolution)} ${q.unit}`;
      return `${shown(value(q, row, roller, k))} ${q.unit}`;
    }

    const degrees = (row, roller, time) => {
      const k = Math.min(Math.floor(time), scene.count - 1), next = Math.min(k + 1, scene.count - 1);
      const turned = scene.travelled[k] + (scene.travelled[next] - scene.travelled[k]) * (time - k);
      return (((scene.angle[row][roller] + turned) % 360) + 360) % 360;
    };

    /** Between samples, so that slow motion moves evenly. */
    function between(read) {
      const k = Math.min(Math.floor(at), scene.count - 1), next = Math.min(k + 1, scene.count - 1);
      const first = read(k);
      return first + (read(next) - first) * (at - k);
    }

    /** Way of a roller ahead of the middle of its pocket as drawn, and angle of its cage ahead of pure rolling [degrees]. */
    function pocketed(row, roller) {
      const { reach, enlarged, codes, lead } = scene.pockets;
      const offset = between((k) => {
        const code = codes[index(row, roller, k)];
        return code === MISSING ? 0 : reach * (2 * code / TOP - 1);
      });
      return { way: enlarged * offset, lead: between((k) => lead[row * scene.count + k]) };
    }

    const name = (row, roller) => `${scene.rows[row]} roller ${scene.rollers[roller]}`;

    function told(row, roller, k) {
      const parts = scene.quantities.map((q) => `${q.heading.toLowerCase()} ${words(q, row, roller, k)}`);
      return [`${name(row, roller)}, ${degrees(row, roller, k).toFixed(0)}° from the bottom`, ...parts];
    }

    function part(q, row, roller, k) {
      const code = q.codes[index(row, roller, k)];
      if (code === MISSING) return NaN;
      return q.low < 0 && !q.logarithmic ? Math.abs(2 * code / TOP - 1) : code / TOP;
    }

    function tint(share) {
      if (Number.isNaN(share)) return "none";
      const ramp = scene.colours, x = share * (ramp.length - 1), k = Math.min(Math.floor(x), ramp.length - 2);
      const mixed = ramp[k].map((low, n) => Math.round(low + (ramp[k + 1][n] - low) * (x - k)));
      return `rgb(${mixed.join(",")})`;
    }

    function build() {
      slider.max = scene.count - 1;
      rings.replaceChildren();
      const { roller, pitch, inner, outer } = scene.radii;
      const reach = outer + 2.6 * roller;
      views = scene.rows.map((title, row) => {
        const holder = element("div", {}, rings);
        element("h4", { text: `${title} row, looking downwind; spokes: load` }, holder);
        const svg = drawn("svg", {
          viewBox: `${-reach} ${-reach} ${2 * reach} ${2 * reach}`, tabindex: 0, role: "application",
          "aria-label": `${title} row; left and right arrow keys choose a roller, space plays`,
        }, holder);
        drawn("circle", { class: "ring", r: inner }, svg);
        drawn("circle", { class: "ring", r: outer }, svg);
        [["top", 0, -inner * 0.86], ["bottom", 0, inner * 0.93], ["left", -inner * 0.83, 0], ["right", inner * 0.8, 0]]
          .forEach(([text, x, y]) => drawn("text", { x, y, text, "text-anchor": "middle", style: `font-size:${0.055 * reach}px` }, svg));
        const note = drawn("text", { x: 0, y: 0, "text-anchor": "middle", style: `font-size:${0.055 * reach}px` }, svg);
        const loads = scene.rollers.map(() => drawn("line", { class: "load" }, svg));
        const pockets = !scene.pockets ? [] : scene.rollers.map(() => {
          const group = drawn("g", { class: "pocket" }, svg);
          const gap = roller + scene.pockets.enlarged * scene.pockets.reach;
          const spars = [-1, 1].map((side) => drawn("line", {
            class: "spar", x1: side * gap, x2: side * gap, y1: -0.75 * roller, y2: 0.75 * roller,
            stroke: "currentColor", "stroke-width": 0.06 * roller,
          }, group));
          const flashes = [-1, 1].map((side) => drawn("circle", { class: "flash", cx: side * gap, r: 0, fill: "#d1495b" }, group));
          return { group, spars, flashes };
        });
        if (scene.pockets) drawn("circle", {
          class: "cage", r: pitch, fill: "none", stroke: "currentColor", "stroke-width": 0.04 * roller,
          "stroke-dasharray": `${0.2 * roller} ${0.2 * roller}`,
        }, svg);
        const rollers = scene.rollers.map((number, k) => drawn("circle", {
          class: "roller", r: roller, "data-row": title, "data-roller": number, "data-index": k,
        }, svg));
        const nearest = (event) => {
          const box = svg.getBoundingClientRect(), unit = 2 * reach / box.width;
          const x = (event.clientX - box.left) * unit - reach, y = (event.clientY - box.top) * unit - reach;
          let best = -1, distance = 1.6 * roller;
          scene.rollers.forEach((_, k) => {
            const angle = degrees(row, k, at) * Math.PI / 180;
            const far = Math.hypot(x + pitch * Math.sin(angle), y - pitch * Math.cos(angle));
            if (far < distance) { best = k; distance = far; }
          });
          return best;
        };
        svg.addEventListener("pointermove", (event) => {
          const k = nearest(event);
          if (k < 0) return hide();
          say(event, told(row, k, Math.round(at)));
        });
        svg.addEventListener("pointerleave", hide);
        svg.addEventListener("click", (event) => {
          const k = nearest(event);
          if (k >= 0) choose(row, k);
        });
        svg.addEventListener("keydown", (event) => {
          const move = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
          if (event.key === " ") { event.preventDefault(); toggle(); }
          if (!move) return;
          event.preventDefault();
          const count = scene.rollers.length;
          choose(row, chosen.row === row ? (chosen.roller + move + count) % count : 0);
        });
        return { svg, rollers, loads, note, row, pockets };
      });
      charts.replaceChildren();
      plots = scene.quantities.map((q) => {
        const holder = element("div", { class: "chart" }, charts);
        const title = element("h4", {}, holder);
        const svg = drawn("svg", { viewBox: "0 0 1000 100", preserveAspectRatio: "none", role: "img" }, holder);
        [0.5, 50, 99.5].forEach((y) => drawn("line", { class: "grid", x1: 0, x2: 1000, y1: y, y2: y }, svg));
        const trace = drawn("path", { class: "trace" }, svg);
        const cursor = drawn("line", { class: "cursor", y1: 0, y2: 100 }, svg);
        const under = element("div", { class: "ends" }, holder);
        element("span", { text: `${shown(scene.start)} s` }, under);
        element("span", { text: `${shown(scene.start + (scene.count - 1) * scene.step)} s` }, under);
        const sample = (event) => {
          const box = svg.getBoundingClientRect();
          const share = Math.min(1, Math.max(0, (event.clientX - box.left) / box.width));
          return Math.round(share * (scene.count - 1));
        };
        svg.addEventListener("pointermove", (event) => {
          const k = sample(event);
          say(event, [`${name(chosen.row, chosen.roller)} at ${(scene.start + k * scene.step).toFixed(2)} s`,
            `${q.heading.toLowerCase()} ${words(q, chosen.row, chosen.roller, k)}`]);
          if (event.buttons) go(k);
        });
        svg.addEventListener("pointerdown", (event) => go(sample(event)));
        svg.addEventListener("pointerleave", hide);
        return { q, title, svg, trace, cursor };
      });
      choose(0, 0);
      recolour();
    }

    function say(event, lines) {
      tip.textContent = lines.join("\n");
      tip.hidden = false;
      const width = tip.offsetWidth, height = tip.offsetHeight;
      tip.style.left = `${Math.max(4, Math.min(event.clientX + 14, document.documentElement.clientWidth - width - 4))}px`;
      tip.style.top = `${event.clientY + 18 + height > window.innerHeight ? event.clientY - height - 10 : event.clientY + 18}px`;
    }

    function hide() { tip.hidden = true; }

    function choose(row, roller) {
      chosen = { row, roller };
      plots.forEach(({ q, title, svg, trace }) => {
        let low = Infinity, high = -Infinity, path = "", pen = "M";
        for (let k = 0; k < scene.count; k += 1) {
          const code = q.codes[index(row, roller, k)];
          if (code === MISSING) continue;
          low = Math.min(low, code); high = Math.max(high, code);
        }
        const span = high > low ? high - low : 1;
        for (let k = 0; k < scene.count; k += 1) {
          const code = q.codes[index(row, roller, k)];
          if (code === MISSING) { pen = "M"; continue; }
          path += `${pen}${(1000 * k / Math.max(1, scene.count - 1)).toFixed(1)} ${(97 - 94 * (code - low) / span).toFixed(1)}`;
          pen = "L";
        }
        trace.setAttribute("d", path);
        const plain = (code) => q.low + (q.high - q.low) * code / TOP;
        const real = (code) => shown(q.logarithmic ? 10 ** plain(code) : Math.abs(plain(code)) < (q.high - q.low) / TOP ? 0 : plain(code));
        const range = high >= low ? `from ${real(low)} to ${real(high)} ${q.unit}` : "not computed";
        title.textContent = `${q.heading} of ${name(row, roller)}, ${range}${q.logarithmic ? ", logarithmic" : ""}`;
        svg.setAttribute("aria-label", title.textContent);
      });
      update();
    }

    function recolour() {
      const q = scene.quantities[quantity];
      const context = bar.getContext("2d");
      for (let x = 0; x < bar.width; x += 1) {
        context.fillStyle = tint(x / (bar.width - 1));
        context.fillRect(x, 0, 1, 1);
      }
      least.textContent = `${q.logarithmic ? `${shown(10 ** q.low)} ` : "0 "}${q.unit}`;
      most.textContent = `${shown(q.logarithmic ? 10 ** q.high : q.high)} ${q.unit}${q.logarithmic ? ", logarithmic" : ""}`
        + `${q.low < 0 && !q.logarithmic ? ", without sign" : ""}`;
      update();
    }

    function update() {
      const k = Math.round(at), q = scene.quantities[quantity], load = scene.quantities[1];
      const { roller, pitch, outer } = scene.radii;
      const force = scene.pockets ? scene.quantities[scene.pockets.force] : null;
      views.forEach(({ row, rollers, loads, note, pockets }) => {
        let total = 0;
        rollers.forEach((circle, n) => {
          let angle = degrees(row, n, at) * Math.PI / 180;
          if (scene.pockets) {
            const { way, lead } = pocketed(row, n);
            angle += lead * Math.PI / 180;
            const { group, flashes } = pockets[n], push = value(force, row, n, k) || 0;
            const x = -pitch * Math.sin(angle), y = pitch * Math.cos(angle);
            group.setAttribute("transform", `translate(${x.toFixed(2)} ${y.toFixed(2)}) rotate(${(angle * 180 / Math.PI + 180).toFixed(3)})`);
            // A push along the orbit comes from the spar behind; a flash grows with the decades of the force.
            const size = Math.abs(push) > 1 ? 0.12 * roller * (1 + Math.log10(Math.abs(push))) : 0;
            flashes[0].setAttribute("r", push > 0 ? size : 0);
            flashes[1].setAttribute("r", push < 0 ? size : 0);
            angle += way / pitch;
          }
          const sine = Math.sin(angle), cosine = Math.cos(angle);
          circle.setAttribute("transform", `translate(${(-pitch * sine).toFixed(2)} ${(pitch * cosine).toFixed(2)})`);
          circle.setAttribute("fill", tint(part(q, row, n, k)));
          circle.classList.toggle("chosen", chosen.row === row && chosen.roller === n);
          const share = part(load, row, n, k) || 0, from = outer + 6, to = from + 2.3 * roller * share;
          loads[n].setAttribute("x1", -from * sine); loads[n].setAttribute("y1", from * cosine);
          loads[n].setAttribute("x2", -to * sine); loads[n].setAttribute("y2", to * cosine);
          total += value(load, row, n, k) || 0;
        });
        note.textContent = `loads add up to ${shown(total)} ${load.unit}`;
      });
      const seconds = `${(scene.start + at * scene.step).toFixed(2)} s`;
      slider.value = k;
      slider.setAttribute("aria-valuetext", seconds);
      clock.textContent = seconds;
      readout.textContent = `${told(chosen.row, chosen.roller, k).join("; ")}.`;
      const x = 1000 * at / Math.max(1, scene.count - 1);
      plots.forEach(({ cursor }) => { cursor.setAttribute("x1", x); cursor.setAttribute("x2", x); });
    }

    function go(k) { at = Math.min(Math.max(0, k), scene.count - 1); update(); }

    function frame(now) {
      if (!playing) return;
      const last = scene.count - 1;
      at += (now - before) / 1000 * Number(speed.value) / scene.step;
      before = now;
      if (at >= last) { at = last; toggle(); }
      update();
      requestAnimationFrame(frame);
    }

    function toggle() {
      playing = !playing && scene.count > 1;
      play.textContent = playing ? "Pause" : "Play";
      // Sixty announcements a second help nobody.
      readout.setAttribute("aria-live", playing ? "off" : "polite");
      if (!playing) return;
      if (at >= scene.count - 1) at = 0;
      before = performance.now();
      requestAnimationFrame(frame);
    }

    play.addEventListener("click", toggle);
    slider.addEventListener("input", () => go(Number(slider.value)));
    colour.addEventListener("change", () => { quantity = Number(colour.value); recolour(); });
    pick.addEventListener("change", () => { scene = decode(scenes[Number(pick.value)][1]); at = scene.first; build(); });
    window.addEventListener("scroll", hide, { passive: true });
    build();
  }

  document.querySelectorAll("[data-view]").forEach(start);
})();
