// Table below a viewer: one row per image, with its key, its mean error and its values at the pixel
// under the pointer.
const PARTS = [{part: 'mean', digits: 3}, ...['r', 'g', 'b'].map(part => ({part, digits: 6})),
               {part: 'here', digits: 3}];

class ImageList {
  // `whole`: the images are not crops.
  constructor(images, whole, camera, actions) {
    Object.assign(this, {images, whole, camera, actions});
    const head = make('tr', {}, make('th', {scope: 'col'}, 'key'),
                      make('th', {scope: 'col'}, 'image'),
                      make('th', {scope: 'col'}, 'left'),
                      make('th', {scope: 'col', title: 'what errors are against'}, 'against'),
                      this.meanTitle = make('th', {scope: 'col', class: 'num'}),
                      make('th', {scope: 'col', class: 'num'}, 'R'),
                      make('th', {scope: 'col', class: 'num'}, 'G'),
                      make('th', {scope: 'col', class: 'num'}, 'B'),
                      this.hereTitle = make('th', {scope: 'col', class: 'num'}));
    this.body = make('tbody', {});
    this.build();
    this.table = make('table', {class: 'images'}, make('thead', {}, head), this.body);
    this.element = make('div', {class: 'scroll', role: 'region', tabindex: 0,
                                'aria-label': 'Images and their values'}, this.table);
  }

  // Makes the rows; called again for other images.
  build() {
    this.rows = this.images.map((image, i) => this.makeRow(image, i, this.actions));
    this.body.replaceChildren(...this.rows.map(row => row.element));
  }

  makeRow(image, i, actions) {
    const name = make('button', {type: 'button', class: 'name', title: 'show this image'},
                      image.name);
    name.addEventListener('click', () => actions.choose(i));
    const left = make('button', {type: 'button', class: 'left',
                                 'aria-label': `${image.name} left of the divider`,
                                 title: 'show left of a divider (d: the next one)'});
    left.addEventListener('click', () => actions.left(i));
    const compare = make('button', {type: 'button', class: 'compare',
                                    'aria-label': `compare with ${image.name}`,
                                    title: `errors against this image (Shift+${i + 1})`});
    compare.addEventListener('click', () => actions.compare(i));
    const note = make('span', {class: 'bad'});
    const values = PARTS.map(({part}) => make('td', {class: 'num', 'data-part': part}));
    const element = make('tr', {}, make('td', {}, i < 9 ? make('kbd', {}, String(i + 1)) : ''),
                         make('th', {scope: 'row'}, name, note), make('td', {}, left),
                         make('td', {}, compare),
                         ...values);
    return {element, name, left, compare, note, values};
  }

  // `pixel`: {x, y} or null.
  show(state, painter, pixel) {
    const kind = state.error;
    const metric = kind === 'none' ? '' : ERRORS[kind].metric;
    this.table.classList.toggle('plain', kind === 'none');
    setText(this.meanTitle, metric && !this.whole ? `${metric}, crop` : metric);
    this.meanTitle.title = metric && `mean over the pixels here, against ${
        this.images[state.compare].name}`;
    setText(this.hereTitle, kind === 'none' ? '' : 'error here');
    const cells = this.images.map((image, i) => {
      const plane = kind !== 'none' && i !== state.compare &&
          areComparable(image, this.images[state.compare]) ? painter.plane(kind, i) : null;
      const isThere = pixel && image.data && !isOldImage(image);
      const at = isThere ? this.camera.indexIn(image, pixel) : -1;
      return [plane ? plane.mean : null,
              ...[0, 1, 2].map(c => at < 0 ? null : image.data[3 * at + c]),
              plane && at >= 0 ? plane.values[at] : null];
    });
    const texts = PARTS.map(({digits}, k) => alignedTexts(cells.map(row => row[k]), digits));
    this.rows.forEach((row, i) => {
      const image = this.images[i];
      row.element.classList.toggle('current', i === state.current);
      row.name.setAttribute('aria-pressed', i === state.current);
      row.left.setAttribute('aria-pressed', state.mode === 'wipe' &&
                                                i === leftImage(state, this.images));
      row.compare.setAttribute('aria-pressed', i === state.compare);
      setText(row.name, image.name);
      setText(row.note, image.nonfinite.length ? ` ${image.nonfinite.length} non-finite` : '');
      row.values.forEach((cell, k) => {
        setText(cell, texts[k][i]);
        const whole = cells[i][k] === null ? '' : exactFloat(cells[i][k]);
        if (cell.title !== whole) cell.title = whole;
      });
    });
  }
}
