// Copies texts. Browsers refuse the clipboard to pages without TLS that come from elsewhere.

// Returns whether the browser took the text.
async function copyText(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false;
  }
}
