{
  const get = id => document.getElementById(id);
  const [stage, seek, toggle, speed, looping, paper, theme] =
    ["stage", "seek", "play", "speed", "loop", "paper", "theme"].map(get);
  let animation;

  const progress = () => animation.effect.getComputedTiming().progress ?? 0;

  // To a share of one way through all drawings, standing still there.
  const go = share => {
    const { delay, duration } = animation.effect.getTiming();
    animation.pause();
    animation.currentTime = delay + Math.min(Math.max(share, 0), 1 - 1e-9) * duration;
    if (share >= 1 && looping.value == "once") animation.currentTime = delay + duration;
  };

  const begin = options => {
    const share = animation && progress(), running = animation?.playState != "paused";
    animation?.cancel();
    stage.replaceChildren();
    animation = play(stage, { ...options, loop: looping.value });
    animation.playbackRate = +speed.value;
    if (share == null) return;
    go(share);
    if (running && share < 1) animation.play();
  };

  const paint = () => {
    const choice = paper.value;
    document.querySelectorAll(".paper").forEach(card => {
      card.classList.toggle("chequered", choice == "chequered");
      card.style.background = choice == "chequered" ? "" : choice;
    });
  };

  const turn = () => animation.playState == "running" ? animation.pause() : animation.play();
  toggle.onclick = turn;
  seek.oninput = () => go(+seek.value);
  speed.onchange = () => animation.updatePlaybackRate(+speed.value);
  looping.onchange = () => begin({ start: "load" });
  paper.onchange = paint;
  theme.onclick = () => {
    const style = document.documentElement.style;
    const dark = style.colorScheme ? style.colorScheme == "dark" : matchMedia("(prefers-color-scheme:dark)").matches;
    style.colorScheme = dark ? "light" : "dark";
  };
  addEventListener("keydown", event => {
    if (event.target.closest("button, select, input") && event.key == " ") return;
    const steps = { ArrowLeft: -0.02, ArrowRight: 0.02 };
    if (event.key == " ") turn();
    else if (event.key in steps && event.target != seek && event.target.localName != "select") go(progress() + steps[event.key]);
    else return;
    event.preventDefault();
  });

  // A drawing is shown by a button that goes there.
  document.querySelectorAll(".drawings button").forEach((button, k, all) => {
    const time = all.length > 1 ? k / (all.length - 1) : 0;
    mount(button.querySelector(".paper"))(time);
    button.onclick = () => {
      const { duration, hold } = timing, swing = looping.value == "alternate";
      const before = swing ? hold / 2 : hold;
      const passed = typeof ways == "undefined" ? k : ways.slice(0, k).reduce((sum, way) => sum + way, 0);
      go(k ? (before + passed * duration + (k - 1) * hold) / animation.effect.getTiming().duration : 0);
    };
  });

  const show = () => {
    const running = animation.playState == "running";
    if (document.activeElement != seek || running) seek.value = progress();
    toggle.textContent = running ? "Pause" : "Play";
    requestAnimationFrame(show);
  };
  begin();
  paint();
  show();
}
