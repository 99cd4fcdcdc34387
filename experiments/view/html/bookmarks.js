// Bookmarked views, kept in the browser by the scene's name.

class Bookmarks {
  constructor(page, sceneName) {
    Object.assign(this, {page, key: `restlab bookmarks ${sceneName}`});
    this.list = this.load();
    const add = makeButton('keep this view', commandTitle('bookmark', page.commands),
                           () => this.add());
    this.rows = make('ul', {class: 'bookmarks'});
    this.element = make('fieldset', {}, make('legend', {}, 'bookmarks'), this.rows, add);
    this.show();
  }

  load() {
    try {
      const list = JSON.parse(localStorage.getItem(this.key) || '[]');
      return Array.isArray(list) ? list : [];
    } catch {
      return [];  // no storage, or not a list
    }
  }

  save() {
    try {
      localStorage.setItem(this.key, JSON.stringify(this.list));
    } catch {
      this.page.messages.notice('the browser keeps no bookmarks: this one is lost with the page');
    }
    this.show();
  }

  add() {
    const number = 1 + Math.max(0, ...this.list.map(one => Number(/\d+$/.exec(one.name) || 0)));
    this.list.push({name: `view ${number}`, ...this.page.camera.now()});
    this.save();
    this.page.messages.notice(`view ${number} is kept`);
  }

  go(i) { if (this.list[i]) this.page.moveCamera(this.list[i]); }

  show() {
    this.rows.replaceChildren(...this.list.map((one, i) => {
      const name = make('input', {type: 'text', value: one.name, 'aria-label': 'name of the view'});
      name.addEventListener('change', () => {
        one.name = name.value;
        this.save();
      });
      return make('li', {}, name, makeButton('go', `go to ${one.name}`, () => this.go(i)),
                  makeButton('\u00d7', `forget ${one.name}`, () => {
                    this.list.splice(i, 1);
                    this.save();
                  }));
    }));
  }
}
