// The page itself: what is shown, from where, and how mouse, touch, keyboard and controls change that.

const byId = (id) => document.getElementById(id);
const clay = [.64, .58, .50], clayBack = [.60, .16, .10], blue = [.16, .34, .62], blueBack = [.35, .12, .35];
const fieldOfView = 30 * Math.PI / 180;

const state = {
  yaw: 0, pitch: 0, distance: 1, target: [0, 0, 0],
  shading: 0, values: null, low: 0, high: 1, moving: false, slow: false,
};
let drawing, mesh, reference = null, reach = 1, asked = false, settle = 0;
const frame = {center: [0, 1, 2].map((k) => facts.mesh.corner[k] + facts.mesh.size[k] / 2),
  radius: Math.hypot(...facts.mesh.size) / 2 || 1};
const shadings = [{name: 'clay'}, ...(facts.coloured ? [{name: 'colours of the vertices', array: 'colours'}] : []),
  ...facts.shadings];

const digits = (x) => Number(x.toPrecision(5)).toString();

// The camera.

function axes() {
  const {yaw, pitch} = state, c = Math.cos(pitch), s = Math.sin(pitch);
  const back = [c * Math.cos(yaw), c * Math.sin(yaw), s], right = [-Math.sin(yaw), Math.cos(yaw), 0];
  const up = [-s * Math.cos(yaw), -s * Math.sin(yaw), c];
  return {right, up, back};
}

function matrices() {
  const {right, up, back} = axes(), {distance, target} = state, {width, height} = drawing.canvas;
  const dot = (a) => a[0] * target[0] + a[1] * target[1] + a[2] * target[2];
  const toEye = [right[0], up[0], back[0], 0, right[1], up[1], back[1], 0, right[2], up[2], back[2], 0,
    -dot(right), -dot(up), -dot(back) - distance, 1];
  const away = distance + Math.hypot(...target), far = away + 2 * reach;
  const near = Math.max(distance - Math.hypot(...target) - 1.05 * reach, distance / 100, 1e-4);
  const scale = 1 / Math.tan(fieldOfView / 2), narrow = Math.min(1, width / height);
  const x = scale * narrow * height / width, y = scale * narrow;
  const deep = -(far + near) / (far - near), shift = -2 * far * near / (far - near);
  const toScreen = [];
  for (let column = 0; column < 4; ++column) {
    const [ex, ey, ez, ew] = toEye.slice(4 * column, 4 * column + 4);
    toScreen.push(x * ex, y * ey, deep * ez + shift * ew, -ez);
  }
  return {toEye, toScreen};
}

function lookFrom(direction) {
  const [x, y, z] = direction, flat = Math.hypot(x, y);
  state.yaw = flat > 1e-9 * Math.abs(z) ? Math.atan2(y, x) : -Math.PI / 2;
  state.pitch = Math.atan2(z, flat);
  changed();
}

function fit() {
  state.target = [0, 0, 0];
  state.distance = 1.04 / Math.sin(fieldOfView / 2);
  changed();
}

function turn(yaw, pitch) {
  state.yaw += yaw;
  state.pitch = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, state.pitch + pitch));
  changed(true);
}

/// \param x, y in pixels of the page.
function move(x, y) {
  const {right, up} = axes(), canvas = drawing.canvas;
  const perPixel = 2 * state.distance * Math.tan(fieldOfView / 2) / Math.min(canvas.clientWidth, canvas.clientHeight);
  for (let k = 0; k < 3; ++k) state.target[k] += (-x * right[k] + y * up[k]) * perPixel;
  changed(true);
}

function zoom(factor) {
  state.distance = Math.max(.02, Math.min(50 * reach, state.distance * factor));
  changed(true);
}

// What is drawn.

function background() {
  const [r, g, b] = getComputedStyle(document.documentElement).getPropertyValue('--back').trim().match(/[0-9a-f]{2}/gi);
  return [r, g, b].map((part) => parseInt(part, 16) / 255);
}

function cutPlane() {
  const axis = byId('axis').value;
  if (axis === '') return null;
  const half = facts.mesh.size[axis] / 2 / frame.radius * 1.001, place = half * (byId('cut').value / 500 - 1);
  return {axis: Number(axis), place, sign: byId('other_side').checked ? -1 : 1, reach: 1.01 * reach};
}

