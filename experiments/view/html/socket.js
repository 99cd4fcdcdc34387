// WebSocket to the program. Reconnects after a failure; after several failures in a row the program
// counts as ended.

const MOST_FAILURES = 5;

class Socket {
  // `on`: {text(string), bytes(ArrayBuffer), link(state)}; the states are connecting, connected,
  // reconnecting, ended and replaced: another program listens there, which does not know the address.
  constructor(url, on) {
    Object.assign(this, {url, on, failures: 0});
    this.open();
  }

  open() {
    this.on.link(this.wasOpen ? 'reconnecting' : 'connecting');
    const socket = this.socket = new WebSocket(this.url);
    socket.binaryType = 'arraybuffer';
    socket.addEventListener('open', () => {
      this.failures = 0;
      this.wasOpen = true;
      this.on.link('connected');
    });
    socket.addEventListener('message', ({data}) => {
      if (typeof data === 'string') this.on.text(data); else this.on.bytes(data);
    });
    socket.addEventListener('close', () => this.closed());
  }

  closed() {
    if (++this.failures > MOST_FAILURES) {
      this.on.link('ended');
      return;
    }
    this.on.link('reconnecting');
    const delay = Math.min(4000, 250 * 2 ** this.failures);
    setTimeout(async () => {
      if (await this.isRefused()) this.on.link('replaced'); else this.open();
    }, delay);
  }

  // A WebSocket does not tell why it was refused; the page's own address does.
  async isRefused() {
    try {
      const {status} = await fetch(location.pathname + location.search, {cache: 'no-store'});
      return status === 403;
    } catch {
      return false;  // nothing listens
    }
  }

  // Tries again after the program has ended.
  again() {
    this.failures = 0;
    this.open();
  }

  // Returns false if there is no connection.
  send(text) {
    if (this.socket.readyState !== WebSocket.OPEN) return false;
    this.socket.send(text);
    return true;
  }
}
