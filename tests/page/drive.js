// node drive.js CHROMIUM STEPS PROFILE [FLAG …]
//
// Opens pages in a browser without a window, in real time, and does to them what a person would: the
// steps of the JSON file STEPS, one after the other, as input events of the browser. What they gave
// comes out as JSON: {results, errors}, where errors are the messages of the console and exceptions.
// Speaks the DevTools protocol over a pipe, so that nothing but node is needed.
'use strict';
const fs = require('fs');
const {spawn} = require('child_process');

const [chromium, stepsFile, profile, ...flags] = process.argv.slice(2);
const browser = spawn(chromium, ['--headless', '--no-sandbox', '--remote-debugging-pipe', '--hide-scrollbars',
  `--user-data-dir=${profile}`, ...flags], {stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe']});

const pending = new Map();
const errors = [];
const kBrowser = null;  // in place of a session: what goes to the browser itself
let session;
let last = 0;
let rest = '';
browser.stdio[4].on('data', (data) => {
  const messages = (rest + data).split('\0');
  rest = messages.pop();
  for (const text of messages) take(JSON.parse(text));
});

function take(message) {
  if (pending.has(message.id)) {
    const [resolve, reject] = pending.get(message.id);
    pending.delete(message.id);
    if (message.error) reject(new Error(message.error.message));
    else resolve(message.result);
  } else if (message.method === 'Runtime.exceptionThrown') {
    const {text, exception} = message.params.exceptionDetails;
    errors.push(exception ? exception.description || text : text);
  } else if (message.method === 'Runtime.consoleAPICalled') {
    const {type, args} = message.params;
    if (['error', 'warning', 'assert'].includes(type)) errors.push(args.map((a) => a.value || a.description).join(' '));
  } else if (message.method === 'Log.entryAdded') {
    const {level, source, text} = message.params.entry;
    // The browser itself says that reading pixels waits for the card, and that it draws in software.
    const own = /ReadPixels|software WebGL|--enable-unsafe-swiftshader/.test(text);
    if (['error', 'warning'].includes(level) && !own) errors.push(`${source}: ${text}`);
  }
}

function send(method, params = {}, to = session) {
  const id = ++last;
  browser.stdio[3].write(`${JSON.stringify({id, method, params, ...(to === kBrowser ? {} : {sessionId: to})})}\0`);
  return new Promise((resolve, reject) => pending.set(id, [resolve, reject]));
}

const pause = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

async function evaluated(expression) {
  const {result, exceptionDetails: thrown} =
      await send('Runtime.evaluate', {expression, returnByValue: true, awaitPromise: true});
  if (thrown) throw new Error(`${expression}: ${thrown.exception.description}`);
  return result.value;
}

/** Two frames later what was asked for is drawn. */
const drawn = () => evaluated('new Promise((r) => requestAnimationFrame(() => requestAnimationFrame(() => r())))');

const kKeys = {Enter: 13, Escape: 27, Tab: 9, Space: 32, ArrowLeft: 37, ArrowUp: 38, ArrowRight: 39, ArrowDown: 40};

const steps = {
  /** A window of [width, height], on a phone [width, height, true]. */
  size: ([width, height, mobile = false]) => send('Emulation.setDeviceMetricsOverride',
      {width, height, mobile, deviceScaleFactor: 1}),
  /** What the system wishes: 'dark', 'light'. */
  scheme: (value) => send('Emulation.setEmulatedMedia', {features: [{name: 'prefers-color-scheme', value}]}),
  open: (url) => send('Page.navigate', {url}),
  /** A script that runs before those of the pages opened from now on. */
  before: (source) => send('Page.addScriptToEvaluateOnNewDocument', {source}),
  /** Waits until the expression holds; while it throws it does not. */
  wait: async (expression) => {
    const start = Date.now();
    while (!await evaluated(`!!(${expression})`).catch(() => false)) {
      if (Date.now() - start > 120000) throw new Error(`in vain: ${expression}`);
      await pause(20);
    }
  },
  value: evaluated,
  /** Whether pages opened from now on may run scripts. */
  scripts: (may) => send('Emulation.setScriptExecutionDisabled', {value: !may}),
  /** Seconds of processors that the page and the drawing took so far, however busy the machine. */
  seconds: async () => {
    const {processInfo} = await send('SystemInfo.getProcessInfo', {}, kBrowser);
    const of = (type) => processInfo.filter((p) => p.type === type).reduce((sum, p) => sum + p.cpuTime, 0);
    return {page: of('renderer'), drawing: of('GPU')};
  },
  click: async ([x, y]) => {
    for (const type of ['mousePressed', 'mouseReleased']) {
      await send('Input.dispatchMouseEvent', {type, x, y, button: 'left', clickCount: 1});
    }
  },
  /** Of [x, y], [x, y], …: with the button down from the first to the last. */
  drag: async ({path, button = 'left', modifiers = 0}) => {
    const buttons = button === 'left' ? 1 : 2;
    const at = (type, [x, y]) =>
        send('Input.dispatchMouseEvent', {type, x, y, button, buttons, modifiers, clickCount: 1});
    await at('mousePressed', path[0]);
    for (const place of path.slice(1)) await at('mouseMoved', place);
    await at('mouseReleased', path[path.length - 1]);
  },
  wheel: ([x, y, deltaY]) => send('Input.dispatchMouseEvent', {type: 'mouseWheel', x, y, deltaX: 0, deltaY}),
  /** Each of the list has the places of all fingers at one time; at the end they leave. */
  touch: async (times) => {
    const points = (places) => places.map(([x, y], id) => ({x, y, id}));
    for (const [i, places] of times.entries()) {
      await send('Input.dispatchTouchEvent',
                 {type: i === 0 ? 'touchStart' : 'touchMove', touchPoints: points(places)});
    }
    await send('Input.dispatchTouchEvent', {type: 'touchEnd', touchPoints: []});
  },
  /** A key by its name, or a text letter by letter. */
  key: async (name) => {
    const code = kKeys[name] || 0;
    for (const [key, text] of code ? [[name === 'Space' ? ' ' : name, {Enter: '\r', Space: ' '}[name]]] : [...name].map((c) => [c, c])) {
      const shared = {key, text, windowsVirtualKeyCode: code || key.toUpperCase().charCodeAt(0), code: code ? name : ''};
      await send('Input.dispatchKeyEvent', {type: text ? 'keyDown' : 'rawKeyDown', ...shared});
      await send('Input.dispatchKeyEvent', {type: 'keyUp', ...shared, text: undefined});
    }
  },
  /** The window as a .png file. */
  shoot: async (file) => {
    const {data} = await send('Page.captureScreenshot');
    fs.writeFileSync(file, Buffer.from(data, 'base64'));
  },
  pause,
};

async function run() {
  const {targetId} = await send('Target.createTarget', {url: 'about:blank'}, kBrowser);
  session = (await send('Target.attachToTarget', {targetId, flatten: true}, kBrowser)).sessionId;
  for (const domain of ['Page', 'Runtime', 'Log']) await send(`${domain}.enable`);
  const results = [];
  for (const step of JSON.parse(fs.readFileSync(stepsFile, 'utf8'))) {
    const [name, argument] = Object.entries(step)[0];
    const value = await steps[name](argument);
    if (['value', 'seconds'].includes(name)) results.push(value === undefined ? null : value);
    else if (!['wait', 'pause', 'shoot', 'open', 'before', 'scripts'].includes(name)) await drawn();
  }
  console.log(JSON.stringify({results, errors}));
}

run().catch((error) => {
  console.error(String(error.stack || error));
  process.exitCode = 1;
}).finally(async () => {
  send('Browser.close', {}, kBrowser).catch(() => {});
  await Promise.race([new Promise((resolve) => browser.on('exit', resolve)), pause(5000)]);
  browser.kill('SIGKILL');
  process.exit();
});
