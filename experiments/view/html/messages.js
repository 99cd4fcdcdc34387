// Errors and notices of the program, one line each. Notices go by themselves, but not while the
// pointer or the focus is on them; errors stay until they are closed. The last ones are kept in a
// list.

const MOST_MESSAGES = 6, NOTICE_MS = 8000, MOST_KEPT = 50;

class Messages {
  constructor() {
    this.kept = [];
    this.element = make('div', {class: 'messages', role: 'log', 'aria-live': 'polite',
                                'aria-label': 'Messages'});
    this.log = new HeaderList('messages', `the last ${MOST_KEPT} messages`);
  }

  // `more`: tooltip of the message.
  add(text, isError, more) {
    const last = this.element.lastElementChild;
    if (last && last.firstChild.textContent === text) return;
    this.keep(text, isError);
    const close = makeButton('\u00d7', 'dismiss', () => message.remove());
    const message = make('p', {class: isError ? 'message error' : 'message', title: more},
                         make('span', {}, text), close);
    this.element.append(message);
    while (this.element.children.length > MOST_MESSAGES) {
      const notice = this.element.querySelector('.message:not(.error)');
      (notice || this.element.firstElementChild).remove();
    }
    if (!isError) goByItself(message);
  }

  keep(text, isError) {
    this.kept.unshift({text, isError, time: new Date().toTimeString().slice(0, 8)});
    this.kept.length = Math.min(this.kept.length, MOST_KEPT);
    this.log.show(this.kept);
  }

  error(text, more) { this.add(text, true, more); }
  notice(text) { this.add(text, false); }
}

// Removes a message after a while in which it was neither pointed at nor focused.
function goByItself(message) {
  let timer = null;
  const hold = () => clearTimeout(timer);
  const wait = () => {
    hold();
    timer = setTimeout(() => message.remove(), NOTICE_MS);
  };
  for (const name of ['pointerenter', 'focusin']) message.addEventListener(name, hold);
  for (const name of ['pointerleave', 'focusout']) message.addEventListener(name, wait);
  wait();
}
