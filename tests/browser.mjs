// SPDX-License-Identifier: MIT. Copyright the sph authors.
// browser.mjs CHROMIUM PAGE STEPS DEGREES STEPS OUT: opens the page of examples/wasm in headless Chromium, works its
// controls as a hand would, takes pictures into the directory OUT, and prints the two hashes of its test. The browser is
// spoken to over a pipe (DevTools protocol), so nothing but node is needed.
import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const [chromium, page, before, degrees, after, out] = process.argv.slice(2);
const home = mkdtempSync(join(tmpdir(), 'sph-browser-'));
const browser = spawn(chromium, ['--headless=new', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', '--remote-debugging-pipe',
  '--hide-scrollbars', `--user-data-dir=${home}`, 'about:blank'], { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });
const waiting = new Map();
let serial = 0;
let rest = '';

browser.stdio[4].setEncoding('utf8');
browser.stdio[4].on('data', (text) => {
  const parts = (rest + text).split('\0');
  rest = parts.pop();
  for (const message of parts.map((p) => JSON.parse(p))) {
    const call = waiting.get(message.id);
    waiting.delete(message.id);
    if (call) {
      if (message.error) call.reject(new Error(message.error.message));
      else call.resolve(message.result);
    }
  }
});

let attached; // to the page
function send(method, params = {}) {
  serial += 1;
  const id = serial;
  browser.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId: attached })}\0`);
  return new Promise((done, reject) => waiting.set(id, { resolve: done, reject }));
}

async function value(expression) {
  const answer = await send('Runtime.evaluate', { expression, returnByValue: true, awaitPromise: true });
  if (answer.exceptionDetails) throw new Error(`${expression}: ${answer.exceptionDetails.exception.description}`);
  return answer.result.value;
}
const text = (id) => value(`document.getElementById('${id}').textContent`);
const pause = (ms) => new Promise((done) => { setTimeout(done, ms); });

async function until(expression, what) {
  for (let k = 0; k < 600; k++) {
    if (await value(expression)) return;
    await pause(100);
  }
  throw new Error(`waited a minute for ${what}`);
}

function expect(holds, what) {
  if (!holds) throw new Error(`expected: ${what}`);
  console.error(`  ${what}`);
}

async function open(fragment, width, height, mobile, scheme) {
  await send('Emulation.setDeviceMetricsOverride', { width, height, deviceScaleFactor: mobile ? 2 : 1, mobile });
  await send('Emulation.setTouchEmulationEnabled', { enabled: mobile });
  await send('Emulation.setEmulatedMedia', { features: [{ name: 'prefers-color-scheme', value: scheme }] });
  await send('Page.navigate', { url: 'about:blank' });
  await send('Page.navigate', { url: pathToFileURL(resolve(page)).href + fragment });
  await until("document.readyState === 'complete' && location.protocol === 'file:'", 'the page');
}

async function picture(name) {
  const { data } = await send('Page.captureScreenshot', { format: 'png' });
  writeFileSync(join(out, name), Buffer.from(data, 'base64'));
}

const key = async (k, code) => {
  await send('Input.dispatchKeyEvent', { type: 'keyDown', key: k, code });
  await send('Input.dispatchKeyEvent', { type: 'keyUp', key: k, code });
};
const mouse = (type, x, y) => send('Input.dispatchMouseEvent', { type, x, y, button: 'left', buttons: 1, clickCount: 1 });
const click = (id) => value(`document.getElementById('${id}').click()`);

// how much of the picture is water: pixels of the canvas that are clearly blue
const blue = `(() => { const c = document.getElementById('view'), d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;
  let n = 0; for (let k = 0; k < d.length; k += 4) if (d[k + 2] > d[k] + 60) n++; return n / (d.length / 4); })()`;

async function hashes() {
  await open(`#test=${before},${degrees},${after}`, 900, 800, false, 'light');
  await until("document.title.startsWith('hash ') || document.getElementById('message').textContent !== ''", 'the hashes');
  const title = await value('document.title');
  expect(title === `hash ${await value('document.body.dataset.test || ""')}`, `hashes are shown: ${title}; ${await text('message')}`);
  expect(await text('hash') === title.split(' ')[2], 'the state hash on the page is that of the last step');
  const share = await value(blue);
  expect(share > 0.05 && share < 0.6, `water after tilting covers ${(100 * share).toFixed(1)} % of the picture`);
  await picture('desktop.png');
  return title.slice(5);
}

async function controls() {
  await open('', 1000, 800, false, 'dark');
  await until("Number(document.getElementById('steps').textContent.replace(/\\D/g, '')) > 20", 'steps');
  expect(/\d/.test(await text('hash')), 'the tank runs by itself');
  await key(' ', 'Space');
  const held = await text('hash');
  await pause(300);
  await click('step');
  const next = await text('hash');
  expect(next !== held && await text('pause') === 'Go on', 'space pauses, and Step makes a step');
  await pause(300);
  expect(await text('hash') === next, 'nothing moves while paused');
  await key('ArrowRight', 'ArrowRight');
  await key('ArrowRight', 'ArrowRight');
  expect(await text('degrees') === '4°', 'arrow keys tilt');
  const box = JSON.parse(await value("JSON.stringify(document.getElementById('view').getBoundingClientRect())"));
  const [x, y] = [box.left + box.width / 2, box.top + box.height / 2];
  await mouse('mousePressed', x + 200, y);
  await mouse('mouseMoved', x + 200, y + 60);
  await mouse('mouseReleased', x + 200, y + 60);
  expect(await text('degrees') === '21°', 'dragging turns the tank: atan(60/200) is 17 degrees more');
  await click('level');
  expect(await text('degrees') === '0°', 'Level makes it level');
  await click('reset');
  await until("Number(document.getElementById('steps').textContent.replace(/\\D/g, '')) > 20", 'steps');
  expect(await text('degrees') === '0°' && await text('message') === '', 'Reset starts afresh');
}

// phones: narrow, touched, dark; nothing may be wider than the screen, and controls must be large enough for a finger
async function phone() {
  await open(`#test=${before},-30,${after}`, 390, 844, true, 'dark');
  await until("document.title.startsWith('hash ')", 'the phone');
  expect(await value('document.documentElement.scrollWidth <= innerWidth'), 'the page fits a phone');
  expect(await value("[...document.querySelectorAll('button:not([hidden])')].every((b) => b.offsetHeight >= 44)"), 'buttons are 44 px high');
  expect(await value("[...document.querySelectorAll('input, canvas')].every((e) => e.labels?.length || e.getAttribute('aria-label'))"), 'every control has a label');
  await picture('phone.png');
}

const late = setTimeout(() => { console.error('browser.mjs: not done after three minutes'); stop(1); }, 180000);
function stop(code) {
  clearTimeout(late);
  browser.on('exit', () => { rmSync(home, { recursive: true, force: true, maxRetries: 5 }); process.exit(code); });
  browser.kill();
}
browser.on('error', (why) => { console.error(`browser.mjs: ${chromium}: ${why.message}`); process.exit(2); });

try {
  const { targetInfos } = await send('Target.getTargets');
  attached = (await send('Target.attachToTarget', { targetId: targetInfos.find((t) => t.type === 'page').targetId, flatten: true })).sessionId;
  await send('Page.enable');
  const found = await hashes();
  await controls();
  await phone();
  console.log(found);
  stop(0);
} catch (why) {
  console.error(`browser.mjs: ${why.message}`);
  stop(1);
}
