//! `report.json` back to a report.

use serde::Deserialize;

use crate::{Report, SCHEMA};

/// Largest `report.json` that is read, bytes.
pub const MAX_BYTES: usize = 512 << 20;

/// Why a text is no report.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ReadError {
    /// Larger than [`MAX_BYTES`].
    #[error("the report has {0} bytes; at most {MAX_BYTES} are read")]
    TooBig(usize),
    /// Not JSON, or no object with a `schema`.
    #[error("this is no report: {0}")]
    NotJson(String),
    /// Of another version of the format.
    #[error("the report's schema is {0:?}; this twin reads {SCHEMA:?}")]
    OtherSchema(String),
    /// A key is missing, unknown or of the wrong type.
    #[error("the report is not whole: {0}")]
    NotWhole(String),
}

#[derive(Deserialize)]
struct Head {
    schema: String,
}

/// Reads what [`crate::to_json`] wrote, also from a twin that told no `allowed`.
///
/// # Errors
/// The text is too big, no JSON, of another version, or not whole.
pub fn from_json(text: &str) -> Result<Report, ReadError> {
    if text.len() > MAX_BYTES {
        return Err(ReadError::TooBig(text.len()));
    }
    let shown = |error: serde_json::Error| crate::line::one_line(&error.to_string(), 300);
    let head: Head =
        serde_json::from_str(text).map_err(|error| ReadError::NotJson(shown(error)))?;
    if head.schema != SCHEMA {
        return Err(ReadError::OtherSchema(crate::line::one_line(&head.schema, 60)));
    }
    serde_json::from_str(text).map_err(|error| ReadError::NotWhole(shown(error)))
}
