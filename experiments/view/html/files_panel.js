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

// Commands of a folder of results with several tables; none otherwise.
function makeTableCommands(page) {
  const {tables} = page.hello, group = 'Images';
  if (tables.length < 2) return [];
  return [
    {id: 'previous-table', keys: ['PageUp'], group, title: 'previous table of the results',
     run: () => stepTable(page, -1)},
    {id: 'next-table', keys: ['PageDown'], group, title: 'next table of the results',
     run: () => stepTable(page, 1)},
    ...tables.map(name => ({id: `table-${name}`, keys: [], group, title: `table ${name}`,
                            run: () => page.session.send({do: 'table', name})}))
  ];
}

// Shows the table that stands `by` places further; the last one is before the first one.
function stepTable(page, by) {
  const {tables} = page.hello, n = tables.length;
  const name = tables[(tables.indexOf(page.state.table) + by + n) % n];
  page.session.sendNewest('table', {do: 'table', name});
}
