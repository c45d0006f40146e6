// In place of furo's own script, which Debian ships as a module: from a file browsers do not load modules.
document.documentElement.classList.remove("no-js");

document.addEventListener("DOMContentLoaded", () => {
  // The theme's icons stand beside words that say the same.
  for (const icon of document.querySelectorAll("svg")) icon.setAttribute("aria-hidden", "true");
  // As the reader's system has it, the other one, and back.
  const dark = matchMedia("(prefers-color-scheme: dark)").matches;
  const themes = dark ? ["auto", "light", "dark"] : ["auto", "dark", "light"];
  for (const button of document.querySelectorAll(".theme-toggle"))
    button.addEventListener("click", () => {
      const theme = themes[(themes.indexOf(document.body.dataset.theme) + 1) % themes.length];
      document.body.dataset.theme = theme;
      localStorage.setItem("theme", theme);
    });
});
