// Warnings of the program's start, and what is wrong with the picture now.

const NOTHING_LIT = 'Nothing lit in view: every pixel is black.';

class Warnings {
  constructor() {
    this.list = new HeaderList('warnings', 'what the program warned of', true);
    this.note = make('p', {class: 'stage-note', role: 'status', hidden: ''}, NOTHING_LIT);
    this.ofStart = [];
    this.isNothingLit = false;
  }

  greet({warnings}) {
    this.ofStart = warnings || [];
    this.show();
  }

  // `numbers` as the program sends them.
  follow({nothing_lit: isNothingLit}) {
    if (isNothingLit === this.isNothingLit) return;
    this.isNothingLit = isNothingLit;
    this.note.hidden = !isNothingLit;
    this.show();
  }

  show() {
    const texts = this.isNothingLit ? [NOTHING_LIT, ...this.ofStart] : this.ofStart;
    this.list.show(texts.map(text => ({text})));
  }
}
