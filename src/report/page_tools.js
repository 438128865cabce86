const data = JSON.parse(document.getElementById('data').textContent);
const byId = id => document.getElementById(id);

function show(value) {
  if (value === null || value === undefined || !isFinite(value)) return '–';
  if (value === 0) return '0';
  const size = Math.abs(value);
  return size >= 1e5 || size < 1e-3 ? value.toExponential(2) : String(Number(value.toPrecision(3)));
}
function make(parent, name, attributes, text) {
  const element = parent.namespaceURI.endsWith('svg') || name === 'svg'
    ? document.createElementNS('http://www.w3.org/2000/svg', name) : document.createElement(name);
  for (const key in attributes || {}) element.setAttribute(key, attributes[key]);
  if (text !== undefined) element.textContent = text;
  return parent.appendChild(element);
}
function row(table, cells, tag) {
  const line = make(table, 'tr');
  for (const cell of cells) make(line, tag || 'td', {}, cell);
}
// Lets one image be wiped over another: `over` and `bar` lie on `box`, `slider` goes from 0 to 100.
function makeWipe(box, over, bar, slider) {
  const set = percent => {
    slider.value = percent;
    over.style.clipPath = `inset(0 ${100 - percent}% 0 0)`;
    bar.style.left = `calc(${percent}% - 1px)`;
  };
  const wipeTo = event => {
    const area = box.getBoundingClientRect();
    set(Math.min(100, Math.max(0, 100 * (event.clientX - area.left) / area.width)));
  };
  slider.addEventListener('input', () => set(slider.value));
  box.addEventListener('pointerdown', event => { box.setPointerCapture(event.pointerId); wipeTo(event); });
  box.addEventListener('pointermove', event => { if (event.buttons) wipeTo(event); });
  set(slider.value);
}
