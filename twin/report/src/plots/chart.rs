//! A plot as SVG: frame, ticks, and what is drawn into it. Colours and strokes are the page's style sheet's.

use super::axis::Axis;

/// Width of every plot, units of its view box; a narrow screen shows them 1:1.
const WIDTH: f64 = 360.0;
const LEFT: f64 = 48.0;
const RIGHT: f64 = 10.0;
const TOP: f64 = 22.0;
const BOTTOM: f64 = 34.0;

/// A plot in the making.
pub(crate) struct Chart {
    x: Axis,
    y: Axis,
    height: f64,
    body: String,
}

/// What a plot is called, for those who see it and those who hear it.
pub(crate) struct Words<'a> {
    /// Unique on the page; letters, digits, hyphens.
    pub(crate) id: &'a str,
    /// One line, escaped.
    pub(crate) title: &'a str,
    /// What it shows in numbers, escaped.
    pub(crate) desc: &'a str,
}

impl Chart {
    /// An empty frame with ticks; names of axes are our own words.
    pub(crate) fn new(x: Axis, y: Axis, names: [&str; 2], height: f64) -> Self {
        let mut chart = Self { x, y, height, body: String::new() };
        chart.frame(names);
        chart
    }

    /// Length and height of the field inside the frame, units of the view box.
    pub(crate) fn field(height: f64) -> [f64; 2] {
        [WIDTH - LEFT - RIGHT, height - TOP - BOTTOM]
    }

    /// Margins left, right, top and bottom of the field, and the width of all, units of the view box.
    pub(crate) fn margins() -> [f64; 5] {
        [LEFT, RIGHT, TOP, BOTTOM, WIDTH]
    }

    pub(crate) fn px(&self, x: f64) -> f64 {
        LEFT + self.x.share(x) * Self::field(self.height)[0]
    }

    pub(crate) fn py(&self, y: f64) -> f64 {
        TOP + (1.0 - self.y.share(y)) * Self::field(self.height)[1]
    }

    pub(crate) fn top(&self) -> f64 {
        TOP
    }

    pub(crate) fn bottom(&self) -> f64 {
        self.height - BOTTOM
    }

    fn frame(&mut self, names: [&str; 2]) {
        let (right, bottom) = (WIDTH - RIGHT, self.bottom());
        let mut grid = String::new();
        let mut labels = String::new();
        for &tick in &self.y.ticks {
            let y = self.py(tick);
            grid.push_str(&format!("M{} {}H{}", at(LEFT), at(y), at(right)));
            let label = self.y.label(tick);
            labels.push_str(&text(LEFT - 5.0, y + 3.5, "e", &label));
        }
        for &tick in &self.x.ticks {
            let x = self.px(tick);
            grid.push_str(&format!("M{} {}v4", at(x), at(bottom)));
            labels.push_str(&text(x, bottom + 14.0, "m", &self.x.label(tick)));
        }
        self.path("grid", &grid);
        self.path("frame", &format!("M{} {}V{}H{}", at(LEFT), at(TOP), at(bottom), at(right)));
        self.body.push_str(&labels);
        self.body.push_str(&text(4.0, 12.0, "name", names[1]));
        self.body.push_str(&text(right, self.height - 5.0, "e name", names[0]));
    }

    /// A path of a class of the style sheet; an empty one is left out.
    pub(crate) fn path(&mut self, class: &str, d: &str) {
        if !d.is_empty() {
            self.body.push_str(&format!("<path class=\"{class}\" d=\"{d}\"/>"));
        }
    }

    /// Words at a place, already escaped.
    pub(crate) fn word(&mut self, x: f64, y: f64, class: &str, word: &str) {
        self.body.push_str(&text(x, y, class, word));
    }

    /// A line across at a height, with words above its right end.
    pub(crate) fn level(&mut self, class: &str, value: f64, word: &str) {
        let (y, right) = (self.py(value), WIDTH - RIGHT);
        self.path(class, &format!("M{} {}H{}", at(LEFT), at(y), at(right)));
        let above = if y < TOP + 12.0 { y + 11.0 } else { y - 3.0 };
        self.word(right, above, "e limit-word", word);
    }

    /// A band over the abscissa with a line in it.
    pub(crate) fn band(&mut self, low: Option<f64>, value: Option<f64>, high: Option<f64>) {
        let (top, bottom) = (self.top(), self.bottom());
        let from = low.map_or(self.px(self.x.low), |low| self.px(low));
        let to = high.map_or(self.px(self.x.high), |high| self.px(high));
        if to > from {
            let width = at(to - from);
            let d = format!("M{} {}h{width}V{}h-{width}z", at(from), at(top), at(bottom));
            self.path("band", &d);
        }
        if let Some(value) = value.filter(|value| (self.x.low..=self.x.high).contains(value)) {
            self.path("set", &format!("M{} {}V{}", at(self.px(value)), at(top), at(bottom)));
        }
    }

    /// A line through points; it breaks where a number is missing, and a point by itself is a dot.
    pub(crate) fn line(&mut self, class: &str, points: &[(f64, Option<f64>)]) {
        let mut d = String::new();
        let mut pen_down = false;
        for (k, &(x, y)) in points.iter().enumerate() {
            let Some(y) = y.filter(|y| y.is_finite() && x.is_finite()) else {
                pen_down = false;
                continue;
            };
            let letter = if pen_down { 'L' } else { 'M' };
            d.push_str(&format!("{letter}{} {}", at(self.px(x)), at(self.py(y))));
            let ends_here = points.get(k + 1).is_none_or(|next| next.1.is_none());
            if !pen_down && ends_here {
                d.push_str("h0");
            }
            pen_down = true;
        }
        self.path(class, &d);
    }

    /// The SVG, with title and description for who does not see it.
    pub(crate) fn finish(self, words: &Words<'_>) -> String {
        let Words { id, title, desc } = words;
        format!(
            "<svg role=\"img\" aria-labelledby=\"{id}-t {id}-d\" viewBox=\"0 0 {} {}\" \
             xmlns=\"http://www.w3.org/2000/svg\"><title id=\"{id}-t\">{title}</title>\
             <desc id=\"{id}-d\">{desc}</desc>{}</svg>",
            at(WIDTH),
            at(self.height),
            self.body
        )
    }
}

/// A coordinate with one decimal.
pub(crate) fn at(value: f64) -> String {
    let value = if value.is_finite() { value.clamp(-999.0, 9999.0) } else { 0.0 };
    let text = format!("{value:.1}");
    let text = text.strip_suffix(".0").unwrap_or(&text);
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

fn text(x: f64, y: f64, class: &str, word: &str) -> String {
    format!("<text class=\"{class}\" x=\"{}\" y=\"{}\">{word}</text>", at(x), at(y))
}
