//! The forms that an answer can take, for programs and for people.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use clap::ValueEnum as _;
use report::Report;

use crate::refusal::Refusal;
use crate::{files, pictures};

/// A form of the answer that is a text of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Form {
    /// Text for people
    Human,
    /// The whole report as JSON
    Json,
    /// One line a finding: `file:line: severity CODE message`
    Concise,
    /// A page in Markdown
    Markdown,
    /// SARIF 2.1.0, for code scanning
    Sarif,
    /// JUnit, for CI systems that count tests
    Junit,
    /// Code quality, for GitLab
    Gitlab,
    /// Annotations, for GitHub's runner
    Github,
}

impl Form {
    /// The text. `root`: folder that paths are told from.
    pub(crate) fn text(self, report: &Report, root: &str, rest: &str) -> String {
        match self {
            Self::Human => report::human(report, false, 100),
            Self::Json => report::to_json(report),
            Self::Concise => report::concise(report, root),
            Self::Markdown => report::markdown(report),
            Self::Sarif => report::sarif(report, root),
            Self::Junit => report::junit(report, root),
            Self::Gitlab => report::gitlab(report, root),
            Self::Github => report::github(report, root, rest),
        }
    }

    /// Its file in the folder of the answer, if no other is named.
    fn file_name(self) -> &'static str {
        match self {
            Self::Human => "report.txt",
            Self::Json => "report.json",
            Self::Concise => "concise.txt",
            Self::Markdown => "report.md",
            Self::Sarif => "twin.sarif",
            Self::Junit => "junit.xml",
            Self::Gitlab => "gitlab.json",
            Self::Github => "github.txt",
        }
    }
}

/// A form with its file, as in `sarif` or `junit=ci/twin.xml`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Saved {
    form: Form,
    file: Option<PathBuf>,
}

impl FromStr for Saved {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (form, file) = match text.split_once('=') {
            Some((form, file)) => (form, Some(PathBuf::from(file))),
            None => (text, None),
        };
        let form = <Form as clap::ValueEnum>::from_str(form, false).map_err(|_| {
            let all = Form::value_variants().iter().filter_map(clap::ValueEnum::to_possible_value);
            let known: Vec<String> = all.map(|value| value.get_name().to_owned()).collect();
            format!("there is no form `{form}`; there is {}", known.join(", "))
        })?;
        Ok(Self { form, file })
    }
}

impl Saved {
    /// Where it goes.
    pub(crate) fn path(&self, out: &Path) -> PathBuf {
        self.file.clone().unwrap_or_else(|| out.join(self.form.file_name()))
    }

    /// Writes it.
    pub(crate) fn write(&self, report: &Report, root: &str, out: &Path) -> Result<(), Refusal> {
        let text = self.form.text(report, root, &out.display().to_string());
        files::write_whole(&self.path(out), text.as_bytes())
    }
}

/// Makes the folder of the answer.
///
/// # Errors
/// A folder that cannot be made.
pub(crate) fn make_folder(out: &Path) -> Result<(), Refusal> {
    std::fs::create_dir_all(out).map_err(|error| {
        let message = format!("the folder cannot be made: {error}");
        Refusal::whole(out.display().to_string(), message).hint("name another with --out")
    })
}

/// Removes what an earlier check left in the folder of the answer.
///
/// # Errors
/// An old file that cannot be removed.
pub(crate) fn clear_folder(out: &Path) -> Result<(), Refusal> {
    let ours = |name: &str| {
        pictures::is_ours(name) || ["report.json", "report.html", "strands.html"].contains(&name)
    };
    for entry in std::fs::read_dir(out).into_iter().flatten().flatten() {
        if !entry.file_name().to_str().is_some_and(ours) {
            continue;
        }
        let old = entry.path();
        if let Err(error) = std::fs::remove_file(&old)
            && old.is_file()
        {
            let message = format!("it is left of an earlier check and cannot be removed: {error}");
            return Err(Refusal::whole(old.display().to_string(), message));
        }
    }
    Ok(())
}

/// The day by the clock, in universal time, as `YYYY-MM-DD`.
pub(crate) fn today() -> String {
    let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
    day(now.map_or(0, |since| since.as_secs() / 86_400))
}

/// A day by its number since 1970-01-01 (Hinnant's civil_from_days).
fn day(since_1970: u64) -> String {
    let z = since_1970 + 719_468;
    let (era, of_era) = (z / 146_097, z % 146_097);
    let year_of_era = (of_era - of_era / 1460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let month_from_march = (5 * of_year + 2) / 153;
    let day = of_year - (153 * month_from_march + 2) / 5 + 1;
    let month = if month_from_march < 10 { month_from_march + 3 } else { month_from_march - 9 };
    let year = year_of_era + era * 400 + u64::from(month <= 2);
    format!("{year:04}-{month:02}-{day:02}")
}

#[cfg(test)]
mod tests {
    use super::day;

    #[test]
    fn days_have_names() {
        for (number, name) in [
            (0, "1970-01-01"),
            (59, "1970-03-01"),
            (11_016, "2000-02-29"),
            (20_779, "2026-11-22"),
            (47_540, "2100-02-28"),
            (47_541, "2100-03-01"),
        ] {
            assert_eq!(day(number), name);
        }
    }
}
