// Calls `steps` when the page in the frame is there, and writes the answer as JSON into #answer.
function drive(steps) {
  const frame = document.getElementById("frame"), answer = document.getElementById("answer");
  const write = result => { answer.textContent = JSON.stringify(result); };
  frame.addEventListener("load", async () => {
    try {
      write({ value: await steps(frame.contentDocument, frame.contentWindow) });
    } catch (error) {
      write({ failed: String(error) + " " + error.stack });
    }
  });
}

// What a reader does.
function choose(page, id, value) {
  const select = page.getElementById(id);
  select.value = value;
  if (select.value !== value) throw new Error(`${id} has no choice '${value}'`);
  select.dispatchEvent(new Event("change", { bubbles: true }));
}
const tick = (page, id) => page.getElementById(id).click();
function press(page, node, key) {
  node.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true, cancelable: true }));
}

// What a reader sees.
function marksOf(page) {
  const all = [...page.querySelectorAll("#panels .mark")], count = kind => all.filter(mark => mark.classList.contains(kind)).length;
  return { all: all.length, right: count("right"), wrong: count("wrong"), failed: count("failed"),
           panels: page.querySelectorAll("#panels svg").length,
           solvers: [...new Set(all.map(mark => mark.dataset.solver))].sort() };
}
