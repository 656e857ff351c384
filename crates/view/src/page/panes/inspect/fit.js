// Numbers in fields without room for all of their figures: fewer of them in place of a cut, which would be another number.
const pen = document.createElement('canvas').getContext('2d');
const told = new WeakMap();

const sizes = new ResizeObserver((entries) => {
  for (const { target, contentRect } of entries) {
    if (target.isConnected) told.get(target)(contentRect.width);
    else sizes.unobserve(target);
  }
});

/** Calls `change` with the room for text in a field, now and when it is another one. @param {HTMLElement} field @param {function(number): void} change */
export function watchRoom(field, change) {
  told.set(field, (room) => {
    const { fontWeight, fontSize, fontFamily } = getComputedStyle(field); // `font` is empty where figures are all as wide
    pen.font = `${fontWeight} ${fontSize} ${fontFamily}`;
    change(room);
  });
  sizes.observe(field);
}

/** All figures are as wide as a zero. */
const fits = (text, room) => pen.measureText(text.replace(/\d/g, '0')).width <= room;

/**
 * A number as near to itself as there is room for; dots where there is none.
 * @param {string} full as it is where there is room @param {number} x @param {number} room pixels; 0 where nobody knows
 */
export function fitted(full, x, room) {
  if (!room || !Number.isFinite(x) || fits(full, room)) return full;
  const forms = [3, 2, 1, 0].flatMap((digits) => [x.toFixed(digits), x.toExponential(digits).replace('e+', 'e')]);
  const wrong = (text) => Math.abs(Number(text) - x);
  const nearest = (best, text) => (best === null || wrong(text) < wrong(best) || (wrong(text) === wrong(best) && text.length < best.length) ? text : best);
  return forms.filter((text) => fits(text, room)).reduce(nearest, null) ?? '…';
}
