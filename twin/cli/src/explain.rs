//! `twin explain`: what a code means.

use sim::finding::{Code, Family};
use slam::{Diagnostic, Span};

use crate::FEASIBLE;
use crate::names::with_names;
use crate::refusal::{Failure, Refusal};
use crate::screen::Screen;

/// Explain a finding's code, or list all codes
#[derive(Debug, clap::Args)]
pub(crate) struct Explain {
    /// Code of a finding, such as C201; without it all codes are listed
    #[arg(value_name = "CODE")]
    code: Option<String>,
}

impl Explain {
    pub(crate) fn run(self, screen: &mut Screen<'_>) -> Result<u8, Failure> {
        let Some(name) = self.code else {
            for family in Family::ALL {
                let codes: Vec<Code> =
                    Code::ALL.into_iter().filter(|code| code.family() == family).collect();
                if codes.is_empty() {
                    continue;
                }
                writeln!(screen.out, "{}: {}", family.letter(), family.title())?;
                for code in codes {
                    writeln!(screen.out, "  {}  {}", code.as_str(), code.title())?;
                }
            }
            return Ok(FEASIBLE);
        };
        let Some(code) = Code::from_name(name.trim()) else {
            let known: Vec<String> =
                Code::ALL.iter().map(|code| code.as_str().to_owned()).collect();
            let message = format!("there is no code `{}`", crate::names::clipped(&name));
            let problem = with_names(Diagnostic::error(Span::default(), message), &name, &known);
            let source = slam::Source::new("CODE", name);
            return Err(Refusal::of(&source, vec![problem]).into());
        };
        writeln!(screen.out, "{}: {}\n", code.as_str(), code.title())?;
        writeln!(screen.out, "{}", code.page().trim_end())?;
        Ok(FEASIBLE)
    }
}