function makeScene() {
  const cut = cutPlane(), {low, high, values} = state, section = [0, 0, 0, 1];
  if (cut) {
    section[cut.axis] = cut.sign;
    section[3] = cut.sign * cut.place;
  }
  const mode = shadings[state.shading].array === 'colours' ? 2 : state.shading > 0 ? 1 : 0;
  const look = {mode, base: clay, backs: clayBack, alpha: 1, creaseInk: [.05, .05, .04, 1]};
  if (mode === 1) {
    // A value's number counts from the least value to the greatest, the ramp from low to high.
    const size = high > low ? high - low : 1;
    look.share = [(values.hi - values.lo) / 65000 / size, (values.lo - low) / size];
  }
  const show = reference ? byId('show').value : 'mesh', parts = [];
  if (show !== 'reference') parts.push({surface: mesh, look});
  if (show !== 'mesh') {
    parts.push({surface: reference, look: {mode: 0, base: blue, backs: blueBack, alpha: show === 'both' ? .4 : 1,
      creaseInk: [.02, .1, .4, 1]}});
  }
  return {...matrices(), cut, section, parts, background: background(), quick: state.moving && state.slow,
    flatFaces: byId('flat').checked, edges: byId('edges').checked, edgeInk: [0, 0, 0, .45],
    creases: byId('creases').checked ? Number(byId('degrees').value) : 0, lineWidth: 2.2 * (devicePixelRatio || 1)};
}

function resize() {
  const canvas = drawing.canvas, scale = Math.min(2, devicePixelRatio || 1);
  const width = Math.max(1, Math.round(canvas.clientWidth * scale));
  const height = Math.max(1, Math.round(canvas.clientHeight * scale));
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, {width, height});
}

function drawNow() {
  resize();
  drawing.draw(makeScene());
}

const times = [];  // When the last frames of one movement were drawn, in milliseconds.

/// Draws soon. \param moves whether this is one of many steps: few triangles do, where the machine is slow.
function changed(moves = false) {
  if (moves) {
    state.moving = true;
    clearTimeout(settle);
    settle = setTimeout(() => {
      state.moving = false;
      times.length = 0;
      changed();
    }, 250);
  }
  if (asked || !mesh) return;
  asked = true;
  requestAnimationFrame((now) => {
    asked = false;
    drawNow();
    if (!state.moving) return;
    times.push(now);
    if (times.length > 4) state.slow = state.slow || (now - times.shift()) / 4 > 45;
  });
}

// Colours and their legend.

function showLegend() {
  const shading = shadings[state.shading], bar = byId('legend_bar');
  byId('legend').hidden = !state.values;
  if (!state.values) return;
  const stops = [];
  for (let i = 0; i <= 16; ++i) {
    const at = i / 4, low = Math.min(3, Math.floor(at));
    stops.push('rgb(' + [0, 1, 2].map((k) => Math.round(255 * Math.sqrt(
        facts.ramp[low][k] + (facts.ramp[low + 1][k] - facts.ramp[low][k]) * (at - low)))).join(',') + ')');
  }
  bar.style.background = 'linear-gradient(90deg,' + stops.join(',') + ')';
  byId('legend_name').textContent = shading.name;
  byId('low').value = digits(state.low);
  byId('high').value = digits(state.high);
  byId('legend_unknown').hidden = shading.unknown === 0;
}

const unpacked = new Map();

async function chooseShading(index) {
  const shading = shadings[index], areColours = shading.array === 'colours';
  if (shading.array && !unpacked.has(index)) unpacked.set(index, await unpackNumbers(shading.array));
  if (shading.array) drawing.setValues(mesh, unpacked.get(index), areColours);
  state.shading = index;
  state.values = shading.array && !areColours ? shading : null;
  if (state.values) [state.low, state.high] = [shading.lo, shading.hi];
  byId('shading').value = index;
  showLegend();
  changed();
}

// What changes them.

function updateTexts() {
  byId('degrees_text').textContent = byId('degrees').value + '°';
  const cut = cutPlane();
  byId('cut').disabled = byId('other_side').disabled = !cut;
  byId('cut_text').textContent = cut ? 'xyz'[cut.axis] + ' = ' + digits(frame.center[cut.axis] + cut.place * frame.radius) : '';
  changed();
}

function listenToPointers(canvas) {
  const down = new Map();
  const middle = () => {
    const [a, b] = [...down.values()];
    return {x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, apart: Math.hypot(a.x - b.x, a.y - b.y)};
  };
  canvas.addEventListener('pointerdown', (e) => {
    canvas.setPointerCapture(e.pointerId);
    down.set(e.pointerId, {x: e.clientX, y: e.clientY});
  });
  canvas.addEventListener('pointermove', (e) => {
    const last = down.get(e.pointerId);
    if (!last || down.size > 2) return;
    const before = down.size === 2 ? middle() : last, x = e.clientX, y = e.clientY;
    down.set(e.pointerId, {x, y});
    if (down.size === 2) {
      const now = middle();
      move(now.x - before.x, now.y - before.y);
      if (before.apart > 0 && now.apart > 0) zoom(before.apart / now.apart);
    } else if (e.buttons & 6 || e.shiftKey) {
      move(x - last.x, y - last.y);
    } else {
      turn((last.x - x) * .008, (y - last.y) * .008);
    }
  });
  for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, (e) => down.delete(e.pointerId));
  canvas.addEventListener('contextmenu', (e) => e.preventDefault());
  canvas.addEventListener('wheel', (e) => {
    e.preventDefault();
    zoom(Math.exp(Math.max(-200, Math.min(200, e.deltaY * (e.deltaMode ? 30 : 1))) * .0015));
  }, {passive: false});
}

