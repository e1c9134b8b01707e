// The page as a whole: theme, saving the report, printing, deep links.

const dark = matchMedia("(prefers-color-scheme: dark)");
const root = document.documentElement;
const themeButton = byId("theme");
const isDark = () => (root.dataset.theme ? root.dataset.theme === "dark" : dark.matches);
function tellTheme() {
  themeButton.textContent = isDark() ? "Light" : "Dark";
  themeButton.setAttribute("aria-label", `${themeButton.textContent} colours`);
  document.dispatchEvent(new CustomEvent("twin:theme", { detail: { dark: isDark() } }));
}
themeButton.addEventListener("click", () => {
  root.dataset.theme = isDark() ? "light" : "dark";
  tellTheme();
});
dark.addEventListener("change", tellTheme);

const download = byId("download");
if (download) {
  download.addEventListener("click", () => {
    const json = JSON.stringify(JSON.parse(byId("report-json").textContent), null, 2);
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([json + "\n"], { type: "application/json" }));
    link.download = "report.json";
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  });
}

// Paper shows everything.
let shut = [];
addEventListener("beforeprint", () => {
  shut = [...document.querySelectorAll("details:not([open])")];
  shut.forEach((part) => { part.open = true; });
});
addEventListener("afterprint", () => {
  shut.forEach((part) => { part.open = false; });
});

// Deep links: #finding-3 (the first is 1, as in `twin render --view finding:1`), #t=12.5, #why-C201.
function follow() {
  const hash = location.hash.slice(1);
  const finding = /^finding-(\d+)$/.exec(hash);
  const time = /^t=(\d+(?:\.\d+)?)$/.exec(hash);
  if (finding) choose(Number(finding[1]) - 1, true);
  else if (time) seek(Number(time[1]));
  else if (/^why-\w+$/.test(hash)) {
    const page = byId(hash);
    if (page) {
      page.closest("details").open = true;
      page.closest("details").scrollIntoView({ block: "start" });
    }
  }
}
addEventListener("hashchange", follow);
addEventListener("load", () => {
  tellTheme();
  seek(nowS, true);
  follow();
});
