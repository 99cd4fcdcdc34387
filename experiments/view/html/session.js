// What the program says, and what it is asked for.

// A number that the program writes with a point is no whole number, whatever its value: JSON alone
// does not keep that. Where the browser does not tell, panels guess.
function parseKeepingPoints(text) {
  return JSON.parse(text, function(key, value, context) {
    if (key === 'default' && typeof value === 'number' && context && context.source) {
      this.isReal = /[.eE]/.test(context.source);
    }
    return value;
  });
}

// An answer that does not come is not waited for any longer, in milliseconds.
const ANSWER_TIMEOUT = 1500;

class Session {
  // `on`: a function for each thing that is said (hello, state, numbers, ...), `image(head)` for
  // the newest image of a slot, once before each picture of the window, and `link(state)`.
  constructor(url, on) {
    Object.assign(this, {on, hello: null, state: null, images: new Map(), waiting: new Map()});
    this.socket = new Socket(url, {
      text: text => this.said(text), bytes: bytes => this.image(bytes), link: on.link
    });
  }

  said(text) {
    let message;
    try {
      message = parseKeepingPoints(text);
    } catch {
      this.on.error({text: 'the program sent what is no JSON'});
      return;
    }
    if (message.say === 'hello') this.hello = message;
    if (message.say === 'state') this.state = message;
    const heard = this.on[message.say];
    if (heard) heard(message);
    if (message.say === 'state' || message.say === 'error') this.answered();
  }

  image(bytes) {
    let head;
    try {
      head = readImageHead(bytes);
    } catch (error) {
      this.on.error({text: error.message});
      return;
    }
    this.images.set(head.slot, head);  // an older one that nobody saw is never decoded
    if (this.isAsked) return;
    this.isAsked = true;
    requestAnimationFrame(() => {
      this.isAsked = false;
      const newest = [...this.images.values()];
      this.images.clear();
      for (const one of newest) this.on.image(one);
    });
  }

  send(command) {
    const isSent = this.socket.send(JSON.stringify(command));
    if (!isSent) this.on.error({text: `not connected: ${command.do} was not sent`});
    return isSent;
  }

  // Of what changes with every move of a hand: the newest, when the last one was answered.
  sendNewest(key, command) {
    const slot = this.waiting.get(key);
    if (slot && performance.now() - slot.since < ANSWER_TIMEOUT) {
      slot.next = command;
      return;
    }
    if (this.send(command)) this.waiting.set(key, {since: performance.now(), next: null});
  }

  answered() {
    for (const [key, {next}] of [...this.waiting]) {
      this.waiting.delete(key);
      if (next) this.sendNewest(key, next);
    }
  }
}
