// SPDX-License-Identifier: MIT. Copyright the sph authors.
// app.js: the page around tank.c. Steps the tank for a part of every frame, draws the water, and turns what the user does into
// whole degrees of tilt. TANK_WASM (tank.wasm.js) is the program in base64, so that the page opens as a plain file too.
//
// With #test=N,DEGREES,M behind the address the page does N steps upright, sets the slider to DEGREES, does M steps and pauses;
// the hashes after N and N + M steps go into the title and into data-test of <body>.
'use strict';

const BUDGET = 11;   // ms of a frame that steps may take
const MAX_TILT = 60; // degrees, by slider, keys and drag
const SHADES = 16;   // colours between slow and fast water
const FAST = 7;      // m/s, the brightest colour

const el = (id) => document.getElementById(id);
const view = el('view');
const pen = view.getContext('2d');
let tank;
let tilt = 0;
let held = false;   // the device itself is tilted: then the picture stays level with the screen
let running = true;
let steps = 0;
let shades = [];
let colours = {};
const rate = { steps: 0, since: performance.now(), shown: 0 };

// ---- the tank ----

function load() {
  const bytes = Uint8Array.from(atob(TANK_WASM), (c) => c.charCodeAt(0));
  if (!WebAssembly.validate(bytes)) {
    throw new Error('this browser does not run WebAssembly with SIMD');
  }
  // small enough to be made at once, which keeps the test below simple
  return new WebAssembly.Instance(new WebAssembly.Module(bytes), {}).exports;
}

function textAt(at) {
  const bytes = new Uint8Array(tank.memory.buffer, at);
  return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
}

function say(text, bad) {
  el('message').textContent = text;
  el('message').classList.toggle('bad', Boolean(bad));
}

function done(status) {
  if (status === 0) {
    return true;
  }
  setRunning(false);
  say(`Stopped: ${textAt(tank.text(status))}. Reset starts afresh.`, true);
  return false;
}

function stepOnce() {
  if (!done(tank.step())) {
    return false;
  }
  steps += 1;
  rate.steps += 1;
  return true;
}

function stateHash() {
  const half = (high) => (tank.hash(high) >>> 0).toString(16).padStart(8, '0');
  return half(1) + half(0);
}

function setTilt(degrees) {
  const limit = held ? 180 : MAX_TILT;
  const next = Math.max(-limit, Math.min(limit, Math.round(degrees)));
  if (next !== tilt && done(tank.tilt(next))) {
    tilt = next;
  }
  el('tilt').value = tilt;
  el('degrees').textContent = `${tilt}°`.replace('-', '\u2212');
}

function setRunning(on) {
  running = on;
  el('pause').textContent = on ? 'Pause' : 'Go on';
  if (on) {
    rate.steps = 0;
    rate.since = performance.now();
  }
}

function reset() {
  say('');
  steps = 0;
  tilt = 0;
  if (done(tank.start())) {
    setTilt(0);
    setRunning(true);
  }
  draw();
  showFigures();
}

// ---- the picture ----

function mix(a, b, t) {
  const part = (hex, k) => parseInt(hex.slice(1 + 2 * k, 3 + 2 * k), 16);
  return `rgb(${[0, 1, 2].map((k) => Math.round(part(a, k) + (part(b, k) - part(a, k)) * t)).join(' ')})`;
}

function readColours() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ['wall', 'inside', 'slow', 'fast', 'soft']) {
    colours[name] = style.getPropertyValue(`--${name}`).trim();
  }
  shades = Array.from({ length: SHADES }, (_, k) => mix(colours.slow, colours.fast, k / (SHADES - 1)));
}

function fit() {
  const dots = Math.min(window.devicePixelRatio || 1, 2);
  view.width = Math.round(view.clientWidth * dots);
  view.height = Math.round(view.clientHeight * dots);
  if (tank) {
    draw();
  }
}

// the tank about its middle, turned by the tilt; scaled so that it fits at any tilt that a hand can give
function frameTank(width, height) {
  const a = held ? 0 : (tilt * Math.PI) / 180;
  const [w, h] = [width + 0.5, height + 0.5];
  const turned = held ? 0 : Math.max(25, Math.abs(tilt));
  const [c, s] = [Math.cos((turned * Math.PI) / 180), Math.sin((turned * Math.PI) / 180)];
  const scale = Math.min(view.width / (w * c + h * s), view.height / (w * s + h * c));
  pen.setTransform(1, 0, 0, 1, 0, 0);
  pen.clearRect(0, 0, view.width, view.height);
  pen.translate(view.width / 2, view.height / 2);
  pen.rotate(a);
  pen.scale(scale, -scale);
  pen.translate(-width / 2, -height / 2);
}

// particles of one shade as one path, so that a thousand of them cost a fill
function shadePaths(p, radius) {
  const paths = shades.map(() => new Path2D());
  for (let i = 0; i < p.length; i += 3) {
    const path = paths[Math.min(SHADES - 1, Math.floor((p[i + 2] / FAST) * SHADES))];
    path.moveTo(p[i] + radius, p[i + 1]);
    path.arc(p[i], p[i + 1], radius, 0, 2 * Math.PI);
  }
  return paths;
}

// first wide discs, which close the gaps, then the particles themselves
function drawWater() {
  const n = tank.draw();
  const p = new Float32Array(tank.memory.buffer, tank.picture(), 3 * n);
  for (const size of [0.85, 0.6]) {
    shadePaths(p, size * tank.spacing()).forEach((path, k) => {
      pen.fillStyle = shades[k];
      pen.fill(path);
    });
  }
  return n;
}

