// Connection to the program: its messages in, commands out.

// Marks a default that the program writes with a point as real: JSON alone makes 1.0 a whole
// number. If the browser does not pass the source text, panels guess.
function parseKeepingPoints(text) {
  return JSON.parse(text, function(key, value, context) {
    if (key === 'default' && typeof value === 'number' && context && context.source) {
      this.isReal = /[.eE]/.test(context.source);
    }
    return value;
  });
}

// Milliseconds after which a missing answer is no longer waited for.
const ANSWER_TIMEOUT = 1500;

class Session {
  // `on`: a function for each message (hello, state, numbers, ...), `image(head)` for the newest
  // image of a slot, called before a repaint, then `images()`, and `link(state)`.
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
    this.images.set(head.slot, head);  // replaces an older one before it is decoded
    if (this.isAsked) return;
    this.isAsked = true;
    requestAnimationFrame(() => {
      this.isAsked = false;
      const newest = [...this.images.values()];
      this.images.clear();
      for (const one of newest) this.on.image(one);
      this.on.images();
    });
  }

  send(command) {
    const isSent = this.socket.send(JSON.stringify(command));
    if (!isSent) this.on.error({text: `not connected: ${command.do} was not sent`});
    return isSent;
  }

  // Sends values that change with every move of a hand: the newest, once the last one was answered.
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
