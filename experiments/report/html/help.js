// The keys of a viewer, as ? shows them.

// What has no key of its own.
const POINTER_HELP = [
  ['wheel', 'zoom about the pointer'],
  ['drag', 'move the picture']
];

// [keys, text] of the commands of a group.
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
  const body = (title, rows) => make(
      'tbody', {}, make('tr', {}, make('th', {colspan: 2, scope: 'rowgroup', class: 'group-title'},
                                       title)),
      ...rows.map(([keys, what]) => make('tr', {}, make('th', {scope: 'row'}, keys),
                                         make('td', {}, what))));
  const bodies = Array.from(groups, ([title, list]) => [title, helpRows(list)])
                     .filter(([, rows]) => rows.length).map(pair => body(...pair));
  const close = make('button', {type: 'button'}, 'Close');
  const dialog = make('dialog', {class: 'help', 'aria-label': 'Keys of the image viewer'},
                      make('h2', {}, 'Keys of the image viewer'),
                      make('table', {}, ...bodies, body('Pointer', pointerHelp)),
                      make('p', {}, 'Keys go to the viewer that has the focus, else to the one ' +
                                    'that fills most of the window.'),
                      close);
  close.addEventListener('click', () => dialog.close());
  closeBeside(dialog);
  document.body.append(dialog);
  document.addEventListener('help', () => dialog.showModal());
  return dialog;
}
