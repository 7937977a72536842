// Sorts and filters the tables of the report's page; it becomes part of the page. Without scripts all rows are there, in
// the order of their CSV. Own code: DataTables and its kind need jQuery, 180 kB in the page for these lines.
'use strict';
const kFewRows = 20;  // shorter tables need no filter

// Numbers by value, texts by their letters; cells without a value ("–") are last in both directions.
function compare(a, b, sign) {
  const missing = text => text === '' || text === '–';
  if (missing(a) || missing(b)) return missing(a) - missing(b);
  const number = text => parseFloat(text.replace('−', '-'));
  const order = number(a) - number(b) || a.localeCompare(b, 'en', {numeric: true});
  return sign * order;
}

function sortBy(table, column) {
  const head = table.tHead.rows[0].cells, body = table.tBodies[0];
  const sign = head[column].getAttribute('aria-sort') === 'ascending' ? -1 : 1;
  for (const cell of head) cell.removeAttribute('aria-sort');
  head[column].setAttribute('aria-sort', sign < 0 ? 'descending' : 'ascending');
  const text = row => row.cells[column].textContent.trim();
  body.append(...Array.from(body.rows).sort((a, b) => compare(text(a), text(b), sign)));
}

function addSorting(table) {
  Array.from(table.tHead.rows[0].cells).forEach((cell, column) => {
    const button = document.createElement('button');
    button.type = 'button';
    button.textContent = cell.textContent;
    button.title = 'Sort by this column';
    button.addEventListener('click', () => sortBy(table, column));
    cell.replaceChildren(button);
  });
}

// Shows the rows that contain all of the words.
function addFilter(table) {
  const rows = Array.from(table.tBodies[0].rows);
  const label = document.createElement('label'), input = document.createElement('input');
  const count = document.createElement('output');
  label.className = 'filter';
  input.type = 'search';
  input.placeholder = 'for example: radau_iia index2';
  count.textContent = ` ${rows.length} rows`;
  input.addEventListener('input', () => {
    const words = input.value.toLowerCase().split(/\s+/);
    for (const row of rows) row.hidden = !words.every(word => row.textContent.toLowerCase().includes(word));
    count.textContent = ` ${rows.filter(row => !row.hidden).length} of ${rows.length} rows`;
  });
  label.append('Filter: ', input, count);
  table.parentElement.before(label);
}

for (const table of document.querySelectorAll('table.data, table.claims')) {
  if (!table.tHead) continue;
  const titles = Array.from(table.tHead.rows[0].cells, cell => cell.textContent);
  for (const row of table.tBodies[0].rows) {
    Array.from(row.cells).forEach((cell, i) => {
      if (titles[i]) cell.dataset.label = titles[i];
    });
  }
  if (table.classList.contains('claims')) continue;
  addSorting(table);
  if (table.tBodies[0].rows.length > kFewRows) addFilter(table);
}

// A link to something inside <details> opens it; so does printing.
function openTarget() {
  const target = location.hash && document.getElementById(decodeURIComponent(location.hash.slice(1)));
  for (let element = target; element; element = element.parentElement) {
    if (element.tagName === 'DETAILS') element.open = true;
  }
  if (target) target.scrollIntoView();
}
window.addEventListener('hashchange', openTarget);
openTarget();
window.addEventListener('beforeprint', () => {
  for (const details of document.querySelectorAll('details')) details.open = true;
});
