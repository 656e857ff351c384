// The style sheets of CodeMirror without `<style>` elements, which the page's policy forbids: the document adopts one sheet with all rules.
// Packages that import `style-mod` get this in its place.
import { StyleModule as Rules } from './style-mod.js';

let sheet = null;
let mounted = [];

export class StyleModule extends Rules {
  /** Later modules take precedence. @param {Document} root @param {Rules | Rules[]} modules */
  static mount(root, modules) {
    const added = [modules].flat();
    if (added.every((module) => mounted.includes(module))) return;
    mounted = [...added, ...mounted.filter((module) => !added.includes(module))];
    if (!sheet) root.adoptedStyleSheets.unshift((sheet = new CSSStyleSheet()));
    sheet.replaceSync(mounted.map((module) => module.getRules()).join('\n'));
  }
}
