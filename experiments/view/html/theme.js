// Switches between light and dark; follows the system until the reader chooses.

// Media rules of the dark scheme; switched by replacing their media text.
let darkRules = null;

function findDarkRules() {
  return Array.from(document.styleSheets, sheet => Array.from(sheet.cssRules)).flat().filter(
      rule => rule instanceof CSSMediaRule &&
          rule.media.mediaText.includes('prefers-color-scheme'));
}

function setTheme(theme) {
  darkRules = darkRules || findDarkRules();
  document.documentElement.style.colorScheme = theme;
  document.documentElement.dataset.theme = theme;
  for (const rule of darkRules) rule.media.mediaText = theme === 'dark' ? 'all' : 'not all';
}

function isDarkNow() {
  const {theme} = document.documentElement.dataset;
  return theme ? theme === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
}

const THEME_KEY = 'restlab theme';

function toggleTheme() {
  const theme = isDarkNow() ? 'light' : 'dark';
  setTheme(theme);
  try {
    localStorage.setItem(THEME_KEY, theme);
  } catch {
    // Without storage the choice lasts as long as the page.
  }
}

// Restores the last choice.
function startTheme() {
  try {
    const theme = localStorage.getItem(THEME_KEY);
    if (theme === 'light' || theme === 'dark') setTheme(theme);
  } catch {
    // Without storage the system's scheme is used.
  }
}
