// Errors and times of images of files, a row each, and the reference they are measured against.

// [key, title, help, number(pane), digits]
const FILE_COLUMNS = [
  ['mse', 'MSE', 'mean squared error against the reference', pane => pane.mse?.value, 3],
  ['relmse', 'relMSE', 'the same, relative to the reference squared', pane => pane.relmse?.value,
   3],
  ['energy', 'energy', 'mean of the image over mean of the reference; 1 is right',
   pane => pane.energy?.value, 4],
  ['ms', 'ms', 'milliseconds: of a run the median frame, of render the whole picture',
   pane => pane.ms, 3]
];

class FilesNumbers {
  constructor() {
    this.names = [];
    this.body = make('tbody', {});
    this.reference = make('p', {class: 'line-text', 'data-number': 'reference'});
    const heads = FILE_COLUMNS.map(([key, title, help]) => make(
        'th', {scope: 'col', class: 'num', title: help, 'data-column': key}, title));
    this.table = make('table', {class: 'numbers-table files'},
                      make('thead', {}, make('tr', {}, make('th', {scope: 'col'}, 'image'),
                                             ...heads)), this.body);
    this.element = make('section', {class: 'numbers-box', 'aria-label': 'Numbers'}, this.table,
                        this.reference);
  }

  showNames(names) { this.names = names; }

  show({panes, reference}) {
    const columns = FILE_COLUMNS.map(([key, , , of, digits]) => {
      const numbers = panes.map(pane => of(pane) ?? null);
      return {key, numbers, texts: alignedTexts(numbers, digits, NOTHING)};
    });
    // A column of nothing has no numbers: times that no file says, errors without a reference.
    for (const {key, numbers} of columns) {
      this.table.querySelector(`[data-column=${key}]`).hidden = numbers.every(one => one === null);
    }
    const known = columns.filter(({numbers}) => numbers.some(one => one !== null));
    this.body.replaceChildren(...panes.map((_, i) => make(
        'tr', {}, make('th', {scope: 'row', title: this.names[i]}, this.names[i]),
        ...known.map(({key, numbers, texts}) => make(
            'td', {class: 'num', 'data-number': key, title: numbers[i]}, texts[i])))));
    setText(this.reference, reference ? `reference: ${reference.spp} spp` : 'no reference');
  }
}
