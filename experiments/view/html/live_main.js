// Starts the live page.
const page = new LivePage();
document.body.page = page;  // for tests and for the browser's console