function draw() {
  const [w, h] = [tank.width(), tank.height()];
  pen.save();
  frameTank(w, h);
  const edge = 0.09;
  pen.fillStyle = colours.wall;
  pen.beginPath();
  pen.roundRect(-edge, -edge, w + 2 * edge, h + 2 * edge, 0.12);
  pen.fill();
  pen.fillStyle = colours.inside;
  pen.fillRect(0, 0, w, h);
  pen.beginPath();
  pen.rect(0, 0, w, h);
  pen.clip();
  const water = drawWater();
  pen.restore();
  el('particles').textContent = `${water.toLocaleString('en')} + ${tank.particles() - water}`;
}

function showFigures() {
  el('steps').textContent = steps.toLocaleString('en');
  el('time').textContent = `${tank.time().toFixed(2)} s`;
  el('hash').textContent = stateHash();
}

function frame(now) {
  if (running) {
    const end = performance.now() + BUDGET;
    while (stepOnce() && performance.now() < end);
    draw();
  }
  if (now - rate.since >= 500) {
    el('rate').textContent = running ? Math.round((1000 * rate.steps) / (now - rate.since)).toLocaleString('en') : 'paused';
    rate.steps = 0;
    rate.since = now;
  }
  if (running && now - rate.shown >= 100) {
    showFigures();
    rate.shown = now;
  }
  requestAnimationFrame(frame);
}

// ---- hands ----

function single() {
  setRunning(false);
  stepOnce();
  draw();
  showFigures();
}

function turn(degrees) {
  setTilt(degrees);
  draw();
}

function onKey(e) {
  if (e.ctrlKey || e.altKey || e.metaKey) {
    return;
  }
  const onButton = e.target instanceof HTMLButtonElement;
  const keys = {
    ArrowLeft: () => turn(tilt - 2),
    ArrowRight: () => turn(tilt + 2),
    '.': single,
    r: reset,
  };
  if (!onButton) {
    keys[' '] = () => setRunning(!running); // on a button, space presses it
  }
  if (keys[e.key]) {
    e.preventDefault(); // the slider would move by its own step too
    keys[e.key]();
  }
}

// a finger or a mouse turns the tank about the middle of the picture
function dragging() {
  let from = null;
  const angle = (e) => {
    const box = view.getBoundingClientRect();
    return Math.atan2(e.clientY - box.top - box.height / 2, e.clientX - box.left - box.width / 2);
  };
  view.addEventListener('pointerdown', (e) => {
    view.setPointerCapture(e.pointerId);
    from = { at: angle(e), tilt };
  });
  view.addEventListener('pointermove', (e) => {
    if (from && !held) {
      let by = angle(e) - from.at;
      by -= 2 * Math.PI * Math.round(by / (2 * Math.PI));
      turn(from.tilt + (by * 180) / Math.PI);
    }
  });
  for (const kind of ['pointerup', 'pointercancel']) {
    view.addEventListener(kind, () => { from = null; });
  }
}

// gravity in the plane of the screen, for any way the device is held
function onOrientation(e) {
  if (!held || e.beta === null) {
    return;
  }
  const rad = Math.PI / 180;
  const x = Math.cos(e.beta * rad) * Math.sin(e.gamma * rad); // towards the right edge of the upright device
  const y = -Math.sin(e.beta * rad);                          // towards its top
  if (Math.hypot(x, y) > 0.15) { // lying flat there is no down
    setTilt(Math.atan2(x, -y) / rad + ((screen.orientation && screen.orientation.angle) || 0));
  }
}

async function toggleMotion() {
  const ask = DeviceOrientationEvent.requestPermission;
  if (!held && ask && (await ask.call(DeviceOrientationEvent).catch(() => 'denied')) !== 'granted') {
    say('The browser does not give the device\u2019s orientation.');
    return;
  }
  held = !held;
  el('motion').setAttribute('aria-pressed', String(held));
  el('tilt').disabled = held;
  turn(0);
}

function listen() {
  el('tilt').addEventListener('input', () => turn(Number(el('tilt').value)));
  el('pause').addEventListener('click', () => setRunning(!running));
  el('step').addEventListener('click', single);
  el('level').addEventListener('click', () => turn(0));
  el('reset').addEventListener('click', reset);
  el('controls').addEventListener('submit', (e) => e.preventDefault());
  document.addEventListener('keydown', onKey);
  window.addEventListener('resize', fit);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { readColours(); draw(); });
  dragging();
  if ('DeviceOrientationEvent' in window && matchMedia('(pointer: coarse)').matches) {
    el('motion').hidden = false;
    el('motion').addEventListener('click', toggleMotion);
    window.addEventListener('deviceorientation', onOrientation);
  }
}

// ---- test ----

function selfTest(text) {
  const [n, degrees, more] = text.split(',').map(Number);
  if (![n, degrees, more].every(Number.isInteger) || n < 0 || more < 0 || Math.abs(degrees) > MAX_TILT) {
    say(`#test=${text}: allowed is #test=STEPS,DEGREES,STEPS with whole numbers and degrees from -${MAX_TILT} to ${MAX_TILT}`, true);
    return;
  }
  const go = (count) => {
    for (let k = 0; k < count && stepOnce(); k++);
    return stateHash();
  };
  const first = go(n);
  el('tilt').value = degrees;
  el('tilt').dispatchEvent(new Event('input'));
  const second = go(more);
  setRunning(false);
  draw();
  showFigures();
  document.body.dataset.test = `${first} ${second}`;
  document.title = `hash ${first} ${second}`;
}

try {
  tank = load();
  readColours();
  listen();
  fit();
  reset();
  const test = location.hash.match(/^#test=(.*)$/);
  if (test) {
    selfTest(test[1]);
  }
  requestAnimationFrame(frame);
} catch (why) {
  say(`The tank cannot be shown: ${why.message}.`, true);
}
