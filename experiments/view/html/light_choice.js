// Choice of the light that panes and reference show: all of it, direct or indirect light alone.

const componentOf = page => page.state.transport.find(one => one.name === 'component');
const componentsOf = page => page.hello.has_scene ? componentOf(page).choices : [];
const showComponent = (page, value) => page.session.send({do: 'transport', name: 'component',
                                                          value});

class LightChoice {
  constructor(page) {
    this.page = page;
    this.choice = makeChoice('Light', componentsOf(page).map(value => [
      value, value, commandTitle(`component-${value}`, page.commands)
    ]), value => showComponent(page, value));
    this.element = make('div', {class: 'line light-choice'}, make('span', {}, 'light'),
                        this.choice.element);
    this.element.hidden = !page.hello.has_scene;
  }

  show() { if (this.page.hello.has_scene) this.choice.show(componentOf(this.page).value); }
}
