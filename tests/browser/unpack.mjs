// Prints where npm's Chromium lies, unpacked.
import chromium from "@sparticuz/chromium";

console.log(await chromium.executablePath());
