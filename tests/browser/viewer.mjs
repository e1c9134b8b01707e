// Drives the 3-D view of an HTML report in a real browser.
//
//   npm install playwright-core        (in any folder; run from there)
//   node …/tests/browser/viewer.mjs report.html [folder for screenshots]
//
// CHROMIUM names the browser (/usr/bin/chromium by default). Exits with 1 when anything fails. Works on the whole
// report as on a bare page around the view.
import { createRequire } from 'node:module';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const { chromium } = createRequire(join(process.cwd(), 'package.json'))('playwright-core');
const [file, shots] = process.argv.slice(2);
const address = pathToFileURL(resolve(file)).href;
const failures = [];
const check = (holds, what) => { console.log(holds ? 'ok   ' : 'FAIL ', what); if (!holds) failures.push(what); };

const flags = ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-background-networking', '--disable-component-update'];
const launch = more => chromium.launch({ executablePath: process.env.CHROMIUM || '/usr/bin/chromium', args: [...flags, ...more] });
const browser = await launch([]);

// a page that reports what it complains of and what it asks for
async function open(size, more = {}, from = browser) {
  const page = await (await from.newContext({ viewport: size, ...more })).newPage();
  page.setDefaultTimeout(180000); // a machine without a card and with other work
  page.complaints = [];
  page.on('console', message => { if (['error', 'warning'].includes(message.type()) && !/GPU stall due to ReadPixels/.test(message.text())) page.complaints.push(message.text().slice(0, 300)); });
  page.on('pageerror', error => page.complaints.push(error.message));
  page.on('request', request => { if (request.url() !== address && !/^(data|blob):/.test(request.url())) page.complaints.push('asks for ' + request.url()); });
  await page.goto(address);
  return page;
}
const state = page => page.evaluate(() => window.twinView.state());
const rest = page => page.waitForFunction(() => { const s = window.twinView.state(); return s.still && !s.moving; });
// the canvas as shown; compared as bytes
const picture = async (page, name) => {
  await page.locator('#view3d').scrollIntoViewIfNeeded();
  await rest(page);
  const box = await page.locator('#view3d-canvas');
  return (await box.screenshot(shots && name ? { path: join(shots, name + '.png') } : {})).toString('base64');
};
const click = (page, id) => page.locator('#view3d-' + id).click();
const away = (a, b) => Math.hypot(...a.map((x, i) => x - b[i]));

const page = await open({ width: 1280, height: 860 });
await page.waitForFunction(() => window.twinView);
const all = await picture(page, 'hero');
const first = await state(page);
check(first.segments > 0 && first.shown > 0, `strands are there: ${first.segments} segments, ${first.shown} shown`);

// not one colour: the scene was drawn
const colours = await page.evaluate(async source => {
  const image = new Image();
  image.src = 'data:image/png;base64,' + source;
  await image.decode();
  const canvas = new OffscreenCanvas(image.width, image.height), pen = canvas.getContext('2d');
  pen.drawImage(image, 0, 0);
  const data = new Uint32Array(pen.getImageData(0, 0, image.width, image.height).data.buffer);
  return new Set(data).size;
}, all);
check(colours > 500, `the picture has ${colours} colours`);

// time: slider, event, call
await page.locator('#view3d-time').focus();
await page.evaluate(() => { window.heard = []; document.addEventListener('twin:time', event => window.heard.push(event.detail)); });
await page.evaluate(() => { const slider = document.getElementById('view3d-time'); slider.value = slider.max / 2; slider.dispatchEvent(new Event('input', { bubbles: true })); });
const half = await picture(page, 'half');
const atHalf = await state(page);
check(Math.abs(atHalf.time_s - first.time_s / 2) < 1e-3 * first.time_s && half !== all, `the slider moves the time to ${atHalf.time_s} s and the picture`);
check(atHalf.shown < first.shown, `fewer strands at half the time: ${atHalf.shown}`);
check((await page.evaluate(() => window.heard)).some(detail => detail.from === 'view' && Number.isFinite(detail.time_s)), 'the page hears of the time');
await page.evaluate(timeS => document.dispatchEvent(new CustomEvent('twin:time', { detail: { time_s: timeS, from: 'test' } })), first.time_s / 4);
check(Math.abs((await state(page)).time_s - first.time_s / 4) < 1e-9, 'the view hears of the time');
await page.evaluate(timeS => window.twinView.setTime(timeS), first.time_s);

