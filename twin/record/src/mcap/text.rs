//! Names and sentences of a job, made safe: they are written by others.

/// Longest name, in characters.
pub(crate) const NAME_MAX: usize = 200;
/// Longest sentence, in characters.
pub(crate) const SENTENCE_MAX: usize = 4000;

/// At most `most` characters of a text, its control characters but line ends and tabs made visible.
pub(crate) fn shown(text: &str, most: usize) -> String {
    let seen = |c: char| if c.is_control() && c != '\n' && c != '\t' { '\u{FFFD}' } else { c };
    let mut out: String = text.chars().take(most).map(seen).collect();
    if text.chars().nth(most).is_some() {
        out.push('…');
    }
    out
}

/// The word for a kind of body.
pub(crate) fn kind(kind: sim::scene::BodyKind) -> String {
    format!("{kind:?}").to_lowercase()
}

/// A name.
pub(crate) fn name(text: &str) -> String {
    shown(text, NAME_MAX).replace(['\n', '\t'], "\u{FFFD}")
}

/// The last part of a path as the name of an attachment, so that taking it out cannot leave a folder.
pub(crate) fn file_name(path: &str) -> String {
    let last = path.rsplit(['/', '\\', ':']).next().unwrap_or_default();
    match last.trim_matches(['.', ' ']) {
        "" => "file".to_owned(),
        _ => name(last),
    }
}

/// A name that none of those taken has.
pub(crate) fn distinct(wanted: &str, is_taken: impl Fn(&str) -> bool) -> String {
    let first = match wanted {
        "" => "unnamed".to_owned(),
        _ => name(wanted),
    };
    let others = (2u64..).map(|number| format!("{first}#{number}"));
    std::iter::once(first.clone()).chain(others).find(|name| !is_taken(name)).unwrap_or(first)
}
