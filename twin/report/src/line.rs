//! Text of others on one line of ours.

use crate::parts::Allowed;

/// The text on one line, without what would steer a terminal, turn the direction of writing or be
/// refused by XML; at most so many characters, the last of them `…` where something was left out.
pub(crate) fn one_line(text: &str, longest: usize) -> String {
    let mut chars = text.trim().chars().map(|c| match c {
        '\t' | '\n' | '\u{b}' | '\u{c}' | '\r' | '\u{85}' | '\u{2028}' | '\u{2029}' => ' ',
        c if c.is_control() || is_mark(c) => '\u{fffd}',
        c => c,
    });
    let mut line: String = chars.by_ref().take(longest).collect();
    if chars.next().is_some() {
        line.pop();
        line.push('…');
    }
    line
}

/// Marks nobody sees: of direction, of byte order, and what is no character.
fn is_mark(c: char) -> bool {
    matches!(
        c,
        '\u{61c}' | '\u{200b}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2060}'..='\u{206f}'
            | '\u{feff}' | '\u{fff9}'..='\u{fffb}' | '\u{fffe}' | '\u{ffff}'
    )
}

/// `allowed until 2027-01-31 because …`.
pub(crate) fn allowed_words(allowed: &Allowed) -> String {
    format!("allowed until {} because: {}", allowed.until, allowed.reason)
}
