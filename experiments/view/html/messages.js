// Errors and notices of the program, one line each, with a button to dismiss it.

const MOST_MESSAGES = 6, NOTICE_MS = 8000;

class Messages {
  constructor() {
    this.element = make('div', {class: 'messages', role: 'log', 'aria-live': 'polite',
                                'aria-label': 'Messages'});
  }

  // `more`: tooltip of the message.
  add(text, isError, more) {
    const last = this.element.lastElementChild;
    if (last && last.firstChild.textContent === text) return;
    const close = makeButton('\u00d7', 'dismiss', () => message.remove());
    const message = make('p', {class: isError ? 'message error' : 'message', title: more},
                         make('span', {}, text), close);
    this.element.append(message);
    while (this.element.children.length > MOST_MESSAGES) this.element.firstElementChild.remove();
    if (!isError) setTimeout(() => message.remove(), NOTICE_MS);
  }

  error(text, more) { this.add(text, true, more); }
  notice(text) { this.add(text, false); }
}
