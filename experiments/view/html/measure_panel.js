// Panel that starts `restlab run` on the current settings, follows it and links its report.

const MEASURED_HEADS = ['method', 'runs', 'MSE', 'relMSE', 'energy', 'time'];

class MeasurePanel {
  constructor(page) {
    this.page = page;
    this.name = make('input', {type: 'text', maxlength: 100, 'aria-label': 'name of the suite',
                               placeholder: 'name: scene and time'});
    this.begin = makeButton('measure', commandTitle('measure', page.commands),
                            () => page.measure());
    this.cancel = makeButton('cancel', commandTitle('cancel-measure', page.commands),
                             () => page.session.send({do: 'cancel'}));
    this.progress = make('progress', {max: 1, value: 0, 'aria-label': 'progress of the run'});
    this.text = make('p', {class: 'hint', role: 'status', 'data-measure': 'none'});
    this.link = make('a', {target: '_blank', rel: 'noopener', hidden: ''}, 'open the report');
    this.link.href = `/report${location.search}`;
    this.rows = make('tbody', {});
    this.table = make('table', {class: 'measured', hidden: ''},
                      make('caption', {}, 'means over the runs so far'),
                      make('thead', {}, make('tr', {}, ...MEASURED_HEADS.map(
                          head => make('th', {scope: 'col'}, head)))), this.rows);
    this.element = make('fieldset', {class: 'measure'}, make('legend', {}, 'measure'),
                        make('div', {class: 'line'}, this.name, this.begin, this.cancel),
                        this.progress, this.text, this.table, this.link);
    this.show({state: 'none', text: '', done: 0, rows: []});
  }

  get isRunning() { return this.state === 'running'; }

  show({state, text, done, folder, rows}) {
    this.state = state;
    this.begin.disabled = this.isRunning || !this.page.hello.has_scene;
    this.cancel.disabled = !this.isRunning;
    this.progress.hidden = !this.isRunning;
    // Without a value the bar only shows that something is under way.
    if (done > 0) this.progress.value = done; else this.progress.removeAttribute('value');
    this.text.dataset.measure = state;
    this.text.classList.toggle('warn', state === 'failed');
    setText(this.text, state === 'none'
        ? (this.page.hello.has_scene
            ? 'Saves the session and measures the methods of A and B by restlab run, also where a ' +
              'pane shows something else; nothing renders here meanwhile.'
            : 'Images of files are shown: there is nothing to measure.')
        : `${folder}: ${state === 'finished' || state === 'running' ? '' : `${state}: `}${text}`);
    this.link.hidden = state !== 'finished';
    this.table.hidden = !rows.length;
    this.rows.replaceChildren(...rows.map(({method, runs, mse, relmse, energy, ms}) => make(
        'tr', {}, make('th', {scope: 'row'}, method),
        ...[runs, quantity(mse), quantity(relmse), quantity(energy, 4), milliseconds(ms)].map(
            text => make('td', {class: 'num'}, String(text))))));
  }

  ask() {
    const name = this.name.value.trim();
    this.page.session.send(name ? {do: 'measure', name} : {do: 'measure'});
  }
}
