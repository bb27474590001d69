const form = document.querySelector("form");
const cards = [...document.querySelectorAll("article")];

// Only what is seen plays; what leaves the window is let go, and starts anew when it comes back.
let turns = 0;
const start = image => image.src = `${image.dataset.src}?${turns++}`;
const watch = new IntersectionObserver(entries => {
  for (const { target, isIntersecting } of entries) isIntersecting ? start(target) : target.removeAttribute("src");
}, { rootMargin: "50px" });
for (const image of document.querySelectorAll("img")) {
  watch.observe(image);
  image.parentElement.onclick = () => start(image);
}

const sift = () => {
  const words = form.name.value.toLowerCase().split(/\s+/);
  let count = 0;
  for (const card of cards) {
    const name = card.querySelector("h2").textContent.toLowerCase();
    const shown = words.every(word => name.includes(word))
      && (form.confidence.value == "" || card.classList.contains(form.confidence.value))
      && (!form.warned.checked || card.matches(".failed, :has(details)"));
    card.hidden = !shown;
    count += shown;
  }
  form.querySelector("output").value = `${count} of ${cards.length}`;
};
form.oninput = sift;
form.onsubmit = event => event.preventDefault();
sift();
