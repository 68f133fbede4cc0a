// Has the browser keep the files of the site, so that it works without a network once it was loaded.
if ('serviceWorker' in navigator) {
  navigator.serviceWorker.register('offline.js').catch((error) => console.warn(`The site is not kept for later: ${error.message}`));
}
