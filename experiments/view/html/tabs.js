// Panels of which one is open at a time: tabs by click, arrows, Home and End.

class Tabs {
  // `panels`: [id, title, element]...
  constructor(label, panels) {
    this.tabs = new Map();
    const list = make('div', {class: 'tabs', role: 'tablist', 'aria-label': label});
    this.element = make('div', {class: 'tab-box'}, list);
    for (const [id, title, content] of panels) {
      const tab = make('button', {type: 'button', role: 'tab', id: `tab-${id}`, 'data-tab': id,
                                  'aria-controls': `panel-${id}`}, title);
      const panel = make('div', {class: 'panel', role: 'tabpanel', id: `panel-${id}`,
                                 'aria-labelledby': `tab-${id}`}, content);
      tab.addEventListener('click', () => this.show(id));
      list.append(tab);
      this.element.append(panel);
      this.tabs.set(id, {tab, panel});
    }
    list.addEventListener('keydown', event => this.key(event));
    this.show(panels[0][0]);
  }

  show(id) {
    this.current = id;
    for (const [of, {tab, panel}] of this.tabs) {
      tab.setAttribute('aria-selected', of === id);
      tab.tabIndex = of === id ? 0 : -1;
      panel.hidden = of !== id;
    }
  }

  key(event) {
    const ids = [...this.tabs.keys()], at = ids.indexOf(this.current), n = ids.length;
    const to = {ArrowLeft: (at + n - 1) % n, ArrowRight: (at + 1) % n, Home: 0,
                End: n - 1}[event.key];
    if (to === undefined) return;
    this.show(ids[to]);
    this.tabs.get(ids[to]).tab.focus();
    event.preventDefault();
    event.stopPropagation();
  }
}
