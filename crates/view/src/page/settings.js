// What the page remembers between visits: panels, their sizes, options. Nothing of the scene.

const KEY = 'swanilda-view';

/** @returns {Object<string, any>} */
function stored() {
  try {
    return JSON.parse(localStorage.getItem(KEY) ?? '{}') ?? {};
  } catch {
    return {}; // a browser that keeps nothing, or text of something else
  }
}

const values = stored();

/** The number by which this window says who it is, also when its page is loaded again. */
export const AUTHOR = numberOfWindow();

function numberOfWindow() {
  const fresh = Math.floor(Math.random() * 2 ** 50);
  try {
    sessionStorage[KEY] ??= fresh;
    return Number(sessionStorage[KEY]);
  } catch {
    return fresh;
  }
}

/** @template T @param {string} name @param {T} initial @returns {T} */
export function setting(name, initial) {
  return Object.hasOwn(values, name) && typeof values[name] === typeof initial ? values[name] : initial;
}

/** @param {string} name @param {any} value */
export function remember(name, value) {
  values[name] = value;
  try {
    localStorage.setItem(KEY, JSON.stringify(values));
  } catch {
    // Then it is remembered until the page closes.
  }
}
