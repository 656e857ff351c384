'use strict';
(() => {
  const tests = [...document.querySelectorAll('details.test')];
  const boxes = [...document.querySelectorAll('.counts input')];
  const find = document.getElementById('find');
  const form = document.querySelector('.controls');
  const texts = new Map();

  // What a test says, made when it is first looked for.
  function says(test, wanted) {
    if (!texts.has(test)) texts.set(test, test.textContent.toLowerCase());
    return texts.get(test).includes(wanted);
  }

  function show() {
    const statuses = boxes.filter(box => box.checked).map(box => box.value);
    const wanted = find.value.trim().toLowerCase();
    let shown = 0;
    for (const test of tests) {
      test.hidden = !statuses.some(status => test.classList.contains(status)) || !says(test, wanted);
      shown += !test.hidden;
    }
    for (const section of document.querySelectorAll('section')) {
      section.hidden = !section.querySelector('details.test:not([hidden])');
    }
    document.getElementById('shown').value = `${shown} of ${tests.length} shown`;
  }

  function fold(open) {
    for (const test of tests) test.open = open;
  }

  document.getElementById('unfold').onclick = () => fold(true);
  document.getElementById('fold').onclick = () => fold(false);
  form.onsubmit = event => event.preventDefault();
  find.oninput = show;
  for (const box of boxes) box.onchange = show;
  form.hidden = false;
  document.body.classList.add('filtered');
  show();
})();
