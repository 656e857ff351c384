// What a page can do beyond looking: tools, gizmo, new objects, changes of the tree, pulling, files.
import { AddMenu } from './add_menu.js';
import { Edits } from './edits.js';
import { Files } from './files.js';
import { Gizmo } from './gizmo.js';
import { Pull } from './pull.js';
import { Toolbar, toolOptions } from './toolbar.js';
import { TreeEdits } from './tree_edits.js';

export class Studio {
  /** @param {any} page */
  constructor(page) {
    this.page = page;
    this.options = toolOptions();
    this.edits = new Edits(page);
    this.files = new Files(page, this.edits);
    this.toolbar = new Toolbar(this);
    this.addMenu = new AddMenu(page, this.edits, this.toolbar.add);
    this.treeEdits = new TreeEdits(page, this);
    const stage = document.getElementById('stage');
    if (page.renderer) this._gizmo(stage);
    stage.append(this.toolbar.element, this.addMenu.panel);
    addEventListener('pointerdown', (event) => this._pressed(event), true);
  }

  _gizmo(stage) {
    this.gizmo = new Gizmo(this.page, this.edits, this.options);
    this.pull = new Pull(this.page, this.edits, this.options);
    stage.append(this.gizmo.figure, this.pull.figure, this.gizmo.label, this.pull.label);
  }

  /** Menus close when something else is pressed. */
  _pressed({ target }) {
    if (this.addMenu.open && !this.addMenu.panel.contains(target) && !this.toolbar.add.contains(target)) this.addMenu.toggle(false);
  }

  addBelow() {
    this.addMenu.below.checked = true;
    this.addMenu.toggle(true);
  }

  /** @returns {boolean} whether anything was open */
  close() {
    if (this.addMenu.open) return this.addMenu.toggle(false), true;
    if (this.options.tool !== 'select') return this.toolbar.choose('select'), true;
    return false;
  }

  /** After each picture of the scene. */
  frame() {
    this.gizmo?.draw();
    this.pull?.draw();
  }
}

/** Keys of the studio, as in panes/help.js. @param {any} page */
export function studioKeys(page) {
  const key = (keys, shown, text, action) => ({ group: 'Build', keys, shown, text, action: () => action(page.studio) });
  return [
    key(['q'], 'Q', 'select', ({ toolbar }) => toolbar.choose('select')),
    key(['m'], 'M', 'move; while the simulation runs pull', ({ toolbar }) => toolbar.choose('move')),
    key(['r'], 'R', 'turn', ({ toolbar }) => toolbar.choose('turn')),
    key(['a'], 'A', 'add an object', ({ addMenu }) => addMenu.toggle()),
    key(['b'], 'B', 'drop onto what is below', ({ edits }) => edits.ofChosen('drop')),
    key(['F2'], 'F2', 'rename', ({ treeEdits }) => treeEdits.rename()),
    key(['Delete', 'Backspace'], 'Del', 'delete with all that is below', ({ edits }) => edits.ofChosen('remove')),
    key(['ctrl+d'], 'Ctrl+D', 'duplicate', ({ edits }) => edits.ofChosen('duplicate')),
    key(['ctrl+g'], 'Ctrl+G', 'group shapes', ({ edits }) => edits.group()),
    key(['ctrl+shift+g'], 'Ctrl+Shift+G', 'ungroup', ({ edits }) => edits.ungroup()),
    key(['ctrl+z'], 'Ctrl+Z', 'undo', ({ edits }) => edits.back('undo')),
    key(['ctrl+shift+z', 'ctrl+y'], 'Ctrl+Shift+Z', 'redo', ({ edits }) => edits.back('redo')),
    key(['ctrl+s'], 'Ctrl+S', 'save', ({ files }) => files.save()),
    key(['ctrl+o'], 'Ctrl+O', 'open files', ({ files }) => files.choose()),
  ];
}
