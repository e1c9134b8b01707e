//! Pages of codes, as `twin explain` prints them, as HTML.

use std::collections::BTreeSet;

use sim::finding::Code;

use super::sentence;
use crate::parts::Report;
use crate::plots::text::escaped;

/// The pages of all codes found, folded.
pub(super) fn pages(report: &Report) -> String {
    let codes: BTreeSet<Code> =
        report.findings.iter().filter_map(|finding| Code::from_name(&finding.code)).collect();
    if codes.is_empty() {
        return String::new();
    }
    let pages: String = codes.into_iter().map(page).collect();
    format!("<h3>What the codes mean</h3>\n{pages}")
}

fn page(code: Code) -> String {
    let word = code.as_str();
    format!(
        "<details class=\"code-page\"><summary><b>{word}</b> {}</summary><div id=\"why-{word}\">{}</div></details>\n",
        sentence(code.title()),
        markup(code.page())
    )
}

/// The little Markdown that pages use: paragraphs, lists, `**bold**`, code in back ticks, laws between fences. The heading
/// is left out.
pub(super) fn markup(page: &str) -> String {
    let parts = page.split("```").enumerate();
    let html = parts.map(|(k, part)| match k % 2 {
        0 => paragraphs(part),
        _ => law(part),
    });
    html.collect()
}

/// What stands between fences, as it stands; the first line is the fence's own.
fn law(fenced: &str) -> String {
    let lines = fenced.split_once('\n').map_or("", |(_, lines)| lines);
    let shown: Vec<String> =
        lines.trim_end().lines().map(|line| escaped(line, usize::MAX)).collect();
    format!("<pre tabindex=\"0\">{}</pre>", shown.join("\n"))
}

fn paragraphs(text: &str) -> String {
    let mut html = String::new();
    for block in text
        .split("\n\n")
        .map(str::trim)
        .filter(|block| !block.is_empty() && !block.starts_with('#'))
    {
        if block.starts_with("- ") {
            let items: String =
                items(block).iter().map(|item| format!("<li>{}</li>", inline(item))).collect();
            html.push_str(&format!("<ul>{items}</ul>"));
        } else {
            html.push_str(&format!("<p>{}</p>", inline(block)));
        }
    }
    html
}

/// Items of a list; lines that do not begin one go on with the last.
fn items(block: &str) -> Vec<String> {
    let mut items: Vec<String> = Vec::new();
    for line in block.lines() {
        match (line.strip_prefix("- "), items.last_mut()) {
            (Some(item), _) => items.push(item.to_owned()),
            (None, Some(last)) => *last = format!("{last} {}", line.trim()),
            (None, None) => items.push(line.to_owned()),
        }
    }
    items
}

/// Escaped, with bold and code; a mark without its partner stands as it is.
fn inline(text: &str) -> String {
    let text: String =
        text.lines().map(|line| escaped(line, usize::MAX)).collect::<Vec<_>>().join(" ");
    paired(&paired(&text, "**", "b"), "`", "code")
}

fn paired(text: &str, mark: &str, tag: &str) -> String {
    let parts: Vec<&str> = text.split(mark).collect();
    let pairs = (parts.len() - 1) / 2;
    let mut out = String::from(parts[0]);
    for (k, part) in parts.iter().enumerate().skip(1) {
        match k {
            k if k > 2 * pairs => out.push_str(mark),
            k if k % 2 == 1 => out.push_str(&format!("<{tag}>")),
            _ => out.push_str(&format!("</{tag}>")),
        }
        out.push_str(part);
    }
    out
}
