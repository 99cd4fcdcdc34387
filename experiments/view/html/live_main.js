// Stands here until the page does: says what the program says.
const socket = new WebSocket(location.href.replace(/^http/, 'ws').replace('/?', '/socket?'));
socket.onmessage = event => console.log(event.data);
