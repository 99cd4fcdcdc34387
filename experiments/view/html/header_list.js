// Button of the header that opens a list below it: the messages, the warnings.

class HeaderList {
  // `isAlarm`: the button is marked, and hidden while the list is empty.
  constructor(id, help, isAlarm = false) {
    Object.assign(this, {id, isAlarm});
    this.button = make('button', {type: 'button', title: help, 'aria-expanded': 'false',
                                  'aria-controls': `list-${id}`, 'data-list': id});
    this.button.addEventListener('click', () => this.open(this.box.hidden));
    this.list = make('ul', {});
    this.empty = make('p', {class: 'hint'}, `no ${id}`);
    this.box = make('div', {class: 'header-list', id: `list-${id}`, role: 'region',
                            'aria-label': id, hidden: ''},
                    makeButton('\u00d7', 'close', () => this.open(false)), this.empty, this.list);
    this.element = make('div', {class: isAlarm ? 'header-list-of alarm' : 'header-list-of'},
                        this.button, this.box);
    this.element.addEventListener('keydown', event => {
      if (event.key !== 'Escape' || this.box.hidden) return;
      this.open(false);
      this.button.focus();
      event.stopPropagation();
    });
    document.addEventListener('pointerdown', event => {
      if (!this.element.contains(event.target)) this.open(false);
    });
    this.show([]);
  }

  open(isOpen) {
    this.box.hidden = !isOpen;
    this.button.setAttribute('aria-expanded', isOpen);
  }

  // Shows the entries, [{text, isError, time}]; `time` is optional.
  show(entries) {
    const n = entries.length, name = n === 1 ? this.id.replace(/s$/, '') : this.id;
    setText(this.button, this.isAlarm ? `${n} ${name}` : this.id);
    this.element.hidden = this.isAlarm && !n;
    this.empty.hidden = n > 0;
    this.list.replaceChildren(...entries.map(({text, isError, time}) => make(
        'li', {class: isError ? 'bad' : ''}, time ? make('span', {class: 'unit'}, `${time} `) : '',
        text)));
  }
}
