// Banners of scripts (simUI.bannerCreate): lines with buttons above the scene.
import { el } from '../dom.js';

export class BannersPane {
  constructor(page) {
    this.page = page;
    this.list = el('div', { class: 'banners' });
    document.getElementById('stage').append(this.list);
    page.store.on('banners', () => this.list.replaceChildren(...page.store.banners.map((banner) => this._banner(banner))));
  }

  _banner({ id, text, buttons }) {
    const press = (key) => this.page.ask('ui', { window: null, widget: null, input: { type: 'banner', banner: id, key } });
    return el('div', { class: 'banner', role: 'status' }, el('span', {}, text), ...buttons.map(({ key, label }) => el('button', { type: 'button', class: 'answer-button', disabled: !this.page.canWrite, onclick: () => press(key) }, label)));
  }
}
