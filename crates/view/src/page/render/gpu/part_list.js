// The parts of a batch. Each knows its place, so that one goes without a search.

export class PartList {
  constructor() {
    this.parts = [];
    this.stale = true;
  }

  add(part) {
    this.stale = true;
    part.place = this.parts.push(part) - 1;
  }

  remove(part) {
    const last = this.parts.pop();
    if (last !== part) {
      this.parts[part.place] = last;
      last.place = part.place;
    }
    this.stale = true;
  }
}
