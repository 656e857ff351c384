// Curves as files: tables of comma separated values, and pictures in SVG.
import { el } from '../../dom.js';

const SIZE = [900, 420];
const MARGIN = { left: 64, right: 16, top: 16, bottom: 44 };

/** A table with a row for each time and a column for each curve; gaps are empty. @param {{name: string, unit?: string, x: ArrayLike<number>, y: ArrayLike<number>}[]} curves */
export function csv(curves) {
  const rows = new Map();
  curves.forEach(({ x, y }, k) => {
    for (let i = 0; i < Math.min(x.length, y.length); i++) {
      if (!rows.has(x[i])) rows.set(x[i], new Array(curves.length).fill(''));
      if (Number.isFinite(y[i])) rows.get(x[i])[k] = String(y[i]);
    }
  });
  const sorted = [...rows].sort(([a], [b]) => a - b).map(([time, cells]) => [time, ...cells].join(','));
  return [['time', ...curves.map(titled)].map(quoted).join(','), ...sorted, ''].join('\n');
}

const titled = ({ name, unit }) => (unit ? `${name} [${unit}]` : name);
const quoted = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
const escaped = (text) => text.replace(/[&<>"]/g, (letter) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' })[letter]);

/**
 * A picture with axes and a legend.
 * @param {any[]} curves with a `color` each @param {{extent: function, ticks: function, label: function}} axes as on the page
 */
export function picture(curves, { extent, ticks, label }) {
  const [width, height] = SIZE;
  const legend = 18 * curves.length;
  const bottom = height - MARGIN.bottom;
  const x = scale(extent(curves.map((curve) => curve.x), 0), MARGIN.left, width - MARGIN.right);
  const y = scale(extent(curves.map((curve) => curve.y)), bottom, MARGIN.top);
  const line = (a, b, c, d) => `<line x1="${a}" y1="${b}" x2="${c}" y2="${d}" stroke="#d0d5dc"/>`;
  const text = (at, to, words, anchor) => `<text x="${at}" y="${to}" text-anchor="${anchor}">${escaped(words)}</text>`;
  const upright = ticks(x.low, x.high, 9).map((v) => line(x.at(v), MARGIN.top, x.at(v), bottom) + text(x.at(v), bottom + 18, label(v), 'middle'));
  const level = ticks(y.low, y.high, 8).map((v) => line(MARGIN.left, y.at(v), width - MARGIN.right, y.at(v)) + text(MARGIN.left - 6, y.at(v) + 4, label(v), 'end'));
  const lines = curves.map((curve) => `<polyline fill="none" stroke="${curve.color}" stroke-width="1.5" points="${points(curve, x, y)}"/>`);
  const names = curves.map((curve, i) => `<rect x="${MARGIN.left}" y="${height + 18 * i}" width="14" height="3" fill="${curve.color}"/>${text(MARGIN.left + 20, height + 18 * i + 6, titled(curve), 'start')}`);
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height + legend}" viewBox="0 0 ${width} ${height + legend}" font-family="sans-serif" font-size="12">
<rect width="100%" height="100%" fill="#fff"/>
${[...upright, ...level, text(width - MARGIN.right, bottom + 36, 'time in s', 'end'), ...lines, ...names].join('\n')}
</svg>
`;
}

function scale([low, high], from, to) {
  return { low, high, at: (v) => +(from + ((v - low) / (high - low)) * (to - from)).toFixed(2) };
}

function points({ x: xs, y: ys }, x, y) {
  const all = [];
  for (let i = 0; i < Math.min(xs.length, ys.length); i++) if (Number.isFinite(ys[i])) all.push(`${x.at(xs[i])},${y.at(ys[i])}`);
  return all.join(' ');
}

/** Gives a text to the person, as a file. */
export function download(name, type, content) {
  const address = URL.createObjectURL(new Blob([content], { type }));
  el('a', { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}
