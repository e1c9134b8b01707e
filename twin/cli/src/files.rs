//! Reading within limits, and writing whole files or none.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, Read as _, Write as _};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use slam::{Diagnostic, Source, Span};

use crate::refusal::Refusal;

/// Largest cell, tool, robot or material file, bytes.
pub(crate) const MAX_TOML: u64 = 1 << 20;
/// Largest mesh, bytes.
pub(crate) const MAX_MESH: u64 = 256 << 20;
/// Largest job, frame, order, curve, joint or pose file, bytes.
pub(crate) const MAX_TEXT: u64 = slam::job::MAX_BYTES as u64;
/// Largest URDF, bytes.
pub(crate) const MAX_URDF: u64 = slam::urdf::MAX_BYTES as u64;

/// The bytes of an ordinary file of at most `limit` bytes; nothing of a larger one is read.
///
/// # Errors
/// One sentence for the user.
pub(crate) fn bytes(path: &Path, limit: u64) -> Result<Vec<u8>, String> {
    // Asked before opening: opening a pipe waits for whoever writes to it.
    ordinary(&fs::metadata(path).map_err(|error| unreadable(&error))?, limit)?;
    let file = File::open(path).map_err(|error| unreadable(&error))?;
    // and again, should another file be there by now
    ordinary(&file.metadata().map_err(|error| unreadable(&error))?, limit)?;
    let mut bytes = Vec::new();
    file.take(limit + 1).read_to_end(&mut bytes).map_err(|error| unreadable(&error))?;
    if bytes.len() as u64 > limit {
        return Err(too_large(bytes.len() as u64, limit));
    }
    Ok(bytes)
}

fn unreadable(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "there is no such file".to_owned(),
        io::ErrorKind::PermissionDenied => "the file may not be read (permission)".to_owned(),
        _ => format!("the file cannot be read: {error}"),
    }
}

fn ordinary(metadata: &fs::Metadata, limit: u64) -> Result<(), String> {
    if metadata.is_dir() {
        return Err("this is a folder, not a file".to_owned());
    }
    if !metadata.is_file() {
        return Err("this is a device or a pipe, not an ordinary file".to_owned());
    }
    if metadata.len() > limit { Err(too_large(metadata.len(), limit)) } else { Ok(()) }
}

fn too_large(size: u64, limit: u64) -> String {
    let mib = |bytes: u64| bytes as f64 / f64::from(1 << 20);
    format!("the file has {:.1} MiB; at most {:.0} MiB are read", mib(size), mib(limit))
}

/// A text file as a source called by its path.
///
/// # Errors
/// With the line of the first byte that is not UTF-8.
pub(crate) fn text(path: &Path, limit: u64) -> Result<Source, Refusal> {
    let name = path.display().to_string();
    let bytes = bytes(path, limit).map_err(|message| {
        let mib = limit >> 20;
        Refusal::whole(&name, message)
            .hint(format!("give the path of a text file of at most {mib} MiB"))
    })?;
    utf8(name, bytes)
}

/// Bytes as a text.
pub(crate) fn utf8(name: impl Into<String>, bytes: Vec<u8>) -> Result<Source, Refusal> {
    let error = match String::from_utf8(bytes) {
        Ok(text) => return Ok(Source::new(name, text)),
        Err(error) => error,
    };
    let at = error.utf8_error().valid_up_to();
    let bytes = error.as_bytes();
    // Control characters of a binary file must not reach the terminal; lengths stay as they are.
    let before = bytes[..at].iter().map(|&byte| match byte {
        b'\n' | b'\t' | b' '..=b'~' => char::from(byte),
        _ => '?',
    });
    let shown: String = before.chain(['\u{fffd}']).collect();
    let message = format!("byte {:#04x} here is not UTF-8; this is not a text", bytes[at]);
    let problem =
        Diagnostic::error(Span { start: at, end: at + 3 }, message).hint("save the file as UTF-8");
    Err(Refusal { source: Source::new(name, shown), diagnostics: vec![problem] })
}

/// The folder of a file, `.` for a bare name.
pub(crate) fn folder_of(path: &Path) -> PathBuf {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_owned(),
        _ => PathBuf::from("."),
    }
}

/// Writes a file under a temporary name beside it, then renames: readers see the old file or the
/// whole new one. A link is followed, and a device or a pipe (`/dev/stdout`, `/dev/null`) is written
/// to: a rename would put a plain file in its place.
pub(crate) fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), Refusal> {
    write(path, bytes).map_err(|error| {
        Refusal::whole(path.display().to_string(), format!("the file cannot be written: {error}"))
            .hint("is the folder there, and may you write to it?")
    })
}

fn write(path: &Path, bytes: &[u8]) -> io::Result<()> {
    if is_stream(path) {
        return File::options().write(true).open(path)?.write_all(bytes);
    }
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    whole_or_none(&temporary(&target, "tmp"), &target, |temporary| {
        File::create(temporary).and_then(|mut file| file.write_all(bytes))
    })
}

/// Whether a device or a pipe is at a path, or at the end of its links. Asked of the path itself: what `/dev/stdout` leads
/// to through a pipe has no name of its own.
pub(crate) fn is_stream(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|there| !there.is_file() && !there.is_dir())
}

/// A large file that `write` makes piece by piece at a temporary name beside its own, `.NAME.PID.part`: where the machine
/// stops, what is there by then can still be read by who recovers recordings. Devices and pipes are refused: who writes may
/// want to go back in the file.
///
/// # Errors
/// One sentence of `write`, or of the rename.
pub(crate) fn write_by(
    path: &Path,
    write: impl FnOnce(&Path) -> Result<(), String>,
) -> Result<(), Refusal> {
    if is_stream(path) {
        let why = "recordings go to files, and this is a device or a pipe";
        return Err(Refusal::whole(path.display().to_string(), why)
            .hint("record to a file, and read it when the program is done"));
    }
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let written = whole_or_none(&temporary(&target, "part"), &target, |temporary| {
        write(temporary).map_err(io::Error::other)
    });
    written.map_err(|error| {
        Refusal::whole(path.display().to_string(), format!("the file cannot be written: {error}"))
            .hint("is the folder there, may you write to it, and is there room?")
    })
}

/// A name beside the file's own that no other program takes.
fn temporary(target: &Path, ending: &str) -> PathBuf {
    let mut name = std::ffi::OsString::from(".");
    name.push(target.file_name().unwrap_or_default());
    name.push(format!(".{}.{ending}", std::process::id()));
    target.with_file_name(name)
}

/// Adds to the end of a file that others write to as well.
pub(crate) fn append(path: &Path, bytes: &[u8]) -> io::Result<()> {
    File::options().append(true).create(true).open(path)?.write_all(bytes)
}

/// What `write` leaves at a temporary name gets its real name once it is whole, and is removed where it is not.
fn whole_or_none(
    temporary: &Path,
    target: &Path,
    write: impl FnOnce(&Path) -> io::Result<()>,
) -> io::Result<()> {
    half_written().insert(temporary.to_owned());
    let renamed = write(temporary).and_then(|()| fs::rename(temporary, target));
    if renamed.is_err() {
        let _ = fs::remove_file(temporary);
    }
    half_written().remove(temporary);
    renamed
}

/// Files that are not whole yet.
static HALF_WRITTEN: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

fn half_written() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    HALF_WRITTEN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes what is half written: for whoever ends the program from outside (Ctrl-C).
pub fn remove_temporary() {
    for file in std::mem::take(&mut *half_written()) {
        let _ = fs::remove_file(file);
    }
}