// colours
const words = await page.$$eval('#view3d-colour option', options => options.map(option => option.value));
const seen = new Set();
for (const word of words) {
  await page.locator('#view3d-colour').selectOption(word);
  seen.add(await picture(page, 'colour-' + word));
  check((await state(page)).colour === word, 'coloured by ' + word);
}
check(seen.size > 1, `${seen.size} different pictures of ${words.length} quantities`);
await page.locator('#view3d-colour').selectOption(words[0]);

// camera: views, mouse, wheel, keys
for (const view of ['top', 'front', 'side', 'hero']) {
  await page.locator(`[data-view=${view}]`).click();
  await picture(page, 'view-' + view);
}
const hero = await state(page);
const box = await page.locator('#view3d-canvas').boundingBox();
const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
const drag = async (button, dx, dy) => { await page.mouse.move(x, y); await page.mouse.down({ button }); await page.mouse.move(x + dx, y + dy, { steps: 4 }); await page.mouse.up({ button }); };
await drag('left', 120, 0);
const turned = await state(page);
check(Math.abs(turned.camera.azimuth - hero.camera.azimuth) > 5, 'left drag turns');
await drag('right', 60, 20);
const shifted = await state(page);
check(away(shifted.camera.pivot, turned.camera.pivot) > 1e-4, 'right drag shifts');
await page.mouse.wheel(0, -300);
await page.waitForTimeout(100);
check((await state(page)).camera.distance < shifted.camera.distance, 'wheel zooms');
await page.locator('#view3d-canvas').focus();
await page.keyboard.press('ArrowLeft');
await page.keyboard.press('+');
await page.keyboard.press('Home');
await rest(page);
check(away((await state(page)).camera.position, hero.camera.position) < 1e-6, 'Home goes back');
await page.mouse.dblclick(x, y);
await rest(page);

// play
await page.locator('#view3d-canvas').focus();
await page.keyboard.press(' ');
await page.waitForFunction(() => window.twinView.state().time_s > 0 && window.twinView.state().playing, null, { timeout: 20000 }).catch(() => {});
const playing = await state(page);
await page.keyboard.press(' ');
check(playing.playing && playing.time_s > 0 && playing.time_s < first.time_s, `it plays: ${playing.time_s} s`);
await page.waitForTimeout(100);
check(!(await state(page)).playing, 'it pauses');

// nothing is drawn while nothing changes
await rest(page);
const idle = (await state(page)).pictures;
await page.waitForTimeout(500);
check((await state(page)).pictures === idle, 'at rest nothing is drawn');

// boxes
await page.evaluate(timeS => window.twinView.setTime(timeS), first.time_s / 2);
for (const name of ['arm', 'glass', 'planned', 'follow', 'marks']) {
  await click(page, name);
  await picture(page, 'box-' + name);
  await click(page, name);
}

// findings: the first with a place moves the camera, and the page hears of a mark that is clicked
const before = await state(page);
const index = await page.evaluate(() => { for (let k = 0; k < 5000; k++) if (window.twinView.goToFinding(k)) { if (!document.getElementById('view3d-label').hidden || window.twinView.state().moving) return k; } return -1; });
if (index >= 0) {
  await rest(page);
  const there = await state(page);
  await picture(page, 'finding');
  check(there.finding === index && away(there.camera.position, before.camera.position) > 1e-4, `finding ${index} moves the camera`);
  check(await page.locator('#view3d-label').isVisible(), 'and is named: ' + await page.locator('#view3d-label').innerText());
  const where = await page.evaluate(() => { window.found = []; document.addEventListener('twin:finding', event => window.found.push(event.detail)); const b = document.getElementById('view3d-canvas').getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; });
  await page.mouse.click(...where);
  check((await page.evaluate(() => window.found)).some(detail => detail.from === 'view' && Number.isInteger(detail.index)), 'a click on the mark tells the page');
  await page.evaluate(index => document.dispatchEvent(new CustomEvent('twin:finding', { detail: { index, from: 'test' } })), index);
  check((await state(page)).finding === index, 'the view hears of a finding');
}

