// Brings the live page to life.
const page = new LivePage();
document.body.page = page;  // for tests and for the curious
