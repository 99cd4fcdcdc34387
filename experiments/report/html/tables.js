// Sorts tables by clicks on a heading: ascending, descending, original order. A row without a
// number in that column stays last either way.

function cellValue(row, column) {
  const cell = row.cells[column];
  if (!('value' in cell.dataset)) return cell.textContent.trim();
  return cell.dataset.value === '' ? NaN : Number(cell.dataset.value);
}

function compareCells(a, b, direction) {
  if (typeof a === 'string') return direction * a.localeCompare(b, 'en', {numeric: true});
  if (Number.isNaN(a) || Number.isNaN(b)) return Number.isNaN(a) - Number.isNaN(b);
  return a === b ? 0 : direction * (a < b ? -1 : 1);
}

function makeSortable(table) {
  const heads = Array.from(table.tHead.rows[0].cells), body = table.tBodies[0];
  const original = Array.from(body.rows);
  heads.forEach((head, column) => {
    const button = head.querySelector('button');
    if (!button) return;
    // Begin with the better end.
    const first = head.dataset.better === 'higher' ? 'descending' : 'ascending';
    const second = first === 'ascending' ? 'descending' : 'ascending';
    button.addEventListener('click', () => {
      const was = head.getAttribute('aria-sort');
      const now = was === first ? second : was === second ? 'none' : first;
      for (const other of heads) if (other.hasAttribute('aria-sort')) other.setAttribute('aria-sort', 'none');
      head.setAttribute('aria-sort', now);
      const rows = original.slice();
      if (now !== 'none') {
        const direction = now === 'ascending' ? 1 : -1;
        rows.sort((a, b) => compareCells(cellValue(a, column), cellValue(b, column), direction));
      }
      body.append(...rows);
    });
  });
}
