// Light or dark, as the system says or as the reader chooses.

// The rules of the other scheme stand in media queries of the style sheet: they are switched.
function setTheme(theme) {
  const isDark = theme === 'dark';
  document.documentElement.style.colorScheme = theme;
  document.documentElement.dataset.theme = theme;
  for (const sheet of document.styleSheets) {
    for (const rule of sheet.cssRules) {
      if (!(rule instanceof CSSMediaRule)) continue;
      if (!rule.isScheme && !rule.media.mediaText.includes('prefers-color-scheme')) continue;
      rule.isScheme = true;
      rule.media.mediaText = isDark ? 'all' : 'not all';
    }
  }
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
    // No storage: it lasts as long as the page.
  }
}

// As it was chosen the last time.
function startTheme() {
  try {
    const theme = localStorage.getItem(THEME_KEY);
    if (theme === 'light' || theme === 'dark') setTheme(theme);
  } catch {
    // The system's.
  }
}
