"use strict";
(() => {
  const data = JSON.parse(document.getElementById("family-data").textContent);
  const byId = (id) => document.getElementById(id);
  const floats = (text) => {
    const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    return new Float32Array(bytes.buffer, 0, bytes.length >> 2);
  };
  const kParameters = 5;  // omega_hz, xi, N, M, tau_s
  const count = data.experiments.length;
  const values = floats(data.parameters);
  const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const colours = { member: "#D55E00", fit: () => css("--blue"), data: "#009E73", other: "#8c8c8c" };
  const measured = (e) => Boolean(e.frequency_hz);
  const any = (key) => data.experiments.some((e) => e[key]);
  let experiment = data.experiments.findIndex((e) => measured(e) && e.reliable);
  if (experiment < 0) experiment = Math.max(0, data.experiments.findIndex(measured));
  let member = 0;

  // The model: the paper, section 3. Complex numbers are pairs [re, im].

  const modelOf = (m, e) => {
    const at = (m * count + e) * kParameters;
    return { omega: values[at], xi: values[at + 1], N: values[at + 2], M: values[at + 3],
             tau: values[at + 4] };
  };
  const fitOf = (e) => {
    const fit = data.experiments[e].fit;
    return fit ? { omega: fit[0], xi: fit[1], N: fit[2], M: fit[3], tau: fit[4] } : null;
  };
  const mul = (a, b) => [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]];
  const div = (a, b) => {
    const d = b[0] * b[0] + b[1] * b[1];
    return [(a[0] * b[0] + a[1] * b[1]) / d, (a[1] * b[0] - a[0] * b[1]) / d];
  };
  const abs = (a) => Math.hypot(a[0], a[1]);
  const degrees = (a) => Math.atan2(a[1], a[0]) * 180 / Math.PI;
  // G(s) at complex s in rad/s.
  const acoustics = (model, s) => {
    let sum = [0, 0];
    for (const [weight, ratio] of [[model.N, 1], [model.M, data.harmonic_ratio]]) {
      if (weight === 0) continue;
      const w = 2 * Math.PI * ratio * model.omega;
      const s2 = mul(s, s);
      const below = [s2[0] + 2 * w * model.xi * s[0] + w * w, s2[1] + 2 * w * model.xi * s[1]];
      const term = div([weight * s[0], weight * s[1]], below);
      sum = [sum[0] + term[0], sum[1] + term[1]];
    }
    return sum;
  };
  const gainAt = (model, f) => acoustics(model, [0, 2 * Math.PI * f]);
  // L(s) = s G(s) e^(-tau s)
  const loop = (model, s) => {
    const size = Math.exp(-model.tau * s[0]);
    const turn = [size * Math.cos(model.tau * s[1]), -size * Math.sin(model.tau * s[1])];
    return mul(mul(s, acoustics(model, s)), turn);
  };
  const loopAt = (model, f) => loop(model, [0, 2 * Math.PI * f]);
  const slopeOf = (e) => data.experiments[e].flame_slope;
  const responseOf = (model, e) => abs(loopAt(model, data.experiments[e].frequency_hz[0]));
  // Of Nyquist's curve: as measured, whatever loop gain that makes; where it was not, the one that
  // closes the loop at the measured frequency with gain one.
  const drawnSlope = (model, e) => slopeOf(e) === null ? -1 / responseOf(model, e) : slopeOf(e);
  // Of a time course, as simulate takes it: raised where the loop would not cycle although a cycle
  // was observed.
  const runningSlope = (model, e) => {
    const response = responseOf(model, e);
    const slope = slopeOf(e) === null ? 0 : slopeOf(e);
    return Math.abs(slope) * response < data.loop_gain_min ? -data.loop_gain_min / response : slope;
  };
  // Root of 1 - k L(s) = 0 next to the limit cycle: its real part is the growth rate at rest.
  const growthRate = (model, e) => {
    const k = slopeOf(e);
    if (k === null) return NaN;
    const balance = (s) => { const l = loop(model, s); return [1 - k * l[0], -k * l[1]]; };
    let s = [0, 2 * Math.PI * data.experiments[e].frequency_hz[0]];
    for (let i = 0; i < 60; ++i) {
      const h = 1e-4 * Math.max(1, abs(s));
      const value = balance(s);
      const up = balance([s[0] + h, s[1]]);
      const down = balance([s[0] - h, s[1]]);
      const step = div(value, [(up[0] - down[0]) / (2 * h), (up[1] - down[1]) / (2 * h)]);
      s = [s[0] - step[0], s[1] - step[1]];
      if (abs(step) < 1e-9 * abs(s)) return s[0];
    }
    return NaN;
  };
  // Crossings of the negative real axis up to maxHz: frequencies, by bisection of a fine scan.
  const crossings = (model, maxHz) => {
    const found = [];
    const step = maxHz / 1500;
    let last = loopAt(model, step / 2);
    for (let f = step * 1.5; f < maxHz; f += step) {
      const here = loopAt(model, f);
      if (here[0] < 0 && last[0] < 0 && here[1] * last[1] <= 0) {
        let lo = f - step;
        let hi = f;
        for (let i = 0; i < 40; ++i) {
          const mid = 0.5 * (lo + hi);
          if (loopAt(model, mid)[1] * last[1] > 0) lo = mid; else hi = mid;
        }
        found.push(0.5 * (lo + hi));
      }
      last = here;
    }
    return found;
  };
  const shapes = {
    tanh: Math.tanh,
    arctan: (x) => 2 / Math.PI * Math.atan(Math.PI / 2 * x),
    cubic: (x) => { const y = Math.max(-1.5, Math.min(1.5, x)); return y - 4 / 27 * y * y * y; },
    piecewise_linear: (x) => Math.max(-1, Math.min(1, x)),
    algebraic: (x) => x / Math.sqrt(1 + x * x)
  };
  const shape = shapes[data.flame_shape] || Math.tanh;

  // The loop in time, without noise, from a small oscillation on until it has settled: Runge-Kutta
  // of order four, the delayed rate between steps by cubic interpolation.
  const timeCourse = (model, e, duration) => {
    const f = data.experiments[e].frequency_hz[0];
    const perDelay = Math.max(24, Math.ceil(model.tau * f * 80));
    const h = model.tau / perDelay;
    const slope = runningSlope(model, e);
    const flame = (rate) => data.saturation * shape(slope * rate / data.saturation);
    const modes = [[model.N, 2 * Math.PI * model.omega],
                   [model.M, 2 * Math.PI * data.harmonic_ratio * model.omega]]
        .filter((mode) => mode[0] !== 0);
    const settle = Math.min(1.0, 80 / f);
    const steps = Math.ceil((settle + duration) / h);
    const rate = new Float64Array(steps + perDelay + 3);
    const amplitude = 0.7 * data.saturation / Math.abs(slope);
    for (let i = 0; i <= perDelay + 1; ++i) {
      rate[i] = amplitude * Math.sin(2 * Math.PI * f * (i - perDelay) * h);
    }
    const state = modes.map(() => [0, 0]);
    const times = [];
    const pressure = [];
    const heat = [];
    const slopeOfMode = (mode, y, v, q) => q - 2 * mode[1] * model.xi * v - mode[1] * mode[1] * y;
    for (let n = 0; n < steps; ++n) {
      const q0 = flame(rate[n]);
      const mid = n > 0 ? (-rate[n - 1] + 9 * rate[n] + 9 * rate[n + 1] - rate[n + 2]) / 16
                        : 0.5 * (rate[n] + rate[n + 1]);
      const qm = flame(mid);
      const q1 = flame(rate[n + 1]);
      let p = 0;
      let next = 0;
      modes.forEach((mode, k) => {
        const [y, v] = state[k];
        p += mode[0] * v;
        const a1 = slopeOfMode(mode, y, v, q0);
        const a2 = slopeOfMode(mode, y + 0.5 * h * v, v + 0.5 * h * a1, qm);
        const v2 = v + 0.5 * h * a1;
        const v3 = v + 0.5 * h * a2;
        const a3 = slopeOfMode(mode, y + 0.5 * h * v2, v3, qm);
        const v4 = v + h * a3;
        const a4 = slopeOfMode(mode, y + h * v3, v4, q1);
        state[k] = [y + h / 6 * (v + 2 * v2 + 2 * v3 + v4), v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)];
        next += mode[0] * slopeOfMode(mode, state[k][0], state[k][1], q1);
      });
      rate[n + perDelay + 1] = next;
      if (n * h >= settle) {
        times.push(n * h - settle);
        pressure.push(p);
        heat.push(q0);
      }
    }
    return { times, pressure, heat };
  };

  // Complex amplitude at f of samples at times, by least squares over whole cycles.
  const fundamental = (times, samples, f) => {
    const span = Math.floor((times[times.length - 1] - times[0]) * f) / f;
    let sum = [0, 0];
    let used = 0;
    for (let i = 0; i < times.length && times[i] - times[0] < span; ++i, ++used) {
      const angle = 2 * Math.PI * f * times[i];
      sum = [sum[0] + samples[i] * Math.cos(angle), sum[1] - samples[i] * Math.sin(angle)];
    }
    return [2 * sum[0] / used, 2 * sum[1] / used];
  };
  const cycleFrequency = (times, samples) => {
    const up = [];
    for (let i = 1; i < samples.length; ++i) {
      if (samples[i - 1] < 0 && samples[i] >= 0) {
        const part = samples[i - 1] / (samples[i - 1] - samples[i]);
        up.push(times[i - 1] + part * (times[i] - times[i - 1]));
      }
    }
    return up.length > 2 ? (up.length - 1) / (up[up.length - 1] - up[0]) : NaN;
  };

  // Members along the trade-off.

  const spread = new Float64Array(data.members);
  const xiMax = new Float64Array(data.members);
  for (let m = 0; m < data.members; ++m) {
    let low = Infinity;
    let high = 0;
    for (let e = 0; e < count; ++e) {
      const model = modelOf(m, e);
      low = Math.min(low, model.omega);
      high = Math.max(high, model.omega);
      xiMax[m] = Math.max(xiMax[m], model.xi);
    }
    spread[m] = 100 * (high / low - 1);
  }
  const order = Array.from(spread.keys()).sort((a, b) => spread[a] - spread[b] || xiMax[a] - xiMax[b]);
  const place = new Int32Array(data.members);
  order.forEach((m, k) => { place[m] = k; });

  // Plots.

  const axis = (label, more) => ({
    label, stroke: () => css("--ink"), labelSize: 22, font: "12px sans-serif",
    labelFont: "12px sans-serif", grid: { stroke: () => css("--line"), width: 1 },
    ticks: { stroke: () => css("--line"), width: 1, size: 5 }, ...more
  });
  const short = (v) => v === null || v === undefined || !isFinite(v) ? "–"
      : Math.abs(v) >= 1e5 || (v !== 0 && Math.abs(v) < 1e-3) ? v.toExponential(3)
      : String(+v.toPrecision(5));
  // A curve that no experiment has is not in the legend.
  const ifThere = (there) => there ? {} : { class: "absent" };
  const plots = [];
  const plotHeight = 300;
  const make = (id, options, start) => {
    const box = byId(id);
    const plot = new uPlot({ width: Math.max(260, box.clientWidth), height: plotHeight,
                             ...options }, start, box);
    plots.push([plot, box]);
    return plot;
  };
  // In pixels of the canvas, of curve `s` of a plot whose curves have x of their own.
  const linePath = (u, s) => {
    const [xs, ys] = u.data[s];
    const path = new Path2D();
    for (let i = 0; i < xs.length; ++i) {
      const x = u.valToPos(xs[i], "x", true);
      const y = u.valToPos(ys[i], "y", true);
      if (i === 0) path.moveTo(x, y); else path.lineTo(x, y);
    }
    return { stroke: path, clip: boxOf(u) };
  };
  const boxOf = (u) => {
    const clip = new Path2D();
    clip.rect(u.bbox.left, u.bbox.top, u.bbox.width, u.bbox.height);
    return clip;
  };
  const dotPath = (size) => (u, s) => {
    const [xs, ys] = u.data[s];
    const path = new Path2D();
    const half = size * devicePixelRatio / 2;
    for (let i = 0; i < xs.length; ++i) {
      const x = u.valToPos(xs[i], "x", true);
      const y = u.valToPos(ys[i], "y", true);
      path.moveTo(x + half, y);
      path.arc(x, y, half, 0, 2 * Math.PI);
    }
    return { fill: path, stroke: path, clip: boxOf(u) };
  };
  const freeCurve = (label, stroke, paths, more) => ({
    label, stroke, paths, points: { show: false },
    facets: [{ scale: "x", auto: false }, { scale: "y", auto: false }], ...more
  });
  const nearest = (u, s, left, top) => {
    const [xs, ys] = u.data[s];
    let best = -1;
    let least = Infinity;
    for (let i = 0; i < xs.length; ++i) {
      const dx = u.valToPos(xs[i], "x") - left;
      const dy = u.valToPos(ys[i], "y") - top;
      const distance = dx * dx + dy * dy;
      if (distance < least) { least = distance; best = i; }
    }
    return best;
  };
  const freeCursor = { drag: { x: false, y: false }, points: { show: false }, dataIdx: () => null };

  // Every member is inside; the curve, which runs away where omega is held constant, may leave.
  const least = (list) => list.reduce((a, b) => Math.min(a, b), Infinity);
  const largest = (list) => list.reduce((a, b) => Math.max(a, b), 0);
  const tradeoffTop = largest(xiMax) * 1.25;
  const shownTradeoff = data.tradeoff.filter((point) => point[1] !== null);
  const tradeoffLeft = 0.9 * least(spread);
  const tradeoffRight = Math.max(1.04 * largest(spread), tradeoffLeft + 0.1);
  const tradeoff = make("plot-tradeoff", {
    mode: 2, legend: { show: true, live: false }, cursor: freeCursor,
    scales: { x: { time: false, range: [tradeoffLeft, tradeoffRight] },
              y: { range: [0, tradeoffTop] } },
    axes: [axis("spread of ω, max/min − 1 (%)"), axis("largest ξ", { size: 56 })],
    series: [{}, freeCurve("members", colours.other, dotPath(2.5), { fill: colours.other }),
             freeCurve("trade-off", colours.fit, linePath,
                       { width: 2, ...ifThere(shownTradeoff.length) }),
             freeCurve("chosen", colours.member, dotPath(9), { fill: colours.member })],
    hooks: { setCursor: [(u) => {
      const { left, top } = u.cursor;
      if (left < 0) { byId("hover-tradeoff").textContent = "\u00a0"; return; }
      const k = nearest(u, 1, left, top);
      byId("hover-tradeoff").textContent = `member ${k + 1}: spread ${short(spread[k])} %, ` +
          `largest ξ ${short(xiMax[k])}`;
    }] }
  }, [null, [spread, xiMax], [shownTradeoff.map((p) => 100 * p[0]), shownTradeoff.map((p) => p[1])],
      [[spread[0]], [xiMax[0]]]]);

  const roundHz = [0.01, 0.1, 1, 10, 100, 1000].flatMap((power) => [power, 2 * power, 5 * power]);
  const bodeAxis = axis("frequency (Hz)", {
    splits: (u, index, low, high) => roundHz.filter((f) => f >= low && f <= high),
    filter: (u, splits) => splits, values: (u, splits) => splits.map(String)
  });
  const bodeSeries = () => {
    const value = (u, v) => v === null || v === undefined ? "–" : short(v);
    const dots = (label, colour, size, there) => ({ label, stroke: colour, paths: () => null, value,
        ...ifThere(there), points: { show: true, size, fill: colour, stroke: colour } });
    return [{ label: "Hz", value }, { label: "member", stroke: colours.member, width: 2, value,
              points: { show: false } },
            { label: "joint fit", stroke: colours.fit, width: 1.5, dash: [6, 4], value,
              ...ifThere(any("fit")), points: { show: false } },
            dots("coherent transfer", colours.other, 4, any("transfer")),
            dots("measured", colours.data, 10, true)];
  };
  const empty = [[1, 10], [1, 1], [1, 1], [null, null], [null, null]];
  const gain = make("plot-gain", {
    scales: { x: { time: false, distr: 3, range: (u, lo, hi) => [lo, hi] }, y: { distr: 3 } },
    cursor: { drag: { x: false, y: false } },
    axes: [bodeAxis, axis("|G| (p per q)", { size: 64,
        filter: (u, splits) => splits.map((v) => /^[1]/.test(v.toExponential()) ? v : null) })],
    series: bodeSeries()
  }, empty);
  const phase = make("plot-phase", {
    scales: { x: { time: false, distr: 3, range: (u, lo, hi) => [lo, hi] }, y: { range: [-185, 185] } },
    cursor: { drag: { x: false, y: false } },
    axes: [bodeAxis, axis("phase (degrees)", { size: 60, splits: () => [-180, -90, 0, 90, 180] })],
    series: bodeSeries()
  }, empty);

  let nyquistHz = [];
  let nyquistRange = [-2, 2];
  const nyquist = make("plot-nyquist", {
    mode: 2, legend: { show: true, live: false }, cursor: freeCursor,
    // One unit is as long on either axis: a circle is round.
    scales: { x: { time: false, range: (u) => {
                const stretch = u.bbox && u.bbox.height > 0 ? u.bbox.width / u.bbox.height : 1;
                return nyquistRange.map((v) => v * Math.max(1, stretch));
              } },
              y: { range: (u) => {
                const stretch = u.bbox && u.bbox.height > 0 ? u.bbox.width / u.bbox.height : 1;
                return nyquistRange.map((v) => v / Math.min(1, stretch));
              } } },
    axes: [axis("real part"), axis("imaginary part", { size: 56 })],
    series: [{}, freeCurve("member", colours.member, linePath, { width: 2 }),
             freeCurve("joint fit", colours.fit, linePath,
                       { width: 1.5, dash: [6, 4], ...ifThere(any("fit")) }),
             freeCurve("−1", colours.data, dotPath(8), { fill: colours.data }),
             freeCurve("crossings", colours.member, dotPath(7), { fill: colours.member })],
    hooks: { setCursor: [(u) => {
      const { left, top } = u.cursor;
      if (left < 0 || nyquistHz.length === 0) { byId("hover-nyquist").textContent = "\u00a0"; return; }
      const k = nearest(u, 1, left, top);
      byId("hover-nyquist").textContent = `${short(nyquistHz[k])} Hz: ` +
          `${short(u.data[1][0][k])} + ${short(u.data[1][1][k])} j`;
    }] }
  }, [null, [[0], [0]], [[0], [0]], [[-1], [0]], [[], []]]);

  const time = make("plot-time", {
    scales: { x: { time: false } }, cursor: { drag: { x: false, y: false } },
    axes: [axis("time (ms)"), axis("p (units of the record)", { size: 60 })],
    series: [{ label: "ms", value: (u, v) => short(v) },
             { label: "member", stroke: colours.member, width: 2, value: (u, v) => short(v),
               points: { show: false } },
             { label: "record", stroke: colours.data, width: 1.2, value: (u, v) => short(v),
               ...ifThere(any("record")),
               points: { show: false } }]
  }, [[0, 1], [0, 0], [null, null]]);

  // What the choice changes.

  const showBode = (model, fit, e) => {
    const at = data.experiments[e];
    const f = at.frequency_hz[0];
    const transfer = at.transfer;
    const marks = new Map();  // frequency -> [transfer index, is the cycle]
    const top = transfer ? Math.max(4.5 * f, Math.min(transfer.frequency_hz[transfer.frequency_hz.length - 1], 10 * f))
                         : 4.5 * f;
    for (let i = 0; i < 240; ++i) marks.set(f / 5 * Math.pow(5 * top / f, i / 239), [-1, false]);
    if (transfer) {
      transfer.frequency_hz.forEach((x, i) => {
        if (x > f / 5 && x < top) marks.set(x, [i, false]);
      });
    }
    marks.set(f, [-1, true]);
    const xs = Array.from(marks.keys()).sort((a, b) => a - b);
    const responses = xs.map((x) => gainAt(model, x));
    const others = fit ? xs.map((x) => gainAt(fit, x)) : null;
    const dots = (key) => xs.map((x) => { const i = marks.get(x)[0]; return i < 0 ? null : transfer[key][i]; });
    const star = (value) => xs.map((x) => marks.get(x)[1] ? value : null);
    gain.setData([xs, responses.map(abs), others ? others.map(abs) : xs.map(() => null),
                  dots("gain"), star(at.gain[0])]);
    phase.setData([xs, responses.map(degrees), others ? others.map(degrees) : xs.map(() => null),
                   dots("phase_deg"), star(at.phase_deg[0])]);
  };
  const nyquistCurve = (model, slope, maxHz) => {
    const xs = [];
    const ys = [];
    const hz = [];
    for (let i = 1; i <= 1200; ++i) {
      const f = maxHz * i / 1200;
      const value = loopAt(model, f);
      xs.push(Math.abs(slope) * value[0]);
      ys.push(Math.abs(slope) * value[1]);
      hz.push(f);
    }
    return { xs, ys, hz };
  };
  const showNyquist = (model, fit, e) => {
    const f = data.experiments[e].frequency_hz[0];
    const maxHz = 4.2 * f;
    const slope = drawnSlope(model, e);
    const own = nyquistCurve(model, slope, maxHz);
    const other = fit ? nyquistCurve(fit, drawnSlope(fit, e), maxHz) : { xs: [], ys: [] };
    const loopGain = Math.abs(slope) * responseOf(model, e);
    byId("nyquist-note").textContent = slopeOf(e) === null
        ? "The flame’s slope was not measured: curves are scaled to a loop gain of one at the cycle."
        : loopGain < 1 ? `With the measured slope the loop gain at the cycle is ${short(loopGain)}, ` +
                         "below the one that (1b) asks of a loop that cycles by itself."
                       : "";
    nyquistHz = own.hz;
    let reach = 1.3;
    for (const list of [own.xs, own.ys]) for (const v of list) reach = Math.max(reach, Math.abs(v));
    reach = Math.min(reach, 4) * 1.08;
    nyquistRange = [-reach, reach];
    const found = crossings(model, maxHz);
    nyquist.setData([null, [own.xs, own.ys], [other.xs, other.ys], [[-1], [0]],
                     [found.map((x) => Math.abs(slope) * loopAt(model, x)[0]), found.map(() => 0)]]);
    return found.map((x) => [x, Math.abs(slope) * abs(loopAt(model, x))]);
  };
  const showTime = (model, e) => {
    const at = data.experiments[e];
    const f = at.frequency_hz[0];
    const window = 8 / f;
    const course = timeCourse(model, e, 3 * window);
    const found = cycleFrequency(course.times, course.pressure);
    const result = { frequency: found, amplitude: abs(fundamental(course.times, course.pressure,
                                                                isFinite(found) ? found : f)) };
    const sample = (t) => {
      const step = course.times[1] - course.times[0];
      const i = Math.max(0, Math.min(course.times.length - 2, Math.floor(t / step)));
      const part = t / step - i;
      return (1 - part) * course.pressure[i] + part * course.pressure[i + 1];
    };
    const record = at.record;
    let note = "No record of this experiment is at hand.";
    if (record) {
      const samples = floats(record.p);
      const n = Math.min(samples.length, Math.ceil(window * record.sampling_hz));
      const times = Array.from({ length: n }, (unused, i) => i / record.sampling_hz);
      const shown = Array.from(samples.slice(0, n));
      const mean = samples.reduce((a, b) => a + b, 0) / samples.length;
      const centred = shown.map((v) => v - mean);
      // A limit cycle has no phase of its own: the member's is turned to the record's.
      const theirs = fundamental(times, centred, f);
      const own = fundamental(course.times, course.pressure, isFinite(found) ? found : f);
      const lag = (Math.atan2(theirs[1], theirs[0]) - Math.atan2(own[1], own[0])) / (2 * Math.PI * f);
      const shift = ((lag % (1 / f)) + 1 / f) % (1 / f);
      const scale = record.simulated ? 1 : abs(theirs) / abs(own);
      time.setData([times.map((t) => 1e3 * t), times.map((t) => scale * sample(t + shift)), centred]);
      note = record.simulated ? "Record: simulated by howl simulate, with noise." + record.remark
                              : "The flame’s saturation is chosen so that the amplitudes agree.";
    } else {
      const times = Array.from({ length: 400 }, (unused, i) => window * i / 400);
      time.setData([times.map((t) => 1e3 * t), times.map(sample), times.map(() => null)]);
    }
    const asked = Math.abs(slopeOf(e) === null ? 0 : slopeOf(e)) * responseOf(model, e);
    if (asked < data.loop_gain_min) {
      note = "The member’s course is simulated with the flame’s slope raised to a loop gain of " +
             short(data.loop_gain_min) + (asked > 0 ? `: with the measured slope it is ${short(asked)}`
                                                    : ": no slope was measured") + ". " + note;
    }
    byId("time-note").textContent = note + " The phase of a cycle is arbitrary.";
    return result;
  };
  const withError = (pair) => !pair || pair[0] === null ? "–"
      : short(pair[0]) + (pair[1] !== null ? " ± " + (+pair[1].toPrecision(2)) : "");
  const showTable = (model, fit, e, own, course) => {
    const at = data.experiments[e];
    const f = at.frequency_hz[0];
    const slope = slopeOf(e);
    const loopGain = (x) => slope === null ? NaN : Math.abs(slope) * abs(loopAt(x, f));
    const both = (label, of, measured) => [label, of(model), measured, fit ? of(fit) : "–"];
    const rows = [
      both("|G| at the cycle", (x) => short(abs(gainAt(x, f))), withError(at.gain)),
      both("phase of G at the cycle (°)", (x) => short(degrees(gainAt(x, f))), withError(at.phase_deg)),
      both("loop gain", (x) => short(loopGain(x)), withError(at.loop_gain)),
      both("growth rate at rest (1/s)", (x) => short(growthRate(x, e)), "–"),
      both("gain margin (dB)", (x) => short(-20 * Math.log10(loopGain(x))), "–"),
      ["frequency of the cycle (Hz)", short(course.frequency), withError(at.frequency_hz), "–"],
      ["further crossings: Hz (gain)",
       own.filter((c) => c[0] > 1.3 * f).map((c) => `${c[0].toFixed(1)} (${c[1].toFixed(2)})`).join(", ") || "–",
       (at.lines_hz || []).map((x) => x.toFixed(0)).join(", ") || "–", "–"],
      both("ω (Hz)", (x) => short(x.omega), "–"), both("ξ", (x) => short(x.xi), "–"),
      both("N", (x) => short(x.N), "–"), both("M", (x) => short(x.M), "–"),
      both("τ (ms)", (x) => short(1e3 * x.tau), withError(at.tau_s.map((v) => v === null ? null : 1e3 * v)))
    ];
    byId("predictions").tBodies[0].replaceChildren(...rows.map((row) => {
      const line = document.createElement("tr");
      row.slice(0, any("fit") ? 4 : 3).forEach((text, k) => {
        const cell = document.createElement(k === 0 ? "th" : "td");
        if (k === 0) cell.scope = "row";
        cell.textContent = text;
        line.append(cell);
      });
      return line;
    }));
  };
  const show = () => {
    const at = data.experiments[experiment];
    byId("member").value = member + 1;
    byId("along").value = place[member];
    byId("experiment").value = experiment;
    byId("chosen").textContent = `Member ${member + 1} of ${data.members}: ω spreads by ` +
        `${short(spread[member])} % over the operating points, largest ξ ${short(xiMax[member])}.`;
    tradeoff.setData([null, tradeoff.data[1], tradeoff.data[2], [[spread[member]], [xiMax[member]]]]);
    if (!measured(at)) {
      byId("chosen").textContent += " What the records showed is not here, so that nothing can be " +
          "drawn beside it: howl family, run again, or howl analyse writes it.";
      return;
    }
    const model = modelOf(member, experiment);
    const fit = fitOf(experiment);
    showBode(model, fit, experiment);
    const own = showNyquist(model, fit, experiment);
    showTable(model, fit, experiment, own, showTime(model, experiment));
  };
  let asked = 0;
  const choose = (m) => {
    if (!(m >= 0 && m < data.members)) return;
    member = m;
    if (!asked) asked = requestAnimationFrame(() => { asked = 0; show(); });
  };

  // Controls.

  data.experiments.forEach((each, e) => {
    const option = document.createElement("option");
    option.value = e;
    option.textContent = `${each.name} (${short(each.phi)})`;
    option.disabled = !each.frequency_hz;
    byId("experiment").append(option);
  });
  byId("experiment").addEventListener("change", (event) => {
    experiment = +event.target.value;
    choose(member);
  });
  if (!any("fit")) document.querySelector("#predictions thead th:last-child").remove();
  byId("member").max = data.members;
  byId("member").addEventListener("input", (event) => {
    if (event.target.value !== "") choose(Math.round(+event.target.value) - 1);
  });
  byId("along").max = data.members - 1;
  byId("along").addEventListener("input", (event) => choose(order[+event.target.value]));
  const drag = (event) => {
    const box = tradeoff.over.getBoundingClientRect();
    choose(nearest(tradeoff, 1, event.clientX - box.left, event.clientY - box.top));
  };
  tradeoff.over.style.cursor = "grab";
  tradeoff.over.style.touchAction = "none";
  tradeoff.over.addEventListener("pointerdown", (event) => {
    tradeoff.over.setPointerCapture(event.pointerId);
    drag(event);
  });
  tradeoff.over.addEventListener("pointermove", (event) => {
    if (event.buttons & 1) drag(event);
  });
  new ResizeObserver(() => {
    for (const [plot, box] of plots) {
      const width = Math.max(260, box.clientWidth);
      if (width !== plot.width) plot.setSize({ width, height: plotHeight });
    }
  }).observe(byId("browser"));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    for (const [plot] of plots) plot.redraw(false, true);
  });

  member = order[Math.floor(order.length / 2)];
  show();
  document.documentElement.dataset.browserReady = "true";
})();
