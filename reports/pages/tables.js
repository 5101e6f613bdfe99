// Lists put into another order by their column heads, and narrowed to the rows that hold what is typed. Without this
// script a list reads as the server has ordered it.
"use strict";
for (const table of document.querySelectorAll("table.list")) {
  const heads = [...table.tHead.rows[0].cells], body = table.tBodies[0], rows = [...body.rows];
  if (rows.length < 2) continue;
  const said = (row, column) => row.cells[column].textContent.trim();
  // "3 of 5 (23 to 88 %)" by its first number; what has none comes last.
  const number = (text) => Number.parseFloat(text.replace("−", "-"));
  const tell = document.createElement("p");
  tell.className = "said";
  tell.setAttribute("role", "status");

  function sort(column, descending) {
    const numbers = heads[column].classList.contains("number");
    const sign = descending ? -1 : 1;
    const compared = (a, b) => {
      if (!numbers) return sign * said(a, column).localeCompare(said(b, column), "en", { numeric: true });
      const [x, y] = [number(said(a, column)), number(said(b, column))];
      if (Number.isNaN(x) || Number.isNaN(y)) return Number.isNaN(x) - Number.isNaN(y);
      return sign * (x - y);
    };
    rows.sort(compared);  // stable: rows alike stay as they stood
    body.append(...rows);
    for (const head of heads) head.removeAttribute("aria-sort");
    heads[column].setAttribute("aria-sort", descending ? "descending" : "ascending");
    choice.value = column;
    tell.textContent = "Ordered by " + names[column] + (descending ? ", descending" : ", ascending");
  }
  const names = heads.map((head) => (head.querySelector("abbr") || head).textContent.trim());
  heads.forEach((head, column) => {
    const button = document.createElement("button");
    button.type = "button";
    button.className = "order";
    if (head.querySelector("a")) {  // which leads elsewhere
      button.textContent = "⇅";
      button.setAttribute("aria-label", "Order by " + names[column]);
    } else {
      button.append(...head.childNodes);
    }
    button.addEventListener("click", () => sort(column, head.getAttribute("aria-sort") === "ascending"));
    head.append(" ", button);
  });

  const bar = document.createElement("div");
  bar.className = "table-bar";
  // On a narrow screen the heads are not seen: a list of them is.
  const order = document.createElement("label"), choice = document.createElement("select");
  order.className = "order-by";
  names.forEach((name, column) => choice.append(new Option(name, column)));
  choice.selectedIndex = -1;
  choice.addEventListener("change", () => sort(Number(choice.value), false));
  order.append("Order by ", choice);
  bar.append(order);
  if (rows.length > 7) {
    const narrow = document.createElement("label"), field = document.createElement("input");
    field.type = "search";
    field.addEventListener("input", () => {
      const words = field.value.toLowerCase().split(/\s+/);
      let shown = 0;
      for (const row of rows) {
        const text = row.textContent.toLowerCase();
        row.hidden = !words.every((word) => text.includes(word));
        shown += row.hidden ? 0 : 1;
      }
      tell.textContent = shown + " of " + rows.length + " rows";
    });
    narrow.append("Only rows with ", field);
    bar.append(narrow);
  }
  bar.append(tell);
  const place = table.closest(".wide") || table;
  place.before(bar);
}
