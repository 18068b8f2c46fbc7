// Uses the page as a person does; check.py runs these functions in it.

const frames = count => new Promise(done => {
  const next = () => count-- > 0 ? requestAnimationFrame(next) : done();
  next();
});

async function mouse(kind, x, y) {
  Module.canvas.dispatchEvent(new MouseEvent(kind, {clientX: x, clientY: y, button: 0, bubbles: true}));
  await frames(2);
}

async function click(x, y) {
  await mouse('mousemove', x, y);
  await mouse('mousedown', x, y);
  await mouse('mouseup', x, y);
}

// keyCode is what GLFW's library reads.
async function key(code, keyCode) {
  for (const kind of ['keydown', 'keyup']) {
    window.dispatchEvent(new KeyboardEvent(kind, {key: code, code, keyCode, bubbles: true}));
    await frames(2);
  }
}

async function see() {
  Module._see();
  await frames(2);
  Module._see();
  return Module.facts;
}

// Presses every control that it can reach, each once; what opens others as often as these need it.
async function pressEverything(limit) {
  const pressed = new Map();  // control: what its first press showed
  let presses = 0;
  await see();
  const visible = () => Module.controls;
  const fresh = () => visible().filter(each => !pressed.has(each.id));
  const opens = each => (pressed.get(each.id) || []).some(child => !pressed.has(child));
  let before = new Set(visible().map(each => each.id));
  for (; presses < limit; ++presses) {
    await see();
    const next = fresh().pop() || visible().find(opens);
    if (!next) {
      const count = visible().length;
      await key('Escape', 27);
      await see();
      if (!fresh().length && !visible().some(opens) && visible().length >= count) break;
      continue;
    }
    before = new Set(visible().map(each => each.id));
    const first = !pressed.has(next.id);
    if (first) pressed.set(next.id, []);
    await click(next.x, next.y);
    await see();
    const shown = visible().filter(each => !before.has(each.id)).map(each => each.id);
    if (first) pressed.set(next.id, shown);
    else if (!shown.some(id => !pressed.has(id))) pressed.set(next.id, []);  // they are gone for good
  }
  return {presses, pressed: pressed.size, left: fresh().map(each => each.label)};
}
