//! Where answers go, asked before the work: no two into one file, none over what is read, folders made.

use std::path::{Path, PathBuf};

use crate::files;
use crate::refusal::Refusal;

/// Makes the folders of what will be written, and refuses what would be lost.
///
/// # Errors
/// A file that an input or another answer would overwrite, a folder in the place of a file, a folder that cannot be made.
pub(crate) fn claim<'a>(
    answers: impl IntoIterator<Item = &'a Path>,
    read: impl IntoIterator<Item = &'a Path>,
) -> Result<(), Refusal> {
    let read: Vec<PathBuf> = read.into_iter().filter_map(whole).collect();
    let mut taken: Vec<PathBuf> = Vec::new();
    for answer in answers {
        let refuse = |message: &str, hint: &str| {
            Err(Refusal::whole(answer.display().to_string(), message).hint(hint))
        };
        let folder = files::folder_of(answer);
        if let Err(error) = std::fs::create_dir_all(&folder) {
            let message = format!("the folder {} cannot be made: {error}", folder.display());
            return refuse(&message, "name a file in a folder that you may write to");
        }
        if answer.is_dir() {
            return refuse("this is a folder, and a file is to be written", "name a file in it");
        }
        if files::is_stream(answer) {
            continue;
        }
        let Some(place) = whole(answer) else { continue };
        if read.contains(&place) {
            return refuse("this file is read, and would be overwritten", "name another file");
        }
        if taken.contains(&place) {
            return refuse(
                "two answers would go into this one file",
                "give each a file of its own",
            );
        }
        taken.push(place);
    }
    Ok(())
}

/// The path without links, for a file that is there or whose folder is; `None`: neither is.
fn whole(path: &Path) -> Option<PathBuf> {
    path.canonicalize()
        .ok()
        .or_else(|| Some(files::folder_of(path).canonicalize().ok()?.join(path.file_name()?)))
}

/// Refuses a file whose ending says something else than what is written to it.
pub(crate) fn ends_in(path: &Path, endings: &[&str]) -> Result<(), Refusal> {
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    if endings.iter().any(|it| ending.eq_ignore_ascii_case(it)) || files::is_stream(path) {
        return Ok(());
    }
    let known: Vec<String> = endings.iter().map(|it| format!(".{it}")).collect();
    let message = format!("what is written here ends in {}", known.join(" or "));
    Err(Refusal::whole(path.display().to_string(), message)
        .hint(format!("name a file that ends in {}", known[0])))
}
