//! The HTML of the view.

use super::View3d;

/// The fragment of a page: canvas, controls and data. Its ids begin with `view3d`.
pub(crate) fn section(scene: &View3d) -> String {
    let note = scene
        .thinned
        .as_deref()
        .map_or(String::new(), |said| format!("<p class=\"v3-note\">{}</p>\n", escaped(said)));
    format!(
        r#"<section id="view3d" class="v3" aria-labelledby="view3d-title">
<h2 id="view3d-title">3-D view</h2>
<noscript><p class="v3-note">The 3-D view needs JavaScript; the pictures of this report show the same without it.</p></noscript>
<p id="view3d-message" class="v3-note" role="status" hidden></p>
<div id="view3d-body" hidden>
<div class="v3-stage">
<canvas id="view3d-canvas" tabindex="0" role="application" aria-roledescription="3-D view" aria-label="{label}" aria-describedby="view3d-help"></canvas>
<div id="view3d-label" class="v3-label" hidden></div>
<div id="view3d-legend" class="v3-legend"></div>
</div>
<div class="v3-bar v3-play">
<button type="button" id="view3d-play" aria-pressed="false" aria-label="play">▶</button>
<input type="range" id="view3d-time" min="0" max="{total}" step="any" value="{total}" aria-label="time of the program">
<output id="view3d-clock" for="view3d-time" aria-live="off"></output>
<label>speed <select id="view3d-speed">{speeds}</select></label>
</div>
<div class="v3-bar">
<label>colour by <select id="view3d-colour">{colours}</select></label>
<span class="v3-views" role="group" aria-label="views">{views}</span>
<label><input type="checkbox" id="view3d-arm" checked> arm</label>
<label><input type="checkbox" id="view3d-glass" checked> as if of glass</label>
<label><input type="checkbox" id="view3d-planned" checked> path to come</label>
<label><input type="checkbox" id="view3d-marks" checked> findings</label>
<label><input type="checkbox" id="view3d-follow"> go with the part</label>
</div>
{note}<details class="v3-help"><summary>How to move</summary><p id="view3d-help">Drag to turn, right button, Shift or two fingers to shift, wheel or pinch to zoom (after a click into the view), double click for a new centre, click a strand to name it. Keys: arrows turn, + and − zoom, space plays, Home goes back to the first view, Escape forgets what was chosen.</p></details>
</div>
<script type="application/octet-stream;base64" id="view3d-data">{data}</script>
</section>
"#,
        label = escaped(&format!("3-D view of {}", super::cut(&scene.job))),
        total = if scene.total_s.is_finite() { scene.total_s } else { 0.0 },
        speeds = SPEEDS.map(|(value, text)| option(value, text)).concat(),
        colours = scene.choices.iter().map(|(word, title)| option(word, title)).collect::<String>(),
        views = ["hero", "top", "front", "side"]
            .map(|view| format!(r#"<button type="button" data-view="{view}">{view}</button>"#))
            .concat(),
        data = scene.data,
    )
}

/// Seconds of the program in one of the viewer; 0 is the whole job in twenty.
const SPEEDS: [(&str, &str); 6] = [
    ("0", "all in 20 s"),
    ("1", "1 ×"),
    ("10", "10 ×"),
    ("60", "60 ×"),
    ("300", "300 ×"),
    ("0.1", "0.1 ×"),
];

fn option(value: &str, text: &str) -> String {
    format!(r#"<option value="{}">{}</option>"#, escaped(value), escaped(text))
}

/// Text that stays text between tags and in quotes.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for sign in text.chars() {
        match sign {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            sign if sign.is_control() => out.push(' '),
            sign => out.push(sign),
        }
    }
    out
}
