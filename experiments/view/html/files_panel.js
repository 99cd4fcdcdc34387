// Panel in the place of that of methods while images of files are shown, and the choice of a table
// of a folder of results.

class FilesPanel {
  constructor() {
    this.element = make('p', {class: 'hint'}, 'Images of files: nothing renders here, and there ' +
                                              'is nothing to change.');
  }

  show() {}
}

function makeTableChoice(page) {
  return makeSelect(page.hello.tables.map(name => ({value: name, text: name})),
                    name => page.session.send({do: 'table', name}), {'data-setting': 'table'});
}

// Shows the table that stands `by` places further; the last one is before the first one.
function stepTable(page, by) {
  const {tables} = page.hello, n = tables.length;
  const name = tables[(tables.indexOf(page.state.table) + by + n) % n];
  page.session.sendNewest('table', {do: 'table', name});
}
