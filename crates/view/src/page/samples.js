// Numbers that parts of the page follow at every step: one request for all of them, and what comes goes to who asked for it.

export class Samples {
  constructor(page) {
    this.page = page;
    this.wanted = new Map(); // by who wants them: items, and what takes their numbers
    this.key = 0;
    page.store.on('samples', (messages) => messages.forEach((message) => this._take(message)));
  }

  /**
   * @param {any} who @param {{handle: number, name: string, index?: number | null}[]} items instead of those from before
   * @param {function(number[], (number | null)[][]): void} take times, and the numbers of each item
   */
  follow(who, items, take) {
    if (!this.page.source.live || (!items.length && !this.wanted.has(who))) return;
    if (items.length) this.wanted.set(who, { items, take });
    else this.wanted.delete(who);
    this.key++;
    const all = [...this.wanted.values()].flatMap((each) => each.items.map(({ handle, name, index = null }) => ({ handle, name, index })));
    this.page.source.request('sample', { key: this.key, items: all }).catch((error) => this.page.console.say('error', error.message));
  }

  /** @param {{key: number, times: number[], values: (number | null)[][]}} message of what is followed now, or of what was */
  _take({ key, times, values }) {
    if (key !== this.key) return;
    let from = 0;
    for (const { items, take } of [...this.wanted.values()]) {
      take(times, values.slice(from, from + items.length));
      from += items.length;
    }
  }
}