await page.locator('#view3d-canvas').focus();
await page.keyboard.press('Escape');
check((await state(page)).finding === null, 'Escape forgets the finding');

// dark
await page.evaluate(() => document.dispatchEvent(new CustomEvent('twin:theme', { detail: { dark: true } })));
await page.evaluate(timeS => { window.twinView.setTime(timeS); }, first.time_s);
await page.locator('[data-view=hero]').click();
check((await picture(page, 'dark')) !== all, 'dark is another picture');

// the card takes the context away and gives it back
await page.evaluate(() => document.dispatchEvent(new CustomEvent('twin:theme', { detail: { dark: false } })));
await page.locator('[data-view=hero]').click();
const sound = await picture(page);
await page.evaluate(() => { window.lose = document.getElementById('view3d-canvas').getContext('webgl2').getExtension('WEBGL_lose_context'); window.lose.loseContext(); });
await page.locator('#view3d-message').waitFor({ state: 'visible' });
await page.evaluate(() => window.lose.restoreContext());
await page.locator('#view3d-message').waitFor({ state: 'hidden' });
check((await picture(page, 'restored')) === sound, 'the same picture after a lost context');
check(page.complaints.filter(text => !/context (lost|restored)|CONTEXT_LOST/i.test(text)).length === 0, 'no complaints: ' + page.complaints.slice(0, 5).join(' | '));

// a phone
const phone = await open({ width: 390, height: 800 }, { deviceScaleFactor: 2, hasTouch: true, isMobile: true, reducedMotion: 'reduce', colorScheme: 'dark' });
await phone.waitForFunction(() => window.twinView);
await picture(phone, 'phone-canvas');
if (shots) await phone.locator('#view3d').screenshot({ path: join(shots, 'phone.png') });
check(await phone.evaluate(() => { const b = document.getElementById('view3d').getBoundingClientRect(); return b.left >= 0 && b.right <= 391 && document.documentElement.scrollWidth <= 391; }), 'fits 390 px');
const wide = (await state(phone)).camera.distance;
const fingers = await phone.context().newCDPSession(phone);
const middle = await phone.locator('#view3d-canvas').evaluate(canvas => { canvas.scrollIntoView({ block: 'center' }); const b = canvas.getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; });
const touch = (type, half) => fingers.send('Input.dispatchTouchEvent', { type, touchPoints: half ? [-half, half].map((dx, id) => ({ x: middle[0] + dx, y: middle[1], id })) : [] });
await touch('touchStart', 30);
for (const half of [40, 55, 70]) await touch('touchMove', half);
await touch('touchEnd', 0);
check((await state(phone)).camera.distance < 0.8 * wide, 'two fingers zoom');
check(phone.complaints.length === 0, 'no complaints on a phone: ' + phone.complaints.slice(0, 5).join(' | '));

// no WebGL at all
const bare = await launch(['--disable-gpu', '--disable-3d-apis']);
const none = await open({ width: 800, height: 600 }, {}, bare);
await none.waitForTimeout(300);
check(await none.locator('#view3d-message').isVisible() && !(await none.locator('#view3d-body').isVisible()), 'without WebGL: ' + await none.locator('#view3d-message').innerText());
await bare.close();

if (shots) await page.locator('#view3d').screenshot({ path: join(shots, 'section.png') });
await browser.close();
console.log(failures.length ? `${failures.length} failed` : 'all hold');
process.exit(failures.length ? 1 : 0);
