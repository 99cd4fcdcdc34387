// The keys of a viewer: one table for the handler and for the help that ? shows.

// [keys as shown, what they do]
const KEY_HELP = [
  ['1 \u2013 9', 'show that image'],
  ['Shift + 1 \u2013 9', 'compare with that image (errors, the left side of the divider)'],
  ['\u2190 \u2192', 'previous and next image'],
  ['Space (held)', 'show what is compared with; the viewer must have the focus'],
  ['s, w, b', 'single image, wipe, side by side'],
  ['n, N', 'next and previous error view: none, signed, absolute, squared, relative'],
  ['l', 'linear or logarithmic error scale'],
  ['e, E', 'exposure up and down by half a stop; of errors: their range'],
  ['r', 'exposure as at first'],
  ['t', 'sRGB or false colour'],
  ['wheel, + and \u2212', 'zoom about the pointer or the middle'],
  ['drag', 'move'],
  ['f, 0', 'fit, one screen pixel a pixel'],
  ['?', 'this help; Escape closes it']
];

function makeHelp() {
  const rows = KEY_HELP.map(([keys, what]) => make('tr', {}, make('th', {scope: 'row'}, keys),
                                                   make('td', {}, what)));
  const close = make('button', {type: 'button'}, 'Close');
  const dialog = make('dialog', {class: 'help', 'aria-label': 'Keys of the image viewer'},
                      make('h2', {}, 'Keys of the image viewer'),
                      make('table', {}, make('tbody', {}, ...rows)),
                      make('p', {}, 'Keys go to the viewer that has the focus, else to the one ' +
                                    'that fills most of the window.'),
                      close);
  close.addEventListener('click', () => dialog.close());
  // A click beside the box closes it.
  dialog.addEventListener('click', event => { if (event.target === dialog) dialog.close(); });
  document.body.append(dialog);
  return dialog;
}
