// Help of a viewer, opened by ?.

// Pointer actions, which have no keys.
const POINTER_HELP = [
  ['wheel', 'zoom about the pointer'],
  ['drag', 'move the picture; with Shift choose a rectangle']
];

// Returns [keys, text] of the commands of a group.
function helpRows(commands) {
  const rows = [];
  for (const command of commands) {
    if (command.row === null || (!command.keys.length && !command.row)) continue;
    rows.push(command.row || [keysText(command), command.title]);
  }
  return rows;
}

function makeHelp(commands, pointerHelp = POINTER_HELP) {
  const groups = new Map();
  for (const command of commands) {
    if (!groups.has(command.group)) groups.set(command.group, []);
    groups.get(command.group).push(command);
  }
  const table = (title, rows) => make(
      'table', {}, make('caption', {}, title),
      make('tbody', {}, ...rows.map(([keys, what]) => make(
          'tr', {}, make('th', {scope: 'row'}, keys), make('td', {}, what)))));
  const tables = Array.from(groups, ([title, list]) => [title, helpRows(list)])
                     .filter(([, rows]) => rows.length).map(pair => table(...pair));
  const close = make('button', {type: 'button'}, 'Close');
  const dialog = make('dialog', {class: 'help', 'aria-label': 'Keys of the image viewer'},
                      make('div', {class: 'help-head'}, make('h2', {}, 'Keys of the image viewer'),
                           close),
                      make('p', {}, 'Keys go to the viewer that has the focus, else to the one ' +
                                    'that fills most of the window.'),
                      make('div', {class: 'help-tables'}, ...tables,
                           table('Pointer', pointerHelp)));
  close.addEventListener('click', () => dialog.close());
  closeBeside(dialog);
  document.body.append(dialog);
  document.addEventListener('help', () => dialog.showModal());
  return dialog;
}
