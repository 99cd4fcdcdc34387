// Palette: a list of all commands, searched while typing.

// Scores how well the words occur in a text, in any order; 0 if one is missing. A match at the
// start of a word counts more, and so does the whole question: "A to B" must rank above "B to A".
function matchScore(text, words) {
  const lower = text.toLowerCase();
  let score = lower.includes(words.join(' ')) ? 2 : 1;
  for (const word of words) {
    const at = lower.indexOf(word);
    if (at < 0) return 0;
    score += at === 0 ? 3 : lower[at - 1] === ' ' ? 2 : 1;
  }
  return score;
}

function matchingCommands(commands, viewer, question) {
  const words = question.toLowerCase().split(/\s+/).filter(Boolean);
  return commands
      .filter(one => !one.release && one.id !== 'palette' && (one.isAnywhere || viewer) &&
                     (!one.when || one.when(viewer)))
      .map(command => ({command, score: matchScore(`${command.title} ${command.group}`, words)}))
      .filter(entry => entry.score > 0)
      .sort((a, b) => b.score - a.score)  // stable: keeps the table's order among equal scores
      .map(entry => entry.command);
}

class Palette {
  // `target` returns the viewer for a command, `more` commands that are there now.
  constructor(commands, target, more = () => []) {
    Object.assign(this, {commands, target, more, found: [], at: 0});
    this.input = make('input', {type: 'search', role: 'combobox', 'aria-expanded': 'true',
                                'aria-controls': 'palette-list', 'aria-label': 'Search commands',
                                placeholder: 'Search commands', autocomplete: 'off',
                                spellcheck: 'false'});
    this.list = make('ul', {id: 'palette-list', role: 'listbox', 'aria-label': 'Commands'});
    this.none = make('p', {class: 'hint', role: 'status'});
    this.dialog = make('dialog', {class: 'palette', 'aria-label': 'All commands'}, this.input,
                       this.list, this.none);
    this.input.addEventListener('input', () => this.search());
    this.dialog.addEventListener('keydown', event => this.key(event));
    closeBeside(this.dialog);
    document.body.append(this.dialog);
    document.addEventListener('palette', () => this.open());
  }

  open() {
    this.viewer = this.target(document.activeElement || document.body);
    this.input.value = '';
    this.dialog.showModal();
    this.search();
    this.input.focus();
  }

  search() {
    const all = this.input.value ? [...this.commands, ...this.more()] : this.commands;
    this.found = matchingCommands(all, this.viewer, this.input.value);
    this.list.replaceChildren(...this.found.map((command, i) => {
      const item = make('li', {id: `command-${command.id}`, role: 'option',
                               'data-command': command.id},
                        make('span', {}, command.title),
                        make('kbd', command.keys.length ? {} : {hidden: ''}, keysText(command)));
      item.addEventListener('click', () => this.run(i));
      return item;
    }));
    this.none.textContent = this.found.length ? '' : 'No command has these words.';
    this.show(0);
  }

  show(at) {
    this.at = at;
    Array.from(this.list.children, (item, i) => item.setAttribute('aria-selected', i === at));
    const item = this.list.children[at];
    this.input.setAttribute('aria-activedescendant', item ? item.id : '');
    if (item) item.scrollIntoView({block: 'nearest'});
  }

  key(event) {
    const n = this.found.length;
    const steps = {ArrowDown: this.at + 1, ArrowUp: this.at - 1,
                   PageDown: Math.min(n - 1, this.at + 8), PageUp: Math.max(0, this.at - 8)};
    const to = steps[event.key];
    if (event.key === 'Enter') {
      this.run(this.at);
    } else if (event.key === 'Escape' ||
               (event.key.toLowerCase() === 'k' && (event.ctrlKey || event.metaKey))) {
      this.dialog.close();  // Escape in a search field would only clear the text
    } else if (to === undefined || !n) {
      return;
    } else {
      this.show((to + n) % n);
    }
    event.preventDefault();
  }

  run(i) {
    const command = this.found[i];
    if (!command) return;
    this.dialog.close();
    command.run(this.viewer);
  }
}
