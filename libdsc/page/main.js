// Opens the page: reads its blocks, then hands over to the panel.

/** Tells what is going on, or why nothing is. */
function say(text, share) {
  byId('message').hidden = text === '';
  byId('message-text').textContent = text;
  byId('message-bar').hidden = share === undefined;
  if (share !== undefined) byId('message-bar').value = share;
}

/** Runs three.js, which lies in a block like the data. */
async function loadThree() {
  const element = byId('three');
  const script = document.createElement('script');
  script.textContent = new TextDecoder().decode(await inflated(bytesOfBase64(element.textContent)));
  element.remove();
  document.head.append(script);
}

function canDraw() {
  const gl = document.createElement('canvas').getContext('webgl');
  return gl && gl.getExtension('OES_standard_derivatives') && gl.getExtension('OES_element_index_uint');
}

/** Lets the browser paint; without it a message would only show when its work is done. */
const breath = () => new Promise((resolve) => setTimeout(resolve));

async function open() {
  if (typeof DecompressionStream === 'undefined') {
    say('This browser cannot unpack the page (it lacks DecompressionStream). Versions since 2023 of ' +
        'Chromium, Firefox and Safari can.');
    return;
  }
  if (!canDraw()) {
    say('This browser cannot draw the surface: WebGL, or a part of it that the page needs, is missing ' +
        'or switched off.');
    return;
  }
  const start = performance.now();
  const wishes = new URLSearchParams(location.hash.slice(1));
  document.querySelector('h1').textContent = document.title;
  byId('theme').value = wishes.get('theme') || 'light dark';
  document.documentElement.dataset.theme = byId('theme').value;
  say('Unpacking', 0);
  await loadThree();
  const manifest = JSON.parse(byId('manifest').textContent);
  const model = await readModel(manifest, (share) => say('Unpacking', share));
  say('Drawing');
  await breath();
  const maps = manifest.colormaps.map((map) => new ColorMap(map));
  const inset = () => {
    const panel = byId('panel');  // of no size while it is folded
    const beside = panel.offsetWidth < window.innerWidth;
    return beside ? {right: panel.offsetWidth, bottom: 0} : {right: 0, bottom: panel.offsetHeight};
  };
  byId('canvas').addEventListener('webglcontextlost', () => say('The graphics card is gone. Waiting for it.'));
  byId('canvas').addEventListener('webglcontextrestored', () => say(''));
  const view = new View(byId('canvas'), byId('marks'), model, inset);
  const panel = new Panel(model, view, maps, wishes);
  view.draw();
  model.reach = reachOf(model);  // the first pick's, while the picture is in the making
  say('');
  if (wishes.has('selftest')) selfTest(model, view, panel, start);
}

open().catch((error) => {
  say(`The page could not be opened: ${error.message}`);
  console.error(error);
});