function click(id) {
  byId(id).click();
}
function nextOf(id, value) {
  const list = byId(id);
  list.selectedIndex = value === undefined ? (list.selectedIndex + 1) % list.options.length :
      list.value === value ? 0 : [...list.options].findIndex((o) => o.value === value);
  list.dispatchEvent(new Event('change'));
}
function slide(id, by) {
  byId(id).value = Number(byId(id).value) + by;
  byId(id).dispatchEvent(new Event('input'));
}

const keys = {
  '+': () => zoom(.9), '=': () => zoom(.9), '-': () => zoom(1 / .9), '0': fit,
  'e': () => click('edges'), 'f': () => click('flat'), 'c': () => click('creases'), 'i': () => click('other_side'),
  'x': () => nextOf('axis', '0'), 'y': () => nextOf('axis', '1'), 'z': () => nextOf('axis', '2'),
  '[': () => slide('cut', -10), ']': () => slide('cut', 10), 'p': () => nextOf('shading'),
  'r': () => reference && nextOf('show'),
};
const arrows = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};

function listenToKeys() {
  addEventListener('keydown', (e) => {
    if (e.ctrlKey || e.altKey || e.metaKey || /^(INPUT|SELECT)$/.test(e.target.tagName) && e.target.type !== 'checkbox') return;
    const view = byId('panel').querySelectorAll('[data-view]')[Number(e.key) - 1];
    const arrow = arrows[e.key], known = arrow || view || keys[e.key.toLowerCase()];
    if (!known) return;
    e.preventDefault();
    if (arrow && e.shiftKey) move(arrow[0] * 30, arrow[1] * 30);
    else if (arrow) turn(-arrow[0] * .1, arrow[1] * .1);
    else if (view) view.click();
    else known();
  });
}

function listen() {
  listenToPointers(drawing.canvas);
  listenToKeys();
  for (const id of ['edges', 'flat', 'creases', 'degrees', 'cut', 'other_side']) byId(id).addEventListener('input', updateTexts);
  for (const id of ['axis', 'show']) byId(id).addEventListener('change', updateTexts);
  byId('degrees').addEventListener('input', () => { byId('creases').checked = true; });
  byId('shading').addEventListener('change', () => chooseShading(Number(byId('shading').value)));
  for (const id of ['low', 'high']) {
    byId(id).addEventListener('change', () => {
      const value = parseFloat(byId(id).value);
      if (Number.isFinite(value)) state[id] = value;
      showLegend();
      changed();
    });
  }
  byId('whole').addEventListener('click', () => chooseShading(state.shading));
  for (const button of byId('panel').querySelectorAll('[data-view]'))
    button.addEventListener('click', () => lookFrom(button.dataset.view.split(' ').map(Number)));
  byId('fit').addEventListener('click', fit);
  new ResizeObserver(() => changed()).observe(drawing.canvas);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => changed());
  drawing.canvas.addEventListener('webglcontextlost', () => {
    byId('message').textContent = 'The graphics processor has lost the mesh. Reload the page.';
  });
}

function describe() {
  const count = (n) => n.toLocaleString('en');
  const lines = [`${count(facts.mesh.triangles)} triangles, ${count(facts.mesh.vertices)} vertices` +
      (facts.mesh.quads > 0 ? `, ${count(facts.mesh.quads)} quads of two each` : '')];
  if (reference) lines.push(`reference: ${count(facts.reference.triangles)} triangles`);
  if (facts.mesh.lostFaces > 0) lines.push(`${count(facts.mesh.lostFaces)} faces without finite corners are left out`);
  lines.push(facts.mesh.size.map(digits).join(' × '), `coordinates rounded to ${digits(facts.mesh.step)}`);
  if (!mesh.closed) lines.push('not closed, so sections are not filled');
  byId('figures').textContent = lines.join('\n');
}

async function begin() {
  if (typeof DecompressionStream === 'undefined')
    throw new Error('this browser cannot unpack it: that takes Chrome 80, Firefox 113, Safari 16.4 or later');
  drawing = new Drawing(byId('view'));
  const surface = await makeSurface('mesh', frame);
  drawing.prepare(surface);
  if (facts.reference) {
    reference = await makeSurface('reference', frame);
    drawing.prepare(reference);
    byId('show_row').hidden = false;
    for (let v = 0; v < 3 * reference.vertices; v += 3)
      reach = Math.max(reach, Math.hypot(...reference.places.subarray(v, v + 3)));
  }
  shadings.forEach((shading, i) => byId('shading').add(new Option(shading.name, i)));
  byId('panel').open = innerWidth > 640;
  listen();
  mesh = surface;
  fit();
  lookFrom(facts.view);
  updateTexts();
  describe();
  await chooseShading(reference ? shadings.length - facts.shadings.length : 0);
  drawNow();
  byId('message').textContent = '';
  document.body.dataset.ready = 'true';
}

begin().catch((error) => {
  byId('message').textContent = 'The mesh cannot be shown: ' + error.message + '.';
  document.body.dataset.ready = 'false';
});
