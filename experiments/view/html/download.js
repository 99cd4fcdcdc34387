// Downloads of files that the page makes.

function downloadBlob(name, blob) {
  const url = URL.createObjectURL(blob);
  const link = make('a', {href: url, download: name});
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

function downloadText(name, text) {
  downloadBlob(name, new Blob([text], {type: 'text/plain;charset=utf-8'}));
}

// Makes a button that copies `text()`. Browsers may refuse the clipboard to a page without TLS.
function copyButton(text, help, say) {
  return makeButton('copy', help, async () => {
    say(await copyText(text())
        ? 'copied' : 'the browser gives no access to the clipboard: select the text and copy it');
  });
}

// Saves the visible stage with the names of its views, as a PNG with `words`.
function saveScreenshot(viewer, name, words) {
  viewer.draw();
  const {canvas} = viewer, ratio = canvas.width / viewer.stage.width;
  const picture = make('canvas', {width: canvas.width, height: canvas.height});
  const context = picture.getContext('2d');
  context.fillStyle = getComputedStyle(viewer.frame).backgroundColor;
  context.fillRect(0, 0, picture.width, picture.height);
  context.drawImage(canvas, 0, 0);
  context.scale(ratio, ratio);
  context.font = '13px system-ui, sans-serif';
  context.textBaseline = 'middle';
  for (const view of viewer.stage.views) {
    const [left, right] = view.clip || [view.x, view.x + view.width];
    const widthOf = text => context.measureText(text).width + 14;
    const text = fittingLabel(labelParts(viewer, view), shortLabel(viewer, view),
                              one => widthOf(one) <= right - left);
    const width = widthOf(text);
    const x = view.clip && left > 0 ? right - width : left;
    context.fillStyle = 'rgba(0,0,0,0.62)';
    context.fillRect(x, view.y, width, 22);
    context.fillStyle = '#fff';
    context.fillText(text, x + 7, view.y + 11);
  }
  picture.toBlob(async blob => downloadBlob(name, await pngWithWords(blob, words)), 'image/png');
}
