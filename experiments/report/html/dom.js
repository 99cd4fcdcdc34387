// Makes elements. All text is inserted as text, never as markup.

// make('button', {class: 'x', type: 'button'}, 'text', child...)
function make(tag, attributes, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes || {})) {
    if (value !== null && value !== undefined) element.setAttribute(name, value);
  }
  element.append(...children);
  return element;
}

// Makes a group of buttons of which one is pressed. `choices`: [value, label, help]...
function makeChoice(label, choices, choose) {
  const buttons = new Map();
  const group = make('div', {class: 'group', role: 'group', 'aria-label': label});
  for (const [value, text, help] of choices) {
    const button = make('button', {type: 'button', title: help, 'data-value': value}, text);
    button.addEventListener('click', () => choose(value));
    buttons.set(value, button);
    group.append(button);
  }
  return {
    element: group,
    show: value => buttons.forEach((button, of) => button.setAttribute('aria-pressed', of === value))
  };
}

// Makes a list to choose from. `choices`: [value, label, help]...
function makeList(label, help, choices, choose) {
  const element = make('select', {'aria-label': label, title: help},
                       ...choices.map(([value, text, title]) => make('option', {value, title},
                                                                     text)));
  element.addEventListener('change', () => choose(element.value));
  return {element, show: value => { element.value = value; }};
}

function makeButton(text, help, action) {
  const button = make('button', {type: 'button', title: help, 'aria-label': help}, text);
  button.addEventListener('click', action);
  return button;
}

// Closes a dialog on a click outside of its box.
function closeBeside(dialog) {
  dialog.addEventListener('click', event => { if (event.target === dialog) dialog.close(); });
}

// Sets a text; leaves the page alone if nothing has changed.
function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
}
